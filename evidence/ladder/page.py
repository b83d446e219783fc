"""Run the accuracy studies and write docs/evidence/ladder.md with its pictures: ``make ladder``.

Run it on an idle machine: the page holds wall times. ``python -m evidence.ladder.page [SCENE ...] [--quick]
[--duration S] [--to FOLDER]``.
"""

from __future__ import annotations

import argparse
import itertools
import logging
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from tqdm import tqdm

from beardyn_core.base.jit import LANE_WIDTH
from beardyn_core.base.outputs import write_whole
from beardyn_core.choice.load import scene_with_all
from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
from beardyn_core.scene.tier import TIERS
from beardyn_core.study.ladder import REFERENCE_RUNS, climb, comparison_of, compile_levels, expected_wall
from beardyn_core.study.ladder_levels import REFERENCE_LAMINAE, REFERENCE_STEPS, automatic, levels_of
from beardyn_core.study.ladder_picture import ladder_picture
from beardyn_core.study.ladder_report import (
    choices,
    convergence,
    count_words,
    error_text,
    limits_of,
    machine,
    percent,
)
from beardyn_core.study.ladder_result import Ladder, LevelResult
from beardyn_core.study.measures import QUANTITIES, UNITS
from evidence.ladder import front
from evidence.ladder.turns import TURN_S, TURNS, in_turns
from evidence.pages import DOCS, render, save_small
from evidence.tables import markdown

SCENES = ("service_high_speed", "service_high_speed_cup", "wheel_flat")
ACCURACY = 0.05
COLOURS = 96
USUAL_DETAIL = tuple((tier.name, 6, tier.steps_per_sample) for tier in TIERS.values())
USUAL_STEPS = TIERS["full"].steps_per_sample
_BOUGHT = ("force", "deflection", "roller_load", "torque", "vibration")


def climbed(name: str, quick: bool, duration: float | None) -> Ladder:
    """Climb the ladder of a scene, with progress on standard error."""
    scene = scene_with_all(name)
    comparison, levels = comparison_of(scene, duration), levels_of(scene, quick=quick)
    levels = levels.including(automatic(scene, ACCURACY, scene.quantities))

    def told(bar: tqdm) -> Callable[[str, float], None]:
        def progress(level: str, done: float) -> None:
            bar.set_postfix_str(level, refresh=False)
            bar.update(done)

        return progress

    with tqdm(total=len(levels.levels), desc=f"{name}: compiled") as bar:
        compile_levels(comparison, levels, told(bar))
    shown = "{desc} {percentage:.0f} % {bar} {postfix} [{elapsed}<{remaining}]"
    with tqdm(
        total=expected_wall(levels, comparison), desc=f"{name}: run", bar_format=shown, miniters=0
    ) as bar:
        return climb(comparison, levels, ACCURACY, progress=told(bar))


def section(ladder: Ladder, picture: Path) -> dict[str, Any]:
    """Give the numbers of one scene of the page."""
    return {
        "name": ladder.scene,
        "purpose": ladder.purpose,
        "compared": ladder.edges[-1] - ladder.edges[0],
        "turns": count_words(ladder.revolutions, "whole cage revolution"),
        "windows": count_words(len(ladder.edges) - 1, "window"),
        "line": "No fault, so no fault line." if ladder.fault_line is None else _line_sentence(ladder),
        "picture": picture.name,
        "levels": table(ladder),
        "lessons": lessons(ladder),
    }


def _line_sentence(ladder: Ladder) -> str:
    assert ladder.fault_line is not None
    return f"Fault line: {ladder.fault_line.name}, {ladder.fault_line.order:.3f} per shaft revolution."


def table(ladder: Ladder) -> str:
    """Write the table of all levels."""
    columns = [f"{quantity} {UNITS[quantity]}" for quantity in QUANTITIES]
    head = ("level", "wall s/s", "RTF", *columns, percent(ladder.accuracy))
    efficient = {row.level.name for row in ladder.efficient}
    rows: list[tuple[str, ...]] = []
    for row in ladder.by_cost:
        name = f"**{row.level.name}**" if row.level.name in efficient else row.level.name
        wall = row.cost.median
        errors = (error_text(row.of(quantity)) for quantity in QUANTITIES)
        rows.append((name, f"{wall:.3f}", f"{1.0 / wall:.2f}", *errors, ladder.verdict(row)))
    reference = ladder.reference.cost.median
    lines = markdown(head, rows, f"l{'r' * (len(columns) + 2)}l")
    empty = " | ".join("" for _ in columns)
    return f"{lines}\n| reference | {reference:.2f} | {1.0 / reference:.3f} | {empty} | |"


def lessons(ladder: Ladder) -> list[str]:
    """Say what the rows come to when one choice changes and the others stay."""
    found = [
        _cheapest(ladder),
        *(f"{text}." for text in choices(ladder)),
        f"Convergence: {convergence(ladder)}.",
    ]
    full = [row for row in ladder.rows if row.level.tier == "full"]
    usual = [row for row in full if _detail(row) == (6, USUAL_STEPS)]
    usual.sort(key=lambda row: len(row.level.effects.names()))
    for quantity in ("torque", "deflection"):
        title = f"Effects (full tier, 6 laminae x {USUAL_STEPS})"
        found += _along(usual, lambda row: row.level.effects_name, title, quantity)
    every = [row for row in full if row.level.effects_name == "all"]
    found += _along(
        [row for row in every if row.level.steps_per_sample == USUAL_STEPS],
        lambda row: f"{row.level.laminae}",
        f"Laminae (full tier, every effect, x {USUAL_STEPS})",
        "roller_load",
    )
    for quantity in ("torque", "vibration"):
        found += _along(
            sorted((row for row in every if row.level.laminae == 6), key=lambda r: r.level.steps_per_sample),
            lambda row: f"{row.level.steps_per_sample}",
            "Steps for each sample (full tier, every effect, 6 laminae)",
            quantity,
        )
    standard = [row for row in ladder.by_cost if row.level.effects_name == "standard"]
    tiers = [row for row in standard if (row.level.tier, *_detail(row)) in USUAL_DETAIL]
    for quantity in ("deflection", "roller_load", "vibration"):
        found += _along(tiers, lambda row: row.level.tier, "Tiers (standard effects, 6 laminae)", quantity)
    return found


def _detail(row: LevelResult) -> tuple[int, float]:
    return row.level.laminae, row.level.steps_per_sample


def _cheapest(ladder: Ladder) -> str:
    best = ladder.cheapest
    wanted = "; ".join(limits_of(ladder))
    if best is None:
        return f"No level is surely within {percent(ladder.accuracy)} ({wanted})."
    return (
        f"The cheapest level within {percent(ladder.accuracy)} ({wanted}) is *{best.level.name}* at "
        f"{best.cost.median:.2f} s for each simulated second."
    )


def _along(
    rows: list[LevelResult], name: Callable[[LevelResult], str], title: str, quantity: str
) -> list[str]:
    if len(rows) < 2:
        return []
    parts = [
        f"{name(row)}: {error_text(row.of(quantity))} {UNITS[quantity]} for {row.cost.median:.2f} s"
        for row in rows
    ]
    return [f"{title}, {quantity} error: {'; '.join(parts)}."]


def efficient_levels(ladders: Sequence[Ladder]) -> str:
    """Write the efficient levels of all scenes side by side, with the errors that each one buys."""
    columns = [f"{quantity} {UNITS[quantity]}" for quantity in _BOUGHT]
    rows = [
        (
            ladder.scene,
            row.level.name,
            f"{row.cost.median:.3f}",
            *(error_text(row.of(quantity)) for quantity in _BOUGHT),
            ladder.verdict(row),
        )
        for ladder in ladders
        for row in ladder.efficient
    ]
    head = ("scene", "level", "wall s/s", *columns, percent(ACCURACY))
    return markdown(head, rows, f"ll{'r' * (len(columns) + 1)}l")


def page(ladders: Sequence[Ladder], pictures: Sequence[Path], neighbour: str) -> str:
    """Put the whole page together, with the name of the level next to the reference."""
    values = {
        "processor": machine()["processor"],
        "lanes": LANE_WIDTH,
        "laminae": REFERENCE_LAMINAE,
        "steps": REFERENCE_STEPS,
        "reference_rate": WAVEFORM_RATE * REFERENCE_STEPS,
        "neighbour": neighbour,
        "runs": REFERENCE_RUNS,
        "turn": TURN_S,
        "turns": TURNS,
        "accuracy": percent(ACCURACY),
        "efficient": efficient_levels(ladders),
        "rungs": [_rungs(ladder) for ladder in ladders],
        "scenes": [section(ladder, path) for ladder, path in zip(ladders, pictures, strict=True)],
    }
    return render(__file__, values)


def _rungs(ladder: Ladder) -> str:
    """Say how far apart the efficient levels of a scene are in cost."""
    costs = [row.cost.median for row in ladder.efficient]
    apart = ", ".join(f"{dear / cheap:.1f}" for cheap, dear in itertools.pairwise(costs))
    return (
        f"- `{ladder.scene}`: {costs[0]:.3f} to {costs[-1]:.1f} s a second, in steps of {apart or 'none'} "
        "(aimed at: from 0.003 s on, in steps of ten)."
    )


def main() -> None:
    """Climb and write."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE")
    parser.add_argument("--quick", action="store_true", help="few levels")
    parser.add_argument("--duration", type=float, metavar="S", help="simulated time compared")
    parser.add_argument("--to", type=Path, default=DOCS, metavar="FOLDER")
    arguments = parser.parse_args()
    pictures = arguments.to / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    logging.getLogger("beardyn").setLevel(logging.WARNING)
    ladders, paths = [], []
    for name in arguments.scenes:
        ladder = climbed(name, arguments.quick, arguments.duration)
        if ladder.interrupted:
            sys.exit("interrupted: the page is left as it was")
        ladder = in_turns(ladder, scene_with_all(name))
        picture = pictures / f"ladder_{name}.png"
        ladder_picture(ladder, picture)
        save_small(picture, picture, COLOURS)
        ladders.append(ladder)
        paths.append(picture)
    neighbour = levels_of(scene_with_all(arguments.scenes[0])).neighbour.name
    write_whole(arguments.to / "evidence" / "ladder.md", page(ladders, paths, neighbour))
    if arguments.to == DOCS:
        front.main()


if __name__ == "__main__":
    main()
