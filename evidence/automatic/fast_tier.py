"""Compare `quasistatic` with `full` at a fine step, six runs of each: docs/evidence/fast_tier.md.

Coupled slices (laminae) and the effects of the automatic choice for 8 kHz; one, two and four steps a sample.
The reference has every effect and 8 steps. Some minutes a scene:
``python -m evidence.automatic.fast_tier [SCENE ...] [--keep FOLDER] [--to FILE]``; finished scenes are kept.
"""

from __future__ import annotations

import argparse
import json
import logging
from collections.abc import Iterator, Sequence
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import Any

from beardyn_core.choice.load import complete_scene, scene_with_all, with_coupled_laminae
from beardyn_core.config import read_scene
from beardyn_core.scene.scene import Scene
from beardyn_core.study.ladder import climb, comparison_of, compile_levels
from beardyn_core.study.ladder_levels import (
    AUTO,
    REFERENCE_LAMINAE,
    REFERENCE_STEPS,
    Level,
    level_of,
    levels_of,
)
from beardyn_core.study.ladder_report import count_words, error_text, machine
from beardyn_core.study.ladder_result import Ladder, LevelResult
from beardyn_core.study.measures import UNITS
from evidence.automatic.page import MEANS, keep_bands
from evidence.ladder.turns import in_turns
from evidence.pages import REPORTS, write_page
from evidence.runner import kept_json

PAGE = REPORTS / "fast_tier.md"
SCENES = (
    *("smooth_run", "cup_spall", "cone_spall", "roller_spall", "wheel_flat"),
    *("service_high_speed", "service_high_speed_cup", "service_freight"),
)
STEPS = (1, 2, 4)
RUNS = 6
BANDS = (1_000.0, 5_000.0, 8_000.0)  # [Hz]
LIMIT_DB, LIMIT = 1.5, 0.05
FULL = "full"


def coupled(name: str, tier: str) -> Scene:
    """Choose the effects of a tier for 8 kHz; the fast one keeps coupled slices."""
    read = read_scene(name, {("tier",): tier, ("effects",): "auto"})
    read = replace(read, scene=replace(read.scene, vibration_to=BANDS[-1]))
    return complete_scene((tier != FULL and with_coupled_laminae(read)) or read)


def levels(name: str) -> Iterator[Level]:
    """List what is compared with the reference: the fast tier at each step, and `full` as it is chosen."""
    fast = level_of(coupled(name, "quasistatic"), AUTO)
    for steps in STEPS:
        yield replace(fast, name=str(steps), steps_per_sample=steps)
    yield level_of(coupled(name, FULL), AUTO, name=FULL)


def judged(name: str) -> list[dict[str, Any]]:
    """Run a scene and judge each level."""
    scene = scene_with_all(name)
    comparison = comparison_of(scene)
    every = replace(levels_of(scene, quick=True), levels=tuple(levels(name)))
    compile_levels(comparison, every)
    ladder = climb(comparison, every, LIMIT, reference_runs=RUNS, least_runs=RUNS)
    if ladder.interrupted:
        raise KeyboardInterrupt
    ladder = in_turns(ladder, scene)
    own = next(row.cost.median for row in ladder.rows if row.level.name == FULL)
    return [found(ladder, row, own) for row in ladder.rows]


def found(ladder: Ladder, row: LevelResult, full_cost: float) -> dict[str, Any]:
    """Write down what a level misses; `full_cost`: of `full` as it is chosen, [s] a simulated second."""
    vibration = {f"{to:g}": keep_bands(row, to) for to in BANDS}
    return {
        "scene": ladder.scene,
        "tier": row.level.tier,
        "laminae": row.level.laminae,
        "steps": row.level.steps_per_sample,
        "status": row.status,
        "bands": {to: error_text(each.of("vibration")) for to, each in vibration.items()},
        "loudest": _where(vibration[f"{BANDS[-1]:g}"]),
        "means": {name: f"{error_text(row.of(name))} {UNITS[name]}" for name in MEANS},
        "verdict": vibration[f"{BANDS[-1]:g}"].verdict(("vibration",), LIMIT),
        "of_means": row.verdict(MEANS, LIMIT),
        "seconds": row.cost.median,
        "faster": full_cost / row.cost.median,
        "day": date.today().isoformat(),
    }


def _where(row: LevelResult) -> str:
    """Name the third octave that is farthest off, with its error and doubt."""
    error = row.of("vibration")
    part = None if error is None else error.worst
    return "-" if part is None else f"{part.error:+.1f} ± {part.margin:.1f} at {part.name}"


def cells(case: dict[str, Any]) -> tuple[str, ...]:
    """Write a level as cells of the table."""
    level = "`full`" if case["tier"] == FULL else "`quasistatic`"
    return (
        f"`{case['scene']}`",
        f"{level}, {case['laminae']} x {case['steps']:g}",
        *(case["bands"][f"{to:g}"] for to in BANDS),
        case["loudest"],
        case["verdict"],
        *(case["means"][name].removesuffix(" %") for name in MEANS),
        case["of_means"],
        f"{1.0 / case['seconds']:.2g}",
        f"{case['faster']:.1f}",
    )


def sum_up(cases: Sequence[dict[str, Any]]) -> list[str]:
    """Say for each step how many scenes are within the limits, and the slowest ratio to `full`."""
    fast = [case for case in cases if case["tier"] != FULL]
    lines = []
    for steps in STEPS:
        these = [case for case in fast if case["steps"] == steps]
        octaves = sum(case["verdict"] == "yes" for case in these)
        means = sum(case["of_means"] == "yes" for case in these)
        open_ones = sum(case["verdict"] == "open" for case in these)
        times = [case["faster"] for case in these]
        lines.append(
            f"{count_words(steps, 'step')} a sample: third octaves to {BANDS[-1] / 1e3:g} kHz within "
            f"{LIMIT_DB:g} dB in {octaves} of {len(these)} scenes ({open_ones} open), force, deflection, "
            f"roller load and torque within {100 * LIMIT:g} % in {means}; {min(times):.1f} to "
            f"{max(times):.1f} times as fast as `full`"
        )
    return lines


def main(arguments: Sequence[str] | None = None) -> int:
    """Run what is not kept yet, and write the page."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scenes", nargs="*", default=list(SCENES), metavar="SCENE")
    parser.add_argument("--keep", type=Path, default=Path("fast_tier"), metavar="FOLDER")
    parser.add_argument("--to", type=Path, default=PAGE, metavar="FILE")
    given = parser.parse_args(arguments)
    logging.getLogger("beardyn").setLevel(logging.WARNING)
    cases: list[dict[str, Any]] = []
    for name in given.scenes:
        cases += kept_json(given.keep / f"{name}.json", lambda name=name: judged(name))  # type: ignore[misc]
        print(json.dumps(cases[-len(STEPS) - 1 :]), flush=True)
    values = {
        "laminae": REFERENCE_LAMINAE,
        "steps": REFERENCE_STEPS,
        "runs": RUNS,
        "limit_dB": LIMIT_DB,
        "limit": 100.0 * LIMIT,
        "to": BANDS[-1] / 1e3,
        "processor": machine()["processor"],
        "summary": sum_up(cases),
        "rows": [cells(case) for case in cases],
    }
    write_page(__file__, given.to, values)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
