"""Judge an estimator by hidden runs of `full`, by size, speed, noise, box, in docs/evidence/estimator.md.

``python -m evidence.follow.judged --train runs --hidden hidden``: the parts ``learnt`` and ``full`` of the
runs of ``beardyn train --bearing HS130x230``, or sets of ``beardyn sweep``.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated as A
from typing import NamedTuple

import numpy as np
import yaml
from numpy.typing import NDArray
from scipy.stats import binom

from beardyn_core.base.arrays import Float
from beardyn_core.base.config_folder import config_folder
from beardyn_core.follow.conformal import LEVELS
from beardyn_core.follow.descriptors import AXES
from beardyn_core.follow.judging import CROSSWISE, Guessed, judged_crosswise, score_of
from beardyn_core.follow.labelled import (
    Described,
    check_alike,
    check_unseen,
    describe_runs,
    plate_of,
    sampling_of,
)
from beardyn_core.follow.learning import train_estimator
from beardyn_core.follow.quantities import BY_NAME
from beardyn_core.population.labelled_set import TRAIN, VALIDATION, LabelledSet
from evidence.pages import REPORTS, write_section

PAGE = REPORTS / "estimator.md"
TITLE, NEXT = "## By size, speed, noise and box\n", "## What a known load gives\n"
SHOWN = ("width", "lateral_load", "end_play")
WIDTH, SPEED, NOISE = (
    "defects[0].width_mm",
    "operation.speed_profile[0].speed_kmh",
    "sensors[0].noise_density_m_per_s2_per_sqrt_Hz",
)
DAMPING, STIFFNESS = "effects.structure.damping_factor", "effects.structure.stiffness_factor"
ASKED_FROM_MM = 4.0
CHANCE = 0.95
FEWEST = 8  # runs of a class, of which anything is told


class Class(NamedTuple):
    """Runs that are judged together."""

    words: A[str, "in the table"]
    inside: A[NDArray[np.bool_], "shape [run]"]


def classes_of(drawn: Mapping[str, Float], known_box: NDArray[np.bool_]) -> list[Class]:
    """Sort runs by what was drawn for them, each a value a run; `known_box`: as in the runs learnt from."""
    width, speed, noise = drawn[WIDTH], drawn[SPEED], drawn[NOISE]
    found = [Class("all", np.ones(len(speed), bool)), Class("width from 4 mm", width >= ASKED_FROM_MM)]
    for low, high in ((2.0, 4.0), (4.0, 8.0), (8.0, 16.0)):
        found.append(Class(f"width {low:g} to {high:g} mm", (low <= width) & (width < high)))
    for low, high in ((140.0, 180.0), (180.0, 220.0), (220.0, 260.0)):
        found.append(Class(f"{low:g} to {high:g} km/h", (low <= speed) & (speed < high)))
    for low, high in ((0.001, 0.003), (0.003, 0.01), (0.01, 0.03)):
        found.append(Class(f"noise {low:g} to {high:g} m/s²/√Hz", (low <= noise) & (noise < high)))
    found += [Class("box as learnt from", known_box), Class("box beyond", ~known_box)]
    return found


def ranges_of(sweep: str, *keys: str) -> dict[str, tuple[float, float]]:
    """Read the ranges that a shipped sweep draws keys from."""
    text = (config_folder() / "sweeps" / f"{sweep}.yaml").read_text(encoding="utf-8")
    varied = yaml.safe_load(text)["vary"]
    return {each["key"]: (each["low"], each["high"]) for each in varied if each["key"] in keys}


def limits_of(level: float, count: int) -> tuple[float, float]:
    """Give the shares between which chance leaves those of so many runs in 95 of 100."""
    rest = 0.5 * (1.0 - CHANCE)
    low, high = (float(binom.ppf(each, count, level)) / count for each in (rest, 1.0 - rest))
    return low, high


def coverage_table(found: Mapping[str, Guessed]) -> list[str]:
    """Write the shares of runs inside of their intervals beside what chance allows."""
    heads = [f"inside {100 * level:.0f} %" for level in LEVELS]
    lines = [
        f"| quantity | runs | {' | '.join(f'{each} | chance' for each in heads)} |",
        f"|---|--:|{'--:|--:|' * len(heads)}",
    ]
    for name, each in found.items():
        score = score_of(BY_NAME[name], each)
        cells = []
        for level, share in zip(LEVELS, score.coverage, strict=True):
            low, high = limits_of(level, score.runs)
            missed = "" if low <= share <= high else ", outside"
            cells.append(f"{100 * share:.0f} %{missed} | {100 * low:.0f} to {100 * high:.0f} %")
        lines.append(f"| {BY_NAME[name].words} | {score.runs} | {' | '.join(cells)} |")
    return lines


def class_table(found: Mapping[str, Guessed], classes: list[Class]) -> list[str]:
    """Write median error and share inside of the interval of 90 % by class, of what is asked for."""
    shown = [name for name in SHOWN if name in found]
    heads = " | ".join(f"{name.replace('_', ' ')} | in 90 %" for name in shown)
    lines = [f"| runs | {heads} |", f"|---|{'--:|--:|' * len(shown)}"]
    for words, inside in classes:
        cells = []
        for name in shown:
            each = found[name].taken(inside[found[name].places])
            if len(each.truth) < FEWEST:
                cells.append("- | -")
                continue
            quantity, score = BY_NAME[name], score_of(BY_NAME[name], each)
            share = f"{100 * score.error:.0f} %"
            error = share if quantity.relative else quantity.width_text(score.error)
            cells.append(f"{error} of {score.runs} | {100 * score.coverage[-1]:.0f} %")
        lines.append(f"| {words} | {' | '.join(cells)} |")
    return lines


def section(found: Mapping[str, Guessed], classes: list[Class], learnt: int, hidden: int) -> str:
    """Write the section of the page."""
    lines = [
        TITLE,
        "Written by `python -m evidence.follow.judged --train runs --hidden hidden`: learnt from "
        f"{learnt} runs of `quasistatic`, judged crosswise by {hidden} of `full`, a tenth of them at a time "
        "by an estimator that the other nine tenths have put right; of runs for which a number is reported. "
        "*Chance*: where "
        f"{100 * CHANCE:.0f} of 100 such sets lie when the intervals are right.",
        "",
        *coverage_table(found),
        "",
        "Median errors, and the share inside of the interval of 90 %. *Beyond*: damping, stiffness or noise"
        " outside of what was learnt from.",
        "",
        *class_table(found, classes),
        "",
        "",
    ]
    return "\n".join(lines)


def judged(
    train: LabelledSet, hidden: LabelledSet, parts: int = CROSSWISE
) -> tuple[dict[str, Guessed], Described]:
    """Learn from one set, whose validation part widens intervals, and guess the runs of another crosswise."""
    check_alike(train, hidden)
    check_unseen([train], hidden)
    seen, own, unseen = (
        describe_runs(train, TRAIN),
        describe_runs(train, VALIDATION),
        describe_runs(hidden, None),
    )
    sampling = sampling_of(train)
    estimator = train_estimator(seen, plate_of(train), AXES, sampling.rate, sampling.seconds)
    return judged_crosswise(estimator, unseen, parts, own).guessed, unseen


def main(argv: list[str] | None = None) -> int:
    """Judge, print and write."""
    parser = argparse.ArgumentParser(prog="python -m evidence.follow.judged", description=__doc__)
    parser.add_argument("--train", metavar="DIR", type=Path, required=True, help="set that is learnt from")
    parser.add_argument("--hidden", metavar="DIR", type=Path, required=True, help="set that judges")
    args = parser.parse_args(argv)
    train, hidden = LabelledSet(args.train), LabelledSet(args.hidden)
    found, unseen = judged(train, hidden)
    chosen = hidden.runs_of()
    keys = (WIDTH, SPEED, NOISE, DAMPING, STIFFNESS)
    drawn = {key: np.asarray(each, float) for key, each in hidden.labels_of(chosen, keys).items()}
    ranges = ranges_of(train.about["sweep"], NOISE, DAMPING, STIFFNESS)
    within = [(low <= drawn[key]) & (drawn[key] <= high) for key, (low, high) in ranges.items()]
    text = section(
        found, classes_of(drawn, np.all(within, axis=0)), len(train.runs_of(TRAIN)), len(unseen.bearings)
    )
    print(text)
    write_section(PAGE, TITLE, text, NEXT)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
