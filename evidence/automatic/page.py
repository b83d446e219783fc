"""Put what `effects: auto` chooses on trial and write docs/automatic.md: ``make automatic``.

Every case is a scene, the quantities asked for and an accuracy. What is chosen for it runs against the
converged reference of the ladder; what a band leaves open runs once more, three times as long. Finished
scenes are kept in ``--keep``, so that a run that was cut off goes on; an edit of the package begins anew, one
of the rules only where they choose otherwise. An hour or two:
``python -m evidence.automatic.page [SCENE ...] [--keep FOLDER] [--to FILE]``.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import logging
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import beardyn_core
from beardyn_core.choice.rule import Choice, percent
from beardyn_core.scene.scene import Scene
from beardyn_core.study.ladder import REFERENCE_RUNS, Plan, climb, compile_levels, plan_of
from beardyn_core.study.ladder_levels import (
    AUTO,
    REFERENCE_LAMINAE,
    REFERENCE_STEPS,
    Level,
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
LONGER = 3  # times, of what is compared where a band crosses the limit

HEAD = """# The automatic choice on trial

Written by `make automatic`. What `effects: auto` [chooses](effects_auto.md) for a scene, run against the
converged reference of the [ladder](ladder.md): every effect, {laminae} laminae, {steps} steps for each sample
of 25.6 kHz, {runs} runs. Errors are those of the ladder, the worst component of a quantity, in brackets when
they are inside the run-to-run band; behind them what the rules had *expected*. *yes*: every component of what
is asked for is within the accuracy, each with 95 % certainty (a choice that fails anywhere passes with 5 % at
most); *no*: one is beyond it with its whole band; *open*: the runs are too short to tell. Doubt shrinks with
what is compared, so a case that is open is run once more, {longer} times as long; its row is of that run.

| scene | asked | chosen | found (*expected*) | verdict |
|---|---|---|---|---|
"""


def tried(scene: Scene, choices: Sequence[Choice]) -> Iterator[dict[str, Any]]:
    """Run the cases of a scene, one reference for all of them; those left open once more, longer."""
    levels = [
        level_of(choice.applied(scene), AUTO, name=f"case {number}") for number, choice in enumerate(choices)
    ]
    plan = plan_of(scene)
    cases = [
        partial(_case, asked=asked, accuracy=accuracy, choice=choice)
        for (asked, accuracy), choice in zip(CASES[scene.name], choices, strict=True)
    ]
    found = [case(*judged) for case, judged in zip(cases, _climbed(plan, levels), strict=True)]
    undecided = [k for k, case in enumerate(found) if case["verdict"] == "open"]
    if undecided:
        longer = plan_of(scene, duration=LONGER * (plan.edges[-1] - plan.settling), settling=plan.settling)
        again = _climbed(longer, [levels[k] for k in undecided])
        for k, judged in zip(undecided, again, strict=True):
            found[k] = {**cases[k](*judged), "longer": LONGER}
    yield from found


def _climbed(plan: Plan, levels: Sequence[Level]) -> list[tuple[Ladder, LevelResult]]:
    """Run levels against the reference, and give each with its ladder, in their order."""
    few = replace(levels_of(plan.scene, quick=True), levels=tuple(levels))
    compile_levels(plan, few)
    ladder = climb(plan, few, 0.05)
    if ladder.interrupted:
        raise KeyboardInterrupt
    return [(ladder, next(row for row in ladder.rows if row.level == level)) for level in levels]


def _case(
    ladder: Ladder, row: LevelResult, asked: tuple[str, ...], accuracy: float, choice: Choice
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
        "found": {name: f"{error_text(row.of(name))} {UNITS[name]}" for name in asked},
        "status": row.status,
        "seconds": row.cost.median,
        "reference_seconds": ladder.reference.cost.median,
        "verdict": row.verdict(asked, accuracy),
    }


def _expected_of(choice: Choice) -> dict[str, str]:
    """Write what the rules expect of each quantity that is asked for."""
    factors = {name: 1.0 if UNITS[name] == "dB" else 100.0 for name in choice.expected if name in UNITS}
    return {name: f"{factor * choice.expected[name]:.2g}" for name, factor in factors.items()}


def row(case: dict[str, Any]) -> str:
    """Write a case as a row of the page."""
    few = len(case["effects"]) < len(case["missing"])
    effects = ", ".join(case["effects"]) if few else "full less " + (", ".join(case["missing"]) or "nothing")
    asked = f"{', '.join(case['asked'])} at {percent(case['accuracy'])}"
    chosen = f"{case['tier']}, {case['laminae']} laminae x {case['steps_per_sample']}: {effects}"
    found = "; ".join(f"{name} {case['found'][name]} (*{case['expected'][name]}*)" for name in case["asked"])
    status = "" if case["status"] == "complete" else f"; {case['status']}"
    longer = f", {case['longer']} times as long" if "longer" in case else ""
    return f"| `{case['scene']}` | {asked} | {chosen} | {found}{status} | {case['verdict']}{longer} |"


def _digest_of(scene: Scene, choices: Sequence[Choice]) -> str:
    """Give what a result depends on: the package without its rules, and what they have chosen."""
    digest = hashlib.sha256()
    package = Path(beardyn_core.__path__[0])
    for path in sorted(package.rglob("*.py")):
        if path.relative_to(package).parts[0] != "choice":
            digest.update(path.read_bytes())
    for choice in choices:
        digest.update(repr(choice.applied(scene)).encode())
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
    rows = []
    for name in arguments.scenes:
        scene = standard_scene(name)
        choices = [chosen_for(scene, accuracy, asked) for asked, accuracy in CASES[name]]
        kept = arguments.keep / f"{name}-{_digest_of(scene, choices)}.json"
        if not kept.exists():
            kept.write_text(json.dumps(list(tried(scene, choices)), indent=1), encoding="utf-8")
        for case, choice in zip(json.loads(kept.read_text(encoding="utf-8")), choices, strict=True):
            rows.append(row(case | {"expected": _expected_of(choice)}))
            print(rows[-1], flush=True)
    head = HEAD.format(laminae=REFERENCE_LAMINAE, steps=REFERENCE_STEPS, runs=REFERENCE_RUNS, longer=LONGER)
    arguments.to.write_text(head + "\n".join(rows) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
