"""Draws of a sweep: what each run has at the keys that are varied, from the seed and its number alone."""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from math import ceil
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.scene.sweep import BEARING, Drawn, Scaled, Sweep, per_of, round_digits


@dataclass(frozen=True)
class Row:
    """One run of a sweep, before it is made."""

    run: A[int, "its number, from 0"]
    bearing: A[int, "number of its bearing, from 0"]
    drawn: A[dict[str, Any], "value of every key that is drawn"]
    seed: A[int, "of track, background and noise, where none is drawn"]
    lot: A[int, "which bearing of the lot, where none is drawn: seed of the scatter"]


def rows_of(sweep: Sweep) -> list[Row]:
    """Draw all runs of a sweep.

    The same seed gives the same rows on every machine. More runs of `sobol` and `random` begin with those of
    fewer.
    """
    count = sweep.run_count
    if sweep.sampling == "grid":
        values = [each.grid() for each in sweep.drawn]
        keys = [each.key for each in sweep.drawn]
        combined = (dict(zip(keys, chosen, strict=True)) for chosen in product(*values))
        return [_row(sweep, run, run, chosen) for run, chosen in zip(range(count), combined, strict=False)]
    own = [each for each in sweep.drawn if per_of(each) == BEARING]
    others = [each for each in sweep.drawn if per_of(each) != BEARING]
    shares = _shares((len(own), len(others)), (ceil(count / sweep.runs_per_bearing), count), sweep)
    bearings, runs = (_draw_keys(each, found) for each, found in zip((own, others), shares, strict=True))
    order = [each.key for each in sweep.drawn]
    rows = []
    for run in range(count):
        bearing = run // sweep.runs_per_bearing
        found = {**bearings[bearing], **runs[run]}
        rows.append(_row(sweep, run, bearing, {key: found[key] for key in order}))
    return rows


def _row(sweep: Sweep, run: int, bearing: int, drawn: dict[str, Any]) -> Row:
    return Row(
        run, bearing, drawn, _make_seed(sweep.seed, "seed", run), _make_seed(sweep.seed, "lot", bearing)
    )


def _draw_keys(variables: Sequence[Drawn], shares: Float) -> list[dict[str, Any]]:
    """Draw some keys for runs or bearings, which have these shares of their ranges."""
    return [
        {each.key: round_digits(each.at(float(share))) for each, share in zip(variables, point, strict=True)}
        for point in shares
    ]


def _shares(dimensions: tuple[int, int], counts: tuple[int, int], sweep: Sweep) -> tuple[Float, Float]:
    """Spread bearings and runs over their unit cubes, each shape [point, dimension].

    Of one sequence, for two of Sobol go with one another, dimension by dimension, however they are scrambled:
    what a run has would tell what its bearing has.
    """
    if sweep.sampling != "sobol":
        generators = (_generator(sweep.seed, what) for what in ("bearing", "run"))
        bearings, runs = (
            _points(*each, sweep.sampling, generator)
            for each, generator in zip(zip(dimensions, counts, strict=True), generators, strict=True)
        )
        return bearings, runs
    points = _points(sum(dimensions), max(counts), "sobol", _generator(sweep.seed, "bearing"))
    return points[: counts[0], : dimensions[0]], points[: counts[1], dimensions[0] :]


def _points(dimensions: int, count: int, sampling: str, generator: np.random.Generator) -> Float:
    """Spread points over the unit cube, shape [point, dimension]."""
    if not dimensions:
        return np.zeros((count, 0))
    if sampling == "random":
        return generator.random((count, dimensions))
    from scipy.stats import qmc

    if sampling == "latin_hypercube":
        return np.asarray(qmc.LatinHypercube(dimensions, rng=generator).random(count))
    # whole powers of two are balanced, and a shorter sequence is their beginning
    points = qmc.Sobol(dimensions, scramble=True, rng=generator).random_base2(max(count - 1, 1).bit_length())
    return np.asarray(points[:count])


def _generator(seed: int, what: str) -> np.random.Generator:
    return np.random.default_rng(np.random.SeedSequence([seed, zlib.crc32(what.encode())]))


def _make_seed(seed: int, what: str, number: int) -> int:
    """Make a seed of the sweep's and a number."""
    words = np.random.SeedSequence([seed, zlib.crc32(what.encode()), number]).generate_state(1)
    return int(words[0])


def scaled_value(variable: Scaled, values: dict[str, Any]) -> Any:
    """Give the value of a key that follows another one; ``None`` where that has none in this run."""
    number = values.get(variable.by)
    if not isinstance(number, int | float) or isinstance(number, bool):
        return None
    return round_digits(variable.of(float(number)))
