"""Write docs/performance.md from the numbers of `make bench`.

``python -m evidence.performance.page bench.json``
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

from evidence.pages import DOCS

PAGE = DOCS / "performance.md"

HEAD = """# Performance

Written by `make performance` from the numbers of `make bench`: {processor}, one core, numba {numba}, Python
{python}; load average before the run {load_average_before:.2f}. Ten million turns of a plain Python loop took
{python_loop_s:.2f} s on this core. All times are medians over blocks of 20 ms; runs that are compared take
turns, block by block.

"""

# More than this and something else was running.
IDLE = 0.7
BUSY = "**The machine was busy with other work: all times are too long, ratios within one table hold.**\n\n"

GOALS = """## Goals

This table is of the preset `standard` and of starts, the next one of runs within 5 %. The real-time factor
(RTF) is simulated over wall time, all channels of a run included.

"""

TEXTS = {
    "right_answers": """## Speed of right answers

What is asked of one core for an answer within 5 %, and what this machine gave; the last row is the preset as
it is (`static_80kN`). Healthy is `smooth_run`, the spall `cup_spall`: rings that bend, no box that rings and
no background, which in `full` take a third more ([choices](choices.md)). What `auto` takes in tier `full` was
[tried beside every effect](automatic.md), the fast tiers in boxes that ring by the [ladder](ladder.md): there
they miss the torque by 4 to 6 % and the loudest third octaves by more than what is asked here. Third
octaves of these two rows are off by up to 3.1 (`quasistatic`) and 2.6 dB (`lumped`), see
[effects_auto.md](effects_auto.md#third-octaves-of-the-fast-tiers). Where no more
than 1 kHz is asked for, sensors are sampled at 3.2 kHz, which is too slow for the monitor. Processor time:
what other programs of this machine took does not count, what others of its host took does.

""",
    "train": """## A train

Axleboxes of one process in `lumped`, vibration to 1 kHz sampled at 3.2 kHz, all in one recording.

""",
    "real_time_factor": """## Tiers and effects

Every tier with every shipped set of effects and the step it takes by itself, steady 80 kN at 1165 rpm, 6
laminae unless named. *Chosen step*: what `auto` takes where vibration to 10 kHz is asked for,
[converged](step.md). The first factor is measured in turn with all the others, the last two with one run at a
time.

""",
    "fast_tiers": """## Fast tiers

With cup held (`static_80kN`), suspended (`smooth_run`) and a spall (`cup_spall`), each with the step that it
takes by itself: `lumped` takes steps of two or four samples where nothing strikes, `quasistatic` of one
([model](model.md#steps-of-the-fast-tiers)).

""",
    "scenes": """## Scenes

Shipped scenes as they are.

""",
    "stages": """## Where the time goes

`beardyn simulate` prints this table for every run, `--json` has it as `stages_s`. Time outside the kernel
is measured with a clock; within the kernel one step in 128 is timed with the processor's cycle counter,
each stage waiting for the one before, and the kernel's wall time is shared out by those cycles, means over
steps that work friction out and steps that hold it. *contact* is the geometry of the raceway contacts and
the springs of their laminae, *cage* the pockets and the cages' own motion, *losses* rolling resistance,
drag and seals, *solve* the 6 x 6 system of each roller, *settle* the raceway forces that end the step with
their energy terms, *motion* drift and kick of the rollers, *rings* cup, cone and axlebox. A stage without
work shows up to 1.5 %, what is left of its marks.

The timers are an argument like every effect: without them they compile to nothing. With them a step that is
not timed has about 240 branches more. Their effect could not be measured: the medians of the ratio were 0.98
and 1.00 in two runs, and code that lies elsewhere in memory makes 5 % either way.

""",
    "levers": """## Levers

What makes the time step fast, measured by leaving it out, in turns with the step as it is. Two levers are
in the length of the step instead: the implicit solve, which takes steps of 13 us where [explicit
ones](step.md) need 0.1 to 5 us, and contact damping of the middle of the step with the least stable share
of the springs, which needs 3 steps for each sample where damping of its end needs 5. A third lever is
[friction that is held](model.md#what-was-tried-on-the-step) for three steps. Uniform laminae are kept:
`python benchmarks/levers.py laminae` has them beside Gauss points, which pay on straight rollers only.

""",
    "laminae": """## Laminae

""",
    "rollers": """## Rollers

Eight lanes hold four rollers of each row, four lanes two; a number that is no multiple fills up with shadows.

""",
    "cold_start": """## Start

From the start of the process to the end of the first block, kernels in the cache. `beardyn warmup` fills the
cache with every shipped scene and every set of effects in every tier.

""",
    "compiling": """## Compiling

A new set of effects is compiled once, with a message; the cache is named by a hash of the sources.

""",
    "sinks": """## Recording

""",
    "parallel": """## Two bearings at once

Two twins in two threads of one process, and in two processes, against one alone, in turns. The time step runs
without the interpreter lock; what is left of a block holds it.

""",
    "paced": """## Real time

Twin node and load node as processes at speed factor 1. A block is late when it is handed over more than 40 ms
after it is due; *worst arrival* is what a listener in a third process sees, transport included. The RTF is
that of the diagnostics: simulated time over time inside the twin, here beside two other processes. From the
dearest on to the first that keeps up.

""",
    "yardstick": """## Yardstick

The same bearing, load, laminae, effects and initial state in the plain force laws that the kernels are tested
against, first-order equations of all bodies in NumPy and scipy's `solve_ivp`: what one writes first.

""",
}

MISSED = ("short of the floor", "short of the goal")

TAIL = """## Absent effects

An absent effect costs nothing: the compiled step has no arithmetic instruction more than one that was built
without the hooks of the absent effects, and gives the same bits, as
`test/effects/test_absent_costs_nothing.py` shows. What a present effect costs is measured by `make costs`.
"""


def goal_rows(tables: dict[str, Any]) -> list[tuple[str, str, str, str, str]]:
    """List what is asked for: floor, goal, measured, and how far it came."""

    def of(table: str, key: str, name: str, column: str) -> float | None:
        rows = tables.get(table, {"rows": []})["rows"]
        return next((float(row[column]) for row in rows if row[key] == name and column in row), None)

    rows = []
    turns, node, desk = "RTF", "RTF alone", "RTF alone, desk"
    for what, name, column, floor, goal in (
        (
            "`full`, preset `standard`, 6 laminae, converged step: RTF",
            "full standard, chosen step",
            turns,
            1.2,
            2.0,
        ),
        ("the same with 20 laminae: RTF", "full standard, 20 laminae, chosen step", turns, 0.6, 1.0),
        ("the same with the usual step: RTF", "full standard", turns, 1.2, 2.0),
        *(
            (f"{tier}, {how}: RTF", f"{tier} standard", column, floor, goal)
            for tier, floor, goal in (("quasistatic", 20.0, 50.0), ("lumped", 300.0, 1000.0))
            for how, column in (
                ("a run on the desk", desk),
                ("a run in blocks of 20 ms", node),
                ("all runs in turn", turns),
            )
        ),
    ):
        found = of("real_time_factor", "run", name, column)
        if found is not None:
            came = "goal" if found >= goal else "floor" if found >= floor else MISSED[False]
            rows.append((what, f"{floor:g}", f"{goal:g}", f"{found:.3g}", came))
    for what, found, least, most in (
        ("cold start to the first block, s", of("cold_start", "part", "to the first block", "s"), 0.0, 3.0),
        ("compiling `standard`, s", of("compiling", "effects", "standard", "wall s"), 15.0, 8.0),
        ("compiling `full`, s", of("compiling", "effects", "full", "wall s"), 15.0, 8.0),
    ):
        if found is not None:
            came = "goal" if found < most else "floor" if found < least else MISSED[not least]
            rows.append((what, f"< {least:g}" if least else "", f"< {most:g}", f"{found:.3g}", came))
    fit = of("laminae", "effects", "standard", "R^2")
    if fit is not None:
        rows.append(
            ("cost linear in laminae, R^2", "", "0.99", f"{fit:.4f}", "goal" if fit > 0.99 else MISSED[True])
        )
    return rows


def markdown(columns: list[str], rows: list[list[str]]) -> str:
    """Write a table."""
    lines = ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)]) + "\n"


def shown(cell: Any) -> str:
    """Write a number with three significant digits."""
    if isinstance(cell, float):
        return f"{cell:.0f}" if abs(cell) >= 1000.0 else f"{cell:.3g}"
    return str(cell)


def page(result: dict[str, Any]) -> str:
    """Put the whole page together."""
    tables = result["tables"]
    columns = ["", "floor", "goal", "measured", "reached"]
    busy = result["machine"]["load_average_before"] > IDLE
    parts = [HEAD.format(**result["machine"]), BUSY if busy else "", GOALS]
    parts.append(markdown(columns, [list(row) for row in goal_rows(tables)]) + "\n")
    for name, text in TEXTS.items():
        if name not in tables:
            continue
        table = tables[name]
        rows = [[shown(row[column]) for column in table["columns"]] for row in table["rows"]]
        note = f"\n{table['note']}\n" if table["note"] else ""
        parts.append(text + markdown(table["columns"], rows) + note + "\n")
    return "".join([*parts, TAIL])


def main() -> None:
    """Read and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("numbers", type=Path, help="JSON file of make bench")
    PAGE.write_text(page(json.loads(parser.parse_args().numbers.read_text())), encoding="utf-8")


if __name__ == "__main__":
    main()
