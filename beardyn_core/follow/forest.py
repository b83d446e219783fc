"""A number from descriptors by many trees that ask one descriptor after the other."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.follow.regression import LEAST_DOUBT
from beardyn_core.follow.wide_spall import LEAST_FOLDED, LEAST_OF_TWO, agree


@dataclass(frozen=True, eq=False)
class Forest:
    """The mean of trees, each a chain of questions whether a descriptor is below a threshold.

    Trees find what a few descriptors say together, such as which harmonics of the envelope a width leaves
    out, among hundreds that say nothing. How far they differ shows where the number errs more and where less.

    References
    ----------
    Geurts, Ernst, Wehenkel (2006), Mach. Learn. 63, 3: trees whose thresholds are drawn at random.
    """

    descriptor: A[NDArray[np.int32], "shape [node], asked for; -1 at an end"]
    number: A[Float, "shape [node], threshold, or at an end the number"]
    other: A[NDArray[np.int32], "shape [node], that follows where it is above; else the next one does"]
    roots: A[NDArray[np.int32], "shape [tree], first node of each"]
    usual: A[float, "usual spread of the trees on bearings that are left out"]
    offset: A[float, "added to the mean of the trees"]
    slope: A[float, "that it is multiplied by before"]

    def __post_init__(self) -> None:
        """Refuse trees of a damaged file, which would never end."""
        asks = np.flatnonzero(self.descriptor >= 0)
        if len(asks) and ((self.other[asks] <= asks).any() or self.other.max() >= len(self.other)):
            raise ValueError("trees that go back")

    def value(self, standardised: Float) -> Float:
        """Give the number, shape [run], of standardised descriptors, shape [run, descriptor]."""
        return self.offset + self.slope * self._ends(standardised).mean(axis=1)

    def expected_error(self, standardised: Float) -> Float:
        """Give the error to be expected, shape [run]."""
        spread = self._ends(standardised).std(axis=1)
        return np.asarray(np.maximum(spread, LEAST_DOUBT * self.usual), np.float64)

    def on_line(self, offset: float, slope: float) -> Forest:
        """Put the number on a line of itself."""
        return replace(self, offset=offset + slope * self.offset, slope=slope * self.slope)

    def _ends(self, standardised: Float) -> Float:
        """Follow every tree to its end, shape [run, tree]."""
        asked = standardised.astype(np.float32).astype(np.float64)  # as trees are learnt
        at = np.tile(self.roots, (len(asked), 1))
        runs = np.arange(len(asked))[:, None]
        while (descriptor := self.descriptor[at]).max() >= 0:
            below = asked[runs, np.maximum(descriptor, 0)] <= self.number[at]
            at = np.where(descriptor < 0, at, np.where(below, at + 1, self.other[at]))
        return self.number[at]


@dataclass(frozen=True, eq=False)
class EventForest(Forest):
    """A forest of the logarithm of a width, that the way between two events makes sharper.

    The way is that of entry and exit if the trees give about as much and agree that the spall is not a small
    one: it is read to a few per cent, but of small spalls, which make one event, and of noise it is any way.
    """

    reading: A[Float, "shape [descriptor], to the way, [m]"]
    start: A[float, "added to it, [m]"]
    added: A[float, "width less way, [m]"]
    doubt: A[float, "error to be expected of the logarithm of a width by the way"]

    def value(self, standardised: Float) -> Float:
        """Give the logarithm of the width, shape [run]."""
        by_trees, way, sharp = self._read(standardised)
        width = np.log(np.maximum(way + self.added, LEAST_FOLDED))
        return np.asarray(self.offset + self.slope * np.where(sharp, width, by_trees), np.float64)

    def expected_error(self, standardised: Float) -> Float:
        """Give the error to be expected, shape [run]."""
        sharp = self._read(standardised)[2]
        return np.asarray(np.where(sharp, self.doubt, super().expected_error(standardised)), np.float64)

    def _read(self, standardised: Float) -> tuple[Float, Float, NDArray[np.bool_]]:
        """Read what the trees give and the way, and whether the way is believed."""
        ends = self._ends(standardised)
        by_trees, spread = ends.mean(axis=1), ends.std(axis=1)
        way = standardised @ self.reading + self.start
        return by_trees, way, agree(way, np.exp(by_trees)) & (np.exp(by_trees - spread) >= LEAST_OF_TWO)


def forest_of(trees: Any, columns: NDArray[np.int64]) -> Forest:
    """Take the trees of scikit-learn, which ask these of all descriptors."""
    parts: list[tuple[NDArray[Any], ...]] = []
    roots, first = [], 0
    for each in trees:
        tree = each.tree_
        end = tree.children_left < 0
        descriptor = np.where(end, -1, columns[np.maximum(tree.feature, 0)])
        number = np.where(end, tree.value[:, 0, 0], tree.threshold)
        parts.append((descriptor, number, np.where(end, 0, tree.children_right + first)))
        roots.append(first)
        first += len(end)
    descriptor, number, other = (np.concatenate(each) for each in zip(*parts, strict=True))
    return Forest(
        descriptor.astype(np.int32), number.astype(np.float64), other.astype(np.int32),
        np.array(roots, np.int32), 0.0, 0.0, 1.0,
    )  # fmt: skip
