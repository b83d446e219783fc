"""Put what `effects: auto` chooses on trial and write docs/evidence/automatic.md: ``make automatic``.

Every case is a scene, the quantities asked for and an accuracy. What is chosen for it runs against the
converged reference of the ladder; what a band leaves open runs once more, six times as long and
more often. Finished scenes are kept in ``--keep``, so that a run that was cut off goes on; an edit of the
package begins anew, one of the rules only where they choose otherwise. The page is written after every
scene and keeps the rows of scenes that are not asked for. Two hours or three for all:
``python -m evidence.automatic.page [SCENE ...] [--keep FOLDER] [--to FILE]``.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import logging
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from datetime import date
from pathlib import Path
from typing import Annotated as A
from typing import Any

import beardyn_core
from beardyn_core.choice.rule import Choice, percent
from beardyn_core.config.yaml_text import scene_text
from beardyn_core.effects import EffectSet
from beardyn_core.experiments.code_digest import files_digest
from beardyn_core.scene.scene import Scene
from beardyn_core.study.ladder import REFERENCE_RUNS, climb, comparison_of, compile_levels
from beardyn_core.study.ladder_levels import (
    AUTO,
    REFERENCE_LAMINAE,
    REFERENCE_STEPS,
    chosen_for,
    level_of,
    levels_of,
)
from beardyn_core.study.ladder_report import error_text
from beardyn_core.study.ladder_result import Ladder, LevelResult, QuantityError
from beardyn_core.study.measures import NOMINAL_BANDS, UNITS
from evidence.pages import REPORTS, write_page
from evidence.runner import kept_json
from evidence.standard import standard_scene

FORCES = ("force", "deflection", "roller_load")
MEANS = (*FORCES, "torque")
USUAL = (*MEANS, "vibration")


@dataclass(frozen=True)
class Case:
    """What is asked of a choice."""

    asked: tuple[str, ...]
    accuracy: A[float, "a share"]
    to: A[float | None, "highest third octave, [Hz]; ``None``: 10 kHz"] = None


CASES: dict[str, tuple[Case, ...]] = {
    "static_80kN": (Case(USUAL, 0.05), Case(("force",), 0.05), Case(FORCES, 0.01)),
    "static_5kN": (Case((*MEANS, "cage_speed"), 0.05),),
    "smooth_run": (
        *(Case(USUAL, 0.05), Case(USUAL, 0.05, 5000.0), Case(USUAL, 0.05, 400.0)),
        *(Case(MEANS, 0.05), Case(MEANS, 0.2)),
    ),
    "cup_spall": (Case(USUAL, 0.05), Case(FORCES, 0.1)),
    "cone_spall": (Case(USUAL, 0.05),),
    "roller_spall": (Case(USUAL, 0.05),),
    "oversize_roller": (Case(MEANS, 0.05),),
    "worn_pocket": (Case(USUAL, 0.05),),
    "waviness": (Case(USUAL, 0.05),),
    "wheel_flat": (Case(USUAL, 0.05), Case(FORCES, 0.05)),
    "healthy_80": (Case(USUAL, 0.05),),
    "healthy_300": (Case(USUAL, 0.05),),
    "polygon_wheel": (Case(USUAL, 0.05),),
    "spall_and_flat": (Case(USUAL, 0.05),),
    "service_high_speed": (Case(USUAL, 0.05), Case(MEANS, 0.05)),
    "service_high_speed_cup": (Case(USUAL, 0.05),),
    "service_freight": (Case(USUAL, 0.05),),
    "service_freight_cone": (Case(USUAL, 0.05),),
    "service_metro": (Case(USUAL, 0.05),),
    "service_metro_roller": (Case(USUAL, 0.05),),
}
PAGE = REPORTS / "automatic.md"
# where a band crosses the limit: times, of what is compared, and runs of the chosen and of the reference
LONGER, MORE_RUNS, MORE_REFERENCE_RUNS = 6, 24, 12


def tried(
    scene: Scene, choices: Sequence[Choice], chosen: Sequence[int], longer: int
) -> list[dict[str, Any]]:
    """Run the chosen of a scene's cases, one reference for all of them, so many times as long as usual.

    What is run longer is also run more often: two runs may stay as far apart as they began to be.
    """
    comparison = comparison_of(scene)
    if longer > 1:
        comparison = comparison_of(
            scene,
            duration=longer * (comparison.edges[-1] - comparison.settling),
            settling=comparison.settling,
        )
    levels = tuple(level_of(choices[k].applied(scene), AUTO, name=f"case {k}") for k in chosen)
    few = replace(levels_of(scene, quick=True), levels=levels)
    compile_levels(comparison, few)
    if longer > 1:
        ladder = climb(comparison, few, 0.05, reference_runs=MORE_REFERENCE_RUNS, least_runs=MORE_RUNS)
    else:
        ladder = climb(comparison, few, 0.05)
    if ladder.interrupted:
        raise KeyboardInterrupt
    rows = [next(row for row in ladder.rows if row.level == level) for level in levels]
    return [
        _case(ladder, row, CASES[scene.name][k], choices[k]) | {"longer": longer}
        for k, row in zip(chosen, rows, strict=True)
    ]


def _case(ladder: Ladder, row: LevelResult, case: Case, choice: Choice) -> dict[str, Any]:
    asked, row = case.asked, keep_bands(row, case.to)
    return {
        "scene": ladder.scene,
        "asked": list(asked),
        "accuracy": case.accuracy,
        "to": case.to,
        "tier": choice.tier,
        "laminae": choice.laminae,
        "steps_per_sample": choice.steps_per_sample,
        "effects": list(choice.effects.names()),
        "missing": [n for n in ladder.reference.level.effects.names() if n not in choice.effects.names()],
        "simpler": _simpler(choice.effects, ladder.reference.level.effects),
        "found": {name: f"{error_text(row.of(name))} {UNITS[name]}" for name in asked},
        "status": row.status,
        "seconds": row.cost.median,
        "reference_seconds": ladder.reference.cost.median,
        "verdict": row.verdict(asked, case.accuracy),
        "doubt": {name: _doubt(row.of(name)) for name in asked},
        "day": date.today().isoformat(),
    }


def keep_bands(row: LevelResult, to: float | None) -> LevelResult:
    """Leave out the third octaves above a frequency, [Hz]."""
    if to is None:
        return row
    bands = {f"{band:g} Hz" for band in NOMINAL_BANDS if band <= to}
    errors = (
        replace(error, parts=tuple(part for part in error.parts if part.name in bands))
        if error.quantity == "vibration"
        else error
        for error in row.errors
    )
    return replace(row, errors=tuple(errors))


def _simpler(chosen: EffectSet, every: EffectSet) -> list[str]:
    """Name the effects that are chosen, but with other options than the reference has."""
    return [name for name in chosen.names() if getattr(chosen, name) != getattr(every, name)]


def _doubt(error: QuantityError | None) -> str:
    """Write the component that may be farthest off."""
    if error is None or not error.parts:
        return "-"
    part = max(error.parts, key=lambda part: abs(part.error) + part.margin)
    factor, unit = (100.0, " %") if error.unit == "%" else (1.0, " dB")
    return f"{part.name}: {factor * part.error:+.2g} ± {factor * part.margin:.2g}{unit}"


def _expected_of(choice: Choice) -> dict[str, str]:
    """Write what the rules expect of each quantity that is asked for."""
    factors = {name: 1.0 if UNITS[name] == "dB" else 100.0 for name in choice.expected if name in UNITS}
    return {name: f"{factor * choice.expected[name]:.2g}" for name, factor in factors.items()}


def row(case: dict[str, Any]) -> str:
    """Write a case as a row of the page."""
    few = len(case["effects"]) < len(case["missing"])
    effects = ", ".join(case["effects"]) if few else "all less " + (", ".join(case["missing"]) or "nothing")
    effects += f"; simpler {', '.join(case['simpler'])}" if case["simpler"] else ""
    asked = ", ".join(case["asked"])
    asked += f" to {1e-3 * case['to']:g} kHz" if case["to"] else ""
    asked += f" at {percent(case['accuracy'])}"
    chosen = f"{case['tier']}, {case['laminae']} laminae x {case['steps_per_sample']}: {effects}"
    found = "; ".join(f"{name} {case['found'][name]} (*{case['expected'][name]}*)" for name in case["asked"])
    status = "" if case["status"] == "complete" else f"; {case['status']}"
    longer = f", {case['longer']} times as long" if case["longer"] > 1 else ""
    if case["verdict"] == "open":
        longer += f" ({'; '.join(case['doubt'][name] for name in case['asked'] if UNITS[name] == 'dB')})"
    verdict = f"{case['verdict']}{longer}"
    return f"| `{case['scene']}` | {asked} | {chosen} | {found}{status} | {verdict} | {case['day']} |"


def merged(page: str, name: str, rows: Sequence[str]) -> list[str]:
    """Put the rows of a scene among those that a page has of the others, in the order of the cases."""
    there: dict[str, list[str]] = {each: [] for each in CASES}
    for line in page.splitlines():
        if line.startswith("| `") and (scene := line.split("`")[1]) in there:
            there[scene].append(line)
    return [line for each, kept in there.items() for line in (rows if each == name else kept)]


class Kept:
    """Results in a folder, by scene and by what they depend on."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def cases(self, name: str, longer: int = 1) -> list[dict[str, Any]]:
        """Give the cases of a scene, those that are open from a longer run; run what is not there yet."""
        scene = standard_scene(name)
        choices = [chosen_for(scene, case.accuracy, case.asked, case.to) for case in CASES[name]]
        path = self._folder / f"{name}-{digest_of(scene, choices)}.json"
        found = self._read(path, scene, choices, range(len(choices)), 1)
        undecided = [k for k, case in enumerate(found) if case["verdict"] == "open"]
        if longer > 1 and undecided:
            which = f"{longer}x{MORE_RUNS}x{MORE_REFERENCE_RUNS}-{'_'.join(map(str, undecided))}"
            path = path.with_stem(f"{path.stem}-{which}")
            for k, case in zip(undecided, self._read(path, scene, choices, undecided, longer), strict=True):
                found[k] = case
        return [case | {"expected": _expected_of(each)} for case, each in zip(found, choices, strict=True)]

    def _read(
        self, path: Path, scene: Scene, choices: Sequence[Choice], chosen: Sequence[int], longer: int
    ) -> list[dict[str, Any]]:
        return list(kept_json(path, lambda: tried(scene, choices, chosen, longer)))


def digest_of(scene: Scene, choices: Sequence[Choice]) -> str:
    """Give what a result depends on: the code without its rules, what is asked, and all that was chosen."""
    digest = hashlib.sha256(_CODE.encode())
    for choice, case in zip(choices, CASES[scene.name], strict=True):
        digest.update(scene_text(choice.applied(scene)).encode())
        digest.update(json.dumps(asdict(case)).encode())
    return digest.hexdigest()[:12]


_PACKAGE = Path(beardyn_core.__path__[0])
# without its rules, as it is when this process begins
_CODE = files_digest(
    (path for path in _PACKAGE.rglob("*.py") if not path.is_relative_to(_PACKAGE / "choice")), _PACKAGE
)


def main() -> None:
    """Run what is not kept yet, and write the page."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scenes", nargs="*", default=list(CASES), metavar="SCENE")
    parser.add_argument("--keep", type=Path, default=Path("automatic"), metavar="FOLDER")
    parser.add_argument("--once", action="store_true", help="leave open what one look leaves open")
    parser.add_argument("--to", type=Path, default=PAGE, metavar="FILE")
    arguments = parser.parse_args()
    logging.getLogger("beardyn").setLevel(logging.WARNING)
    kept = Kept(arguments.keep)
    for name in arguments.scenes:
        rows = [row(case) for case in kept.cases(name, 1 if arguments.once else LONGER)]
        print("\n".join(rows), flush=True)
        page = arguments.to.read_text(encoding="utf-8") if arguments.to.exists() else ""
        values = {
            "laminae": REFERENCE_LAMINAE,
            "steps": REFERENCE_STEPS,
            "runs": REFERENCE_RUNS,
            "longer": LONGER,
            "more": MORE_RUNS,
            "references": MORE_REFERENCE_RUNS,
            "rows": merged(page, name, rows),
        }
        write_page(__file__, arguments.to, values)


if __name__ == "__main__":
    main()
