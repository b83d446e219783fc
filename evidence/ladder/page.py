"""Climb the ladders of the documentation and write docs/ladder.md with its pictures: ``make ladder``.

Run it on an idle machine: the page holds wall times. ``python -m evidence.ladder.page [SCENE ...] [--quick]
[--duration S] [--to FOLDER]``.
"""

from __future__ import annotations

import argparse
import itertools
import logging
import sys
from collections.abc import Callable
from pathlib import Path

from tqdm import tqdm

from beardyn_core.base.jit import LANE_WIDTH
from beardyn_core.choice.load import scene_with_all
from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
from beardyn_core.scene.tier import TIERS
from beardyn_core.study.ladder import REFERENCE_RUNS, climb, comparison_of, compile_levels, expected_wall
from beardyn_core.study.ladder_levels import REFERENCE_LAMINAE, REFERENCE_STEPS, automatic, levels_of
from beardyn_core.study.ladder_picture import ladder_picture
from beardyn_core.study.ladder_report import (
    choices,
    convergence,
    counted,
    error_text,
    limits_of,
    machine,
    percent,
)
from beardyn_core.study.ladder_result import Ladder, LevelResult
from beardyn_core.study.measures import QUANTITIES, UNITS
from evidence.ladder import front
from evidence.ladder.turns import TURN_S, TURNS, in_turns
from evidence.pages import DOCS, save_small

SCENES = ("service_high_speed", "service_high_speed_cup", "wheel_flat")
ACCURACY = 0.05
COLOURS = 96
USUAL_DETAIL = tuple((tier.name, 6, tier.steps_per_sample) for tier in TIERS.values())
USUAL_STEPS = TIERS["full"].steps_per_sample
_BOUGHT = ("force", "deflection", "roller_load", "torque", "vibration")

HEAD = """# What accuracy costs

Written by `make ladder`; every number on this page is of that run, on one core of
{processor}, {lanes} rollers at once (eight with AVX-512, four without).

`beardyn ladder SCENE -o DIR` makes such a table, `ladder.json` and `ladder.png` of any scene.

## What is compared

The same scene, the same load history, the same noise of the sensors, with other tiers, sets of effects,
numbers of laminae and time steps. The **reference** is the full tier with every effect (`full`),
{laminae} laminae and a step of 1/{reference_rate:.0f} s ({steps} steps for each sample of 25.6 kHz). How
far it is converged itself: the errors of *{neighbour}*, with half of its laminae and twice its step. *6
laminae x 4* is a level with 4 steps for each sample. `lumped` and `quasistatic` name levels of these tiers,
the others are of the full tier. The presets `dry` and `standard` have no `structure`: rings and box are rigid
in them, and that is most of their error in deflection. *auto* is what a scene that names nothing gets, in its
own box.

**Wall time** is for a simulated second, kernel and observation; compiling is apart. After the climb all
levels of a scene take turns of {turn:g} s in one process, so that a machine that slows down slows all of
them; it is the median of {turns} turns. The real-time factor (RTF) is its inverse.

**Errors** are those of the worst component of each quantity:

| column | components | error |
|---|---|---|
| force | rollers on the cup at 400 Hz: mean vector, 99 % quantile of its size | % of its size |
| deflection | cone against cup at 200 Hz: the same | % of its size |
| roller_load | largest roller load: mean, 99 % quantile; rms over the load zone at equal azimuth | % of it |
| torque | mean torque on the shaft | % |
| vibration | third-octave bands, 31.5 Hz to 10 kHz, all axes of the first accelerometer | dB |
| cage_speed | mean speed of each cage | % |
| fault_line | line of the fault in the envelope order spectrum (2 to 10 kHz) | dB |

The comparison covers whole revolutions of the cage. **The bearing is chaotic**: two runs that begin a
nanometre apart share statistics, not trajectories. So the reference runs {runs} times and cheap levels run
twice, each begun a hair apart, and every error has a band: what the difference of two means stays in with
95 % probability, for all components of a quantity together, from the scatter between runs and between
windows of them. An error inside its band is *not resolved* and stands in brackets.

**Accuracy of {accuracy}** means: force, deflection, roller loads and torque within {accuracy} and
third-octave bands within 1.5 dB. *yes*: every error is within, each with 95 % certainty (a level that
fails anywhere passes with 5 % at most); *no*: an error is beyond, with its whole band; *open*: the runs are
too short to tell. Levels are compared by their worst error in units of its limit, which the pictures show:
one is **efficient** (bold) when that is less than of every cheaper one, by more than the run-to-run band and
a tenth. A single column may well be better in a cheaper level.
"""


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


def section(ladder: Ladder, picture: Path) -> list[str]:
    """Write one scene of the page."""
    windows = len(ladder.edges) - 1
    turns = counted(ladder.revolutions, "whole cage revolution")
    return [
        f"## {ladder.scene}",
        "",
        ladder.purpose,
        "",
        f"Compared over {ladder.edges[-1] - ladder.edges[0]:.2f} s, {turns} in {counted(windows, 'window')}. "
        + ("No fault, so no fault line." if ladder.fault_line is None else _line_sentence(ladder)),
        "",
        f"![Accuracy against wall time of {ladder.scene}](pictures/{picture.name})",
        "",
        *table(ladder),
        "",
        *(f"- {lesson}" for lesson in lessons(ladder)),
        "",
    ]


def _line_sentence(ladder: Ladder) -> str:
    assert ladder.fault_line is not None
    return f"Fault line: {ladder.fault_line.name}, {ladder.fault_line.order:.3f} per shaft revolution."


def table(ladder: Ladder) -> list[str]:
    """Write the Markdown table of all levels."""
    columns = [f"{quantity} {UNITS[quantity]}" for quantity in QUANTITIES]
    efficient = {row.level.name for row in ladder.efficient}
    good = percent(ladder.accuracy)
    rows = [
        f"| level | wall s/s | RTF | {' | '.join(columns)} | {good} |",
        f"|---|{'--:|' * (len(columns) + 2)}---|",
    ]
    for row in ladder.by_cost:
        name = f"**{row.level.name}**" if row.level.name in efficient else row.level.name
        cells = [error_text(row.of(quantity)) for quantity in QUANTITIES]
        wall = row.cost.median
        rows.append(
            f"| {name} | {wall:.3f} | {1.0 / wall:.2f} | {' | '.join(cells)} | {ladder.verdict(row)} |"
        )
    reference = ladder.reference.cost.median
    dots = " | ".join("" for _ in columns)
    rows.append(f"| reference | {reference:.2f} | {1.0 / reference:.3f} | {dots} | |")
    return rows


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
    every = [row for row in full if row.level.effects_name == "full"]
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


def summary(ladders: list[Ladder]) -> list[str]:
    """List the efficient levels of all scenes side by side, with the errors that each one buys."""
    columns = [f"{quantity} {UNITS[quantity]}" for quantity in _BOUGHT]
    lines = [
        "## Efficient levels",
        "",
        f"| scene | level | wall s/s | {' | '.join(columns)} | {percent(ACCURACY)} |",
        f"|---|---|{'--:|' * (len(columns) + 1)}---|",
    ]
    for ladder in ladders:
        for row in ladder.efficient:
            cells = [f"{row.cost.median:.3f}", *(error_text(row.of(quantity)) for quantity in _BOUGHT)]
            cells.append(ladder.verdict(row))
            lines.append(f"| {ladder.scene} | {row.level.name} | {' | '.join(cells)} |")
    return [*lines, "", *map(_rungs, ladders), ""]


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
    ladders, lines = [], []
    for name in arguments.scenes:
        ladder = climbed(name, arguments.quick, arguments.duration)
        if ladder.interrupted:
            sys.exit("interrupted: the page is left as it was")
        ladder = in_turns(ladder, scene_with_all(name))
        picture = pictures / f"ladder_{name}.png"
        ladder_picture(ladder, picture)
        save_small(picture, picture, COLOURS)
        ladders.append(ladder)
        lines += section(ladder, picture)
    head = HEAD.format(
        processor=machine()["processor"],
        lanes=LANE_WIDTH,
        laminae=REFERENCE_LAMINAE,
        steps=REFERENCE_STEPS,
        reference_rate=WAVEFORM_RATE * REFERENCE_STEPS,
        neighbour=levels_of(scene_with_all(arguments.scenes[0])).neighbour.name,
        runs=REFERENCE_RUNS,
        turn=TURN_S,
        turns=TURNS,
        accuracy=percent(ACCURACY),
    )
    page = "\n".join([head, *summary(ladders), *lines])
    (arguments.to / "ladder.md").write_text(page.rstrip("\n") + "\n", encoding="utf-8")
    if arguments.to == DOCS:
        front.main()


if __name__ == "__main__":
    main()
