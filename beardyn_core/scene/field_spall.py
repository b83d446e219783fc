"""A spall as rolling contact fatigue leaves it: grown by chips from a pit to the whole width of a raceway.

Fatigue breaks chips off the edge of a spall, so that its outline is ragged, its floor has terraces and each
stage contains the one before. What a roller feels of it are the lengths along its line on which it loses its
support, one after the other, and the rims that stand up around them: strips of other widths, places and
depths, and a few pits and dents around.

Statistics of length, width, depth, rims and pits by stage are in `STAGES`; docs/spalls.md says which of them
are published, derived and assumed.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated as A
from typing import Any, NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import ROW, SEED, At
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.scene.patch import Patch, no_such, not_on_a_roller, raceway_diameter, width_problem

PARTS = 13  # strips along the roller that stand for the outline; more change a round pit by less than 1 %


class Stage(NamedTuple):
    """Medians of a stage of growth; what is between two stages is interpolated in logarithms."""

    width: float  # along the raceway [m]
    length: float  # along the roller, as far as the contact reaches [m]
    depth: float  # mean of the floor [m]
    terrace: float  # standard deviation of the floor from strip to strip [m]
    rim_height: float  # [m]
    rim_width: float  # [m]
    pits: float  # expected number around it
    dents: float  # likewise, of those that are wider than `_SMALLEST_DENT`


STAGES = (
    Stage(0.6e-3, 0.6e-3, 60e-6, 10e-6, 1.0e-6, 80e-6, 0.0, 0.2),
    Stage(2.5e-3, 3.5e-3, 110e-6, 20e-6, 1.5e-6, 130e-6, 0.2, 0.7),
    Stage(9.0e-3, 13e-3, 150e-6, 35e-6, 2.0e-6, 180e-6, 1.0, 2.0),
    Stage(21e-3, 30e-3, 175e-6, 45e-6, 2.5e-6, 220e-6, 3.0, 4.0),
    Stage(45e-3, 60e-3, 210e-6, 50e-6, 2.5e-6, 250e-6, 5.0, 6.0),
)
# Of logarithms: width at a stage, length over width, rims.
_SPREAD_WIDTH, _SPREAD_LENGTH, _SPREAD_RIM_HEIGHT, _SPREAD_RIM_WIDTH = 0.3, 0.35, 0.6, 0.4
_CUT = 2.2  # standard deviations
_WITH_RIM = 0.5  # share of the outline
_STEEPEST_RIM = 0.018  # height over width: higher ones are rolled down until they shake down
_CELL = 0.25e-3  # along the roller, of the outline [m]
_CHIP, _CHIP_ACROSS, _SPREAD_CHIP = 0.8e-3, 1.6e-3, 0.4  # along the raceway, along the roller [m]
_CANDIDATES = 2  # places of which the one that lags most loses the next chip
_MOST_PITS, _MOST_DENTS, _AROUND = 8, 6, 15e-3  # [m]
_PIT, _PIT_DEPTH = np.array([1.2e-3, 1.5e-3]), 80e-6  # medians along raceway and roller, depth [m]
_SMALLEST_DENT, _LARGEST_DENT, _DENT_DEPTH, _SHOULDER = 0.2e-3, 0.5e-3, 0.03, 0.1


class Outline(NamedTuple):
    """Where a spall begins and ends on lines around the raceway, side by side."""

    place: Float  # along the roller, from mid-length, shape [cell], [m]
    low: Float  # along the raceway, from where it began, shape [cell], [m]
    high: Float
    cell: float  # distance of the lines, [m]


@dataclass(frozen=True)
class FieldSpall:
    """A spall of rolling contact fatigue at a stage of its growth, with a ragged outline.

    It begins as a pit at its azimuth and loses chips at its edge, one after the other, until it is as wide as
    asked. With the same seed a wider one contains a narrower one.
    """

    on: A[str, At(one_of=("cup", "cone", "roller")), "the surface it is on"]
    row: A[int, ROW, "0 inboard, 1 outboard"]
    azimuth: A[
        float,
        At("deg", usual=0.0),
        "where it began, from +z (the top) towards +x, in the body's own frame at the start of the run",
    ]
    width: A[
        float,
        At("mm", gt=0.0, le=90.0, optional=True),
        "in rolling direction, from the first edge to the last; or give `stage`",
    ]
    length: A[
        float, At("mm", gt=0.0, optional=True), "it grows to along the roller at most; the contact by default"
    ]
    offset: A[
        float | None,
        At("mm"),
        "where it began, from mid-length towards the large end; by the seed if left out",
    ] = None
    roller: A[int, At(ge=0), "which roller, with `on: roller`"] = 0
    seed: A[int, SEED, "which spall of that size"] = 1
    kind: A[str, At(one_of=("field_spall",), required=True), "which of the kinds this is"] = "field_spall"

    def rules(self) -> Iterator[str]:
        """Check that a roller's number is set only for rollers."""
        if self.on != "roller" and self.roller != 0:
            yield not_on_a_roller(self.roller, self.on)

    def contradictions(self, bearing: RollerBearing) -> Iterator[str]:
        """Check that the spall fits on the bearing."""
        effective = bearing.effective_length
        if self.on == "roller":
            yield from no_such("roller", self.roller, bearing)
        if problem := width_problem(self.width, self.on, bearing):
            yield problem
        if self.on == "roller" and self.width > bearing.roller_diameter:
            yield (
                f"width_mm is {self.width * 1e3:g}; it must be at most {bearing.roller_diameter * 1e3:g}, "
                "the roller diameter"
            )
        if self.length > effective * (1.0 + 1e-9):
            yield f"length_mm is {self.length * 1e3:g}; it must be at most {effective * 1e3:g}, the contact"
        if self.offset is not None and abs(self.offset) > 0.5 * self.length:
            yield (
                f"offset_mm is {self.offset * 1e3:g}; it must be between {-0.5e3 * self.length:g} and "
                f"{0.5e3 * self.length:g}, half of what it may grow over"
            )

    @property
    def depth(self) -> float:
        """Mean depth of the floor, [m]."""
        deeper = 0.17 * _normal(_stream(self.seed, "depth"))
        return _between(self.width, "depth") * (1.0 + deeper)

    @property
    def outline(self) -> Outline:
        """Where it begins and ends along the roller."""
        return _outline(self.seed, self.width, self.length, self.offset)

    @property
    def extent(self) -> tuple[float, float]:
        """Length along the roller and its middle from mid-length, [m]."""
        place = self.outline.place
        return float(place[-1] - place[0]) + self.outline.cell, float(0.5 * (place[0] + place[-1]))

    @property
    def area(self) -> float:
        """Area that is broken out, [m^2]."""
        return float((self.outline.high - self.outline.low).sum()) * self.outline.cell

    def patches(self, bearing: RollerBearing) -> tuple[Patch, ...]:
        """Make the strips, pits and dents that a roller meets."""
        diameter = bearing.roller_diameter if self.on == "roller" else raceway_diameter(self.on, bearing)
        return self.patches_at(0.5 * diameter)

    def patches_at(self, radius: float) -> tuple[Patch, ...]:
        """Make them on a surface of a mean radius [m]."""
        return _patches(self, radius)

    def described(self) -> str:
        """Describe the defect in a few words."""
        where = (
            f"roller {self.roller}, row {self.row}" if self.on == "roller" else f"{self.on}, row {self.row}"
        )
        return (
            f"field spall on the {where}, {self.width * 1e3:.1f} x {self.extent[0] * 1e3:.1f} mm, "
            f"{self.depth * 1e6:.0f} µm deep"
        )

    def truth(self) -> dict[str, Any]:
        """Write what has been drawn, [m], [m^2]."""
        length, middle = self.extent
        return {"depth": self.depth, "length": length, "middle": middle, "area": self.area}


def width_of_stage(stage: float, seed: int) -> float:
    """Draw the width in rolling direction of a spall at a stage of growth, 1 to 5, [m]."""
    median = np.interp(stage, range(1, len(STAGES) + 1), np.log([each.width for each in STAGES]))
    return math.exp(float(median) + _SPREAD_WIDTH * _normal(_stream(seed, "width")))


def _stream(seed: int, feature: str) -> np.random.Generator:
    """Make the random numbers of one feature: none of them moves when another feature draws more."""
    return np.random.default_rng(np.random.SeedSequence([seed, zlib.crc32(feature.encode())]))


def _normal(random: np.random.Generator) -> float:
    return float(np.clip(random.standard_normal(), -_CUT, _CUT))


def _between(width: float, name: str) -> float:
    """Interpolate a median of the stages at a width [m]."""
    widths = np.log([stage.width for stage in STAGES])
    return float(np.interp(math.log(width), widths, [getattr(stage, name) for stage in STAGES]))


def _length_at(width: float) -> float:
    """Take the median length along the roller at a width, [m]."""
    sizes = np.log([(stage.width, stage.length) for stage in STAGES])
    return math.exp(float(np.interp(math.log(width), sizes[:, 0], sizes[:, 1])))


@lru_cache(maxsize=64)
def _outline(seed: int, width: float, line: float, offset: float | None) -> Outline:
    """Break chips off until the spall is `width` wide in rolling direction."""
    cells = max(round(line / _CELL), 3)
    cell = line / cells
    place = np.asarray((np.arange(cells) - 0.5 * (cells - 1)) * cell)
    low, high = np.zeros(cells), np.zeros(cells)
    origin = offset if offset is not None else 0.2 * line * _normal(_stream(seed, "offset"))
    longer = math.exp(_SPREAD_LENGTH * _normal(_stream(seed, "length")))
    first = int(np.argmin(np.abs(place - origin)))
    begin, end = first, first + 1
    half = 0.5 * min(width, 0.3e-3)
    low[first], high[first] = -half, half
    random = _stream(seed, "chips")
    while True:
        now = float(high[begin:end].max() - low[begin:end].min())
        if now >= width * (1.0 - 1e-9):
            return Outline(place[begin:end], low[begin:end], high[begin:end], cell)
        wanted = min(longer * _length_at(max(now, STAGES[0].width)), line)
        chance = random.random(_CANDIDATES + 3)
        along, across = np.exp(_SPREAD_CHIP * np.clip(random.standard_normal(2), -_CUT, _CUT))
        smaller = 0.25 if now < STAGES[1].width else 1.0
        count = max(round(smaller * across * _CHIP_ACROSS / _CELL), 1)
        if (end - begin) * cell < wanted and end - begin < cells:
            up = end < cells and (begin == 0 or chance[-1] < 0.5)
            nearest = end - 1 if up else begin
            share = 0.3 + 0.5 * chance[-2]
            middle = 0.5 * (low[nearest] + high[nearest])
            reach = 0.5 * share * (high[nearest] - low[nearest])
            opened = slice(end, min(end + count, cells)) if up else slice(max(begin - count, 0), begin)
            low[opened], high[opened] = middle - reach, middle + reach
            begin, end = min(begin, opened.start), max(end, opened.stop)
            continue
        upper = chance[-1] < 0.5
        edge = high if upper else -low
        picked = begin + (chance[:_CANDIDATES] * (end - begin)).astype(int)
        centre = int(picked[np.argmin(edge[picked] / _roundness(picked, begin, end))])
        chip = slice(max(centre - count // 2, begin), min(centre + count // 2 + 1, end))
        most = width + (low[begin:end].min() if upper else -high[begin:end].max())
        reached = min(edge[centre] + smaller * along * _CHIP, most)
        (high if upper else low)[chip] = (
            np.maximum(high[chip], reached) if upper else np.minimum(low[chip], -reached)
        )


def _roundness(cell: Any, begin: int, end: int) -> Float:
    """Take how far an ellipse reaches at cells, over its reach in the middle; not below a third."""
    across = (2.0 * np.asarray(cell) - begin - end + 1.0) / (end - begin)
    return np.sqrt(np.maximum(1.0 - across**2, 0.1))


@lru_cache(maxsize=64)
def _patches(spall: FieldSpall, radius: float) -> tuple[Patch, ...]:
    place, low, high, cell = spall.outline
    random, rims = _stream(spall.seed, "floor"), _stream(spall.seed, "rims")
    edges = np.linspace(place[0] - 0.5 * cell, place[-1] + 0.5 * cell, min(PARTS, len(place)) + 1)
    belongs = np.clip(np.searchsorted(edges, place, side="right") - 1, 0, len(edges) - 2)
    found = []
    for part in range(len(edges) - 1):
        inside = belongs == part
        first, last = float(low[inside].mean()), float(high[inside].mean())
        depth = max(spall.depth + _between(spall.width, "terrace") * _normal(random), 0.3 * spall.depth)
        sizes = (last - first, depth, float(edges[part + 1] - edges[part]))
        angle, offset = 0.5 * (first + last) / radius, float(0.5 * (edges[part] + edges[part + 1]))
        found.append(_patch(spall, angle, sizes, offset, "spall", _rim(spall.width, rims)))
    for name, most in (("pits", _MOST_PITS), ("dents", _MOST_DENTS)):
        found += _around(spall, radius, name, most)
    return tuple(found)


def _rim(width: float, random: np.random.Generator) -> tuple[float, float]:
    """Draw height and width of the rim of a strip, [m]; zero where there is none."""
    there, higher, wider = random.random() < _WITH_RIM, _normal(random), _normal(random)
    rim_width = _between(width, "rim_width") * math.exp(_SPREAD_RIM_WIDTH * wider)
    height = _between(width, "rim_height") * math.exp(_SPREAD_RIM_HEIGHT * higher)
    return (min(height, _STEEPEST_RIM * rim_width), rim_width) if there else (0.0, 0.0)


def _around(spall: FieldSpall, radius: float, name: str, most: int) -> list[Patch]:
    """Draw the pits or dents around a spall; they come one after the other as it grows."""
    random = _stream(spall.seed, name)
    arrivals = np.cumsum(random.exponential(size=most))
    chance, drawn = random.random((most, 4)), np.clip(random.standard_normal((most, 3)), -_CUT, _CUT)
    found = []
    for k in range(int(np.count_nonzero(arrivals < _between(spall.width, name)))):
        if name == "pits":
            width, length = (float(size) for size in _PIT * np.exp(0.4 * drawn[k, :2]))
            depth, kind, rim = _PIT_DEPTH * math.exp(0.3 * drawn[k, 2]), "elliptic", (0.0, 0.0)
        else:
            width = length = _SMALLEST_DENT * (_LARGEST_DENT / _SMALLEST_DENT) ** float(chance[k, 2])
            depth, kind = _DENT_DEPTH * width * math.exp(0.5 * drawn[k, 0]), "dent"
            rim = min(_SHOULDER * depth, _STEEPEST_RIM * 0.2 * width), 0.2 * width
        apart = 0.5 * spall.width + width + float(chance[k, 1]) * _AROUND
        arc = math.copysign(apart, chance[k, 0] - 0.5)
        offset = 0.5 * (spall.length - length) * (2.0 * float(chance[k, 3]) - 1.0)
        found.append(_patch(spall, arc / radius, (width, depth, length), offset, kind, rim))
    return found


def _patch(
    spall: FieldSpall,
    angle: float,
    sizes: tuple[float, float, float],
    offset: float,
    kind: str,
    rim: tuple[float, float],
) -> Patch:
    """Make a patch at an angle from where a spall began; its sizes are width, depth and length."""
    return Patch(spall.on, spall.row, spall.azimuth + angle, *sizes, offset, spall.roller, kind, *rim)
