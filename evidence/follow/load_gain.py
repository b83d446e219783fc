"""What a known vertical load gives: lateral load, end play, width rating life: docs/evidence/estimator.md.

``python -m evidence.follow.load_gain FOLDER``, a set that ``beardyn sweep high_speed_axlebox --seed N`` has
made, of bearings that the shipped estimator has not learnt from.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from math import log
from pathlib import Path
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.config_folder import config_folder
from beardyn_core.config import load_bearing, load_lubricant
from beardyn_core.follow.conditioning import condition_estimates
from beardyn_core.follow.estimator import Estimates, Estimator, read_estimator
from beardyn_core.follow.known_load import NORMAL_90, KnownLoad
from beardyn_core.follow.labelled import Described, describe_runs
from beardyn_core.follow.life_surface import LifeSurface
from beardyn_core.follow.quantities import BY_NAME
from beardyn_core.follow.rated_life import LifeCounter
from beardyn_core.population.labelled_set import LabelledSet
from evidence.pages import REPORTS, with_section

PAGE = REPORTS / "estimator.md"
TITLE, NEXT = "## What a known load gives\n", "## Drifts\n"
SHIPPED = config_folder() / "estimators" / "high_speed_axlebox.npz"
BEARING, LUBRICANT, WHEEL = "HS130x230", "L055", 0.88
NAMES = ("lateral_load", "end_play", "width")
SHARES = (0.0, 0.03, 0.10)
"""Half widths of the 90 % interval of the known load."""
_SEED = 6
_FEWEST = 8  # runs of which a covariance is worked out
COLUMNS = (
    *("number", "runs", "correlation of its error with the load", "by chance", "error"),
    *("load known exactly", "within 3 %", "within 10 %"),
)
HEAD = f"""{TITLE}
Written by `python -m evidence.follow.load_gain FOLDER`: the shipped estimator on {{count}} runs of
`quasistatic` of the sweep `high_speed_axlebox` with another seed, bearings that it has not learnt from. Its
errors and the logarithm of the true vertical load have a joint covariance, of the runs of all other
bearings; each estimate is conditioned on the load of its run, known within the half width of a 90 % interval.
*Error*: root mean square, all runs whose box is familiar, also those whose number would not be reported.
*By chance*: in 5 % of sets without any correlation it is larger.

| {" | ".join(COLUMNS)} |
|---{"|--:" * (len(COLUMNS) - 1)}|
"""
LIFE_COLUMNS = ("rating life L10r", "runs", "given", "90 % interval, high over low", "true life inside")
LIFE = f"""
*True life*: at the true loads and end play of the run, the load without swings.

| {" | ".join(LIFE_COLUMNS)} |
|---{"|--:" * (len(LIFE_COLUMNS) - 1)}|
"""


@dataclass(frozen=True)
class Errors:
    """Errors of one number on its scale, and the load of each run."""

    error: A[Float, "estimate less truth, shape [run]"]
    load: A[Float, "ln of the true vertical load, shape [run]"]
    bearing: A[NDArray[np.str_], "shape [run]"]

    @property
    def correlation(self) -> float:
        """Correlation of error and load."""
        return float(np.corrcoef(self.error, self.load)[0, 1])

    def conditioned(self, share: float, seed: int = _SEED) -> Float:
        """Give the errors that are left when each estimate is conditioned on a load known within a share."""
        noise = np.random.default_rng(seed).normal(size=len(self.load)) * share / NORMAL_90
        left = self.error.copy()
        for bearing in np.unique(self.bearing):
            mine = self.bearing == bearing
            others = np.stack((self.error, self.load))[:, ~mine]
            mean, covariance = others.mean(axis=1), np.cov(others)
            slope = covariance[0, 1] / (covariance[1, 1] + (share / NORMAL_90) ** 2)
            left[mine] -= mean[0] + slope * (self.load[mine] + noise[mine] - mean[1])
        return left

    def centred(self) -> Float:
        """Give the errors less their mean over the runs of all other bearings: no load is known."""
        left = self.error.copy()
        for bearing in np.unique(self.bearing):
            mine = self.bearing == bearing
            left[mine] -= self.error[~mine].mean()
        return left


def errors_of(estimator: Estimator, runs: Described, name: str) -> Errors:
    """Work out the errors of a number in runs whose box is familiar."""
    quantity = BY_NAME[name]
    standard = estimator.standardise(runs.descriptors)
    truth = runs.truth[name]
    chosen = (estimator.box.distance(standard) <= 1.0) & np.isfinite(truth)
    given = estimator.regressions[name].value(standard[chosen])
    load = np.log(runs.truth["vertical_load"][chosen])
    return Errors(given - quantity.scaled(truth[chosen]), load, runs.bearings[chosen])


def row_of(name: str, found: Errors) -> str:
    """Write the row of a number."""
    count = len(found.error)
    if count < _FEWEST:
        return f"| {BY_NAME[name].words} | {count} | - | - | - | - | - | - |\n"
    cells = [_rms(name, each) for each in (found.centred(), *(found.conditioned(share) for share in SHARES))]
    chance = 1.96 / np.sqrt(count)
    words = f"{BY_NAME[name].words} | {count} | {found.correlation:+.2f} | {chance:.2f}"
    return f"| {words} | {' | '.join(cells)} |\n"


def _rms(name: str, error: Float) -> str:
    size = float(np.sqrt(np.mean(error**2)))
    quantity = BY_NAME[name]
    return f"{100 * size:.1f} %" if quantity.relative else f"{size:.2g} {quantity.shown}"


def life_row(found: Sequence[Estimates], runs: Described, share: float) -> str:
    """Write the row of the rating life with a load that is known within a share."""
    random = np.random.default_rng(_SEED)
    bearing, lubricant = load_bearing(BEARING), load_lubricant(LUBRICANT)
    counters: list[tuple[LifeSurface, LifeCounter]] = []
    ratios, held = [], 0
    for k, each in enumerate(found):
        truth = {name: float(runs.truth[name][k]) for name in ("vertical_load", "lateral_load", "end_play")}
        value = truth["vertical_load"] * np.exp(share / NORMAL_90 * random.normal())
        known = KnownLoad(float(value), share * float(value))
        mine = next((pair for pair in counters if pair[0].serves(known.value)), None)
        if mine is None:
            counter = LifeCounter(bearing, lubricant, WHEEL)
            surface = LifeSurface(bearing, known.value, 1e-4, 2.0 * np.pi * each.shaft_frequency)
            counter._surface = surface
            mine = surface, counter
            counters.append(mine)
        surface, counter = mine
        rated = counter.rate(known, condition_estimates(each, known, bearing, WHEEL), 0.0)
        assert rated is not None
        up, side, play = (np.array([each]) for each in truth.values())
        life = (
            float(surface.lives(up, side, play, np.ones(1), np.full(1, 0.6)).reference_basic[0])
            * np.pi
            * WHEEL
        )
        low, _, high = rated.reference_basic
        ratios.append(log(high / low))
        held += low <= life <= high
    words = f"load known within {100 * share:.0f} %"
    return f"| {words} | {len(found)} | {len(found)} | {np.exp(np.median(ratios)):.1f} | {held} |\n"


def section(folder: Path) -> str:
    """Judge a set and write the section."""
    runs = describe_runs(LabelledSet(folder), None)
    estimator = read_estimator(SHIPPED)
    text = HEAD.format(count=len(runs.descriptors))
    found = {name: errors_of(estimator, runs, name) for name in NAMES}
    text += "".join(row_of(name, each) for name, each in found.items())
    estimates = [estimator.estimates(row[None]) for row in runs.descriptors]
    text += LIFE + f"| load not known | {len(estimates)} | 0 | - | - |\n"
    text += "".join(life_row(estimates, runs, share) for share in SHARES[1:])
    return f"{text}\n{_verdict(found)}\n\n"


def _verdict(found: dict[str, Errors]) -> str:
    """Say in a sentence which numbers the load helps."""
    said = []
    for name, each in found.items():
        if len(each.error) < _FEWEST:
            said.append(f"{BY_NAME[name].words}: too few runs")
            continue
        before, after = (
            float(np.sqrt(np.mean(error**2))) for error in (each.centred(), each.conditioned(SHARES[1]))
        )
        gain = 100.0 * (1.0 - after / before)
        helps = abs(each.correlation) > 1.96 / np.sqrt(len(each.error)) and gain > 0.0
        said.append(f"{BY_NAME[name].words}: {f'{gain:.0f} % less error' if helps else 'nothing'}")
    return f"**Gain of a load known within 3 %.** {'; '.join(said)}. The rating life is given with it alone."


def main(words: Sequence[str] | None = None) -> int:
    """Write the section of the page."""
    parser = argparse.ArgumentParser(prog="python -m evidence.follow.load_gain", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="set of the sweep high_speed_axlebox")
    args = parser.parse_args(words)
    text = with_section(PAGE.read_text(encoding="utf-8"), TITLE, section(args.folder), NEXT)
    PAGE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
