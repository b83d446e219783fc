"""Put what `effects: auto` chooses on trial and write docs/automatic.md: ``make automatic``.

Every case is a scene, the quantities asked for and an accuracy. What is chosen for it runs against the
converged reference of the ladder. Finished scenes are kept in ``--keep``, so that a run that was cut off goes
on; an edit of the package begins anew. About an hour:
``python -m evidence.automatic.page [SCENE ...] [--keep FOLDER] [--to FILE]``.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import logging
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import beardyn_core
from beardyn_core.choice.rule import Choice, percent
from beardyn_core.study.ladder import REFERENCE_RUNS, climb, compile_levels, plan_of
from beardyn_core.study.ladder_levels import (
    AUTO,
    REFERENCE_LAMINAE,
    REFERENCE_STEPS,
    LevelList,
    chosen_for,
    level_of,
    levels_of,
)
from beardyn_core.study.ladder_report import error_text
from beardyn_core.study.ladder_result import Ladder, LevelResult
from beardyn_core.study.measures import UNITS
from evidence.pages import DOCS
from evidence.standard import standard_scene

FORCES = ("force", "deflection", "roller_load")
MEANS = (*FORCES, "torque")
USUAL = (*MEANS, "vibration")
CASES: dict[str, tuple[tuple[tuple[str, ...], float], ...]] = {
    "static_80kN": ((USUAL, 0.05), (("force",), 0.05), (FORCES, 0.01)),
    "static_5kN": (((*MEANS, "cage_speed"), 0.05),),
    "smooth_run": ((USUAL, 0.05), (MEANS, 0.05), (MEANS, 0.2)),
    "cup_spall": ((USUAL, 0.05), (FORCES, 0.1)),
    "cone_spall": ((USUAL, 0.05),),
    "roller_spall": ((USUAL, 0.05),),
    "oversize_roller": ((MEANS, 0.05),),
    "worn_pocket": ((USUAL, 0.05),),
    "waviness": ((USUAL, 0.05),),
    "wheel_flat": ((USUAL, 0.05), (FORCES, 0.05)),
    "healthy_80": ((USUAL, 0.05),),
    "healthy_300": ((USUAL, 0.05),),
    "polygon_wheel": ((USUAL, 0.05),),
    "spall_and_flat": ((USUAL, 0.05),),
    "service_high_speed": ((USUAL, 0.05), (MEANS, 0.05)),
    "service_high_speed_cup": ((USUAL, 0.05),),
    "service_freight": ((USUAL, 0.05),),
    "service_freight_cone": ((USUAL, 0.05),),
    "service_metro": ((USUAL, 0.05),),
    "service_metro_roller": ((USUAL, 0.05),),
}
PAGE = DOCS / "automatic.md"

HEAD = """# The automatic choice on trial

Written by `make automatic`. What `effects: auto` [chooses](effects_auto.md) for a scene, run against the
converged reference of the [ladder](ladder.md): every effect, {laminae} laminae, {steps} steps for each sample
of 25.6 kHz, {runs} runs. Errors are those of the ladder, the worst component of a quantity, in brackets when
they are inside the run-to-run band; behind them what the rules had *expected*. *yes*: all asked errors are
within the accuracy, with their whole bands; *open*: a band crosses the limit; *no*: an error is beyond it
with its whole band.

| scene | asked | chosen | found (*expected*) | verdict |
|---|---|---|---|---|
"""


def tried(name: str) -> Iterator[dict[str, Any]]:
    """Run the cases of a scene, one reference for all of them."""
    scene = standard_scene(name)
    plan = plan_of(scene)
    choices = [chosen_for(scene, accuracy, asked) for asked, accuracy in CASES[name]]
    levels = tuple(
        level_of(choice.applied(scene), AUTO, name=f"case {number}") for number, choice in enumerate(choices)
    )
    few = replace(levels_of(scene, quick=True), levels=levels)
    compile_levels(plan, few, lambda _name, _count: None)
    ladder = climb(plan, LevelList(few.reference, few.neighbour, levels), 0.05)
    if ladder.interrupted:
        raise KeyboardInterrupt
    for (asked, accuracy), choice, level in zip(CASES[name], choices, levels, strict=True):
        row = next(row for row in ladder.rows if row.level == level)
        yield _case(ladder, row, choice, asked, accuracy)


def _case(
    ladder: Ladder, row: LevelResult, choice: Choice, asked: tuple[str, ...], accuracy: float
) -> dict[str, Any]:
    return {
        "scene": ladder.scene,
        "asked": list(asked),
        "accuracy": accuracy,
        "tier": choice.tier,
        "laminae": choice.laminae,
        "steps_per_sample": choice.steps_per_sample,
        "effects": list(choice.effects.names()),
        "missing": [n for n in ladder.reference.level.effects.names() if n not in choice.effects.names()],
        "expected": {name: _expected(choice, name) for name in asked},
        "found": {name: f"{error_text(row.of(name))} {UNITS[name]}" for name in asked},
        "status": row.status,
        "seconds": row.cost.median,
        "reference_seconds": ladder.reference.cost.median,
        "verdict": row.verdict(asked, accuracy),
    }


def _expected(choice: Choice, name: str) -> str:
    error = choice.expected[name]
    return f"{error:.2g}" if UNITS[name] == "dB" else f"{100.0 * error:.2g}"


def row(case: dict[str, Any]) -> str:
    """Write a case as a row of the page."""
    few = len(case["effects"]) < len(case["missing"])
    effects = ", ".join(case["effects"]) if few else "full less " + (", ".join(case["missing"]) or "nothing")
    asked = f"{', '.join(case['asked'])} at {percent(case['accuracy'])}"
    chosen = f"{case['tier']}, {case['laminae']} laminae x {case['steps_per_sample']}: {effects}"
    found = "; ".join(f"{name} {case['found'][name]} (*{case['expected'][name]}*)" for name in case["asked"])
    status = "" if case["status"] == "complete" else f"; {case['status']}"
    return f"| `{case['scene']}` | {asked} | {chosen} | {found}{status} | {case['verdict']} |"


def _hash_of_sources() -> str:
    digest = hashlib.sha256()
    for path in sorted(Path(beardyn_core.__path__[0]).rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


def main() -> None:
    """Run what is not kept yet, and write the page."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scenes", nargs="*", default=list(CASES), metavar="SCENE")
    parser.add_argument("--keep", type=Path, default=Path("automatic"), metavar="FOLDER")
    parser.add_argument("--to", type=Path, default=PAGE, metavar="FILE")
    arguments = parser.parse_args()
    arguments.keep.mkdir(parents=True, exist_ok=True)
    logging.getLogger("beardyn").setLevel(logging.WARNING)
    rows, sources = [], _hash_of_sources()
    for name in arguments.scenes:
        kept = arguments.keep / f"{name}-{sources}.json"
        if not kept.exists():
            kept.write_text(json.dumps(list(tried(name)), indent=1), encoding="utf-8")
        rows += [row(case) for case in json.loads(kept.read_text(encoding="utf-8"))]
        print(rows[-1], flush=True)
    head = HEAD.format(laminae=REFERENCE_LAMINAE, steps=REFERENCE_STEPS, runs=REFERENCE_RUNS)
    arguments.to.write_text(head + "\n".join(rows) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
