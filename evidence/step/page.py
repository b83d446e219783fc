"""Write docs/step.md and its picture from the numbers of `make step`.

``python -m evidence.step.page step.json``
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

from evidence.pages import DOCS, PICTURES, save_small
from evidence.step.cases import BRIDGE, REFERENCE
from evidence.step.picture import step_picture
from evidence.step.table import CRITERIA, point_tables, unstable_table

PAGE = DOCS / "step.md"
PICTURE = PICTURES / "step.png"
COLOURS = 32

SHORT_S = 1.0
SHORT = """**These numbers are from short runs (`--quick`), beside other work on the machine.** They show what
the study does; their bands are several dB wide, so that *within the band* says little. `make step` makes the
real ones.

"""

HEAD = """# Is the time step converged?

Written by `python -m evidence.step.page step.json` from the numbers of `make step`: the steps that `numerics:
auto` chooses, and others, against an **explicit reference of 0.1 us of the whole bearing**,
at {loads}.
Effects `{effects}`, {laminae} laminae; {duration:g} s a run after {settling:g} s of settling;
{reference_runs} runs of the reference, {runs} of each implicit step, each begun a hair apart.
Every step solves the same equations, so one named set serves: what is judged is the step and not the
physics, of which `standard` leaves much out ([limits](limits.md)).

The criteria: mean torque of the shaft within {mean:g} % and its scatter within {scatter:.0f} % of the
reference, and the spectrum of the housing acceleration within the run-to-run band up to 10 kHz.

{short}{verdicts}

## How it is judged

- **The reference** takes the contact forces of the beginning of each step on roller and ring alike; no
  matrix and no linearisation. `numerics: {{integrator: explicit, steps_per_sample: {steps}}}` does so in
  any scene of the full tier. It costs {wall:.0f} s a simulated second: it is for references only, and
  `auto` never takes it.
- **The bearing is chaotic**: runs that begin a nanometre apart share statistics, not trajectories. Numbers
  after +- are what a difference is known to with 95 % probability. *within*: within the limit with all of
  that; *not*: beyond it with all of that; *open*: the runs are too short to tell.
- **Scatter** is the standard deviation of the torque at every step, so that nothing hides between samples;
  beside it that behind the anti-alias filter at 25.6 kHz. Chatter is the index of the monitor, reported
  above {chatter:g}.
- **% in 5 ms**: mean torque of the first 5 ms, in which runs that begin alike still follow one another at any
  step: what the step itself does, without the chance of chaotic runs.
- **% of pooled**: the mean of chaotic runs takes long to be known. Explicit steps of 0.5 us cost a fifth and
  differ by {gap} in the first 5 ms; their runs are taken together with those of the reference.
- **The run-to-run band** is what the difference of two single runs of the reference stays in with 95 %
  probability, for all bands of a spectrum together. A spectrum is *within* when no difference leaves the
  band, *not* when one does so by more than it is known to. That is what was asked for and is easily met: a
  step that is off by three scatters of a run in every line would mostly pass. The sharper test is beside
  it: third octaves within 1.5 dB with all doubt, the limit of [automatic steps](automatic.md). Spectra are
  of all axes together, third octaves from 31.5 Hz, lines of 50 Hz.

## Finite is not stable

Explicit steps across their limit. Beyond it everything stays finite for long and the mean torque stays
about right while slips flip from step to step, which is hardly visible in every second step. With
the films of `standard` that begins at 5 us and 150 kN, with `dry` friction between 0.5 and 2 us.

{unstable_runs}

"""


def main() -> None:
    """Read and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("numbers", type=Path, metavar="JSON")
    data = json.loads(parser.parse_args().numbers.read_text(encoding="utf-8"))
    PAGE.write_text(page(data), encoding="utf-8")
    step_picture(data, PICTURE)
    save_small(PICTURE, PICTURE, COLOURS)


def page(data: dict[str, Any]) -> str:
    """Put the whole page together."""
    points, extent, limits = data["points"], data["extent"], data["limits"]
    head = HEAD.format(
        loads=" and ".join(f"{point['name']}, {point['speed_rad_s']:g} rad/s" for point in points),
        effects=data["effects"],
        laminae=data["laminae"],
        mean=100.0 * limits["mean"],
        scatter=100.0 * limits["scatter"],
        chatter=limits["chatter"],
        verdicts=verdicts(points),
        short=SHORT if extent["duration"] < SHORT_S else "",
        steps=REFERENCE.steps,
        wall=points[0]["reference"]["wall"],
        unstable_runs=unstable_table(data).markdown(),
        gap=gap(points),
        **{key: extent[key] for key in ("duration", "settling", "reference_runs", "runs")},
    )
    parts = [head]
    for point in points:
        parts += [f"## {table.title}\n\n{table.markdown()}\n\n" for table in point_tables(point, data)]
    parts.append(
        "![Spectra of the housing acceleration](pictures/step.png)\n\n"
        "Lines of 50 Hz at the reference and at the chosen steps; their differences, and the run-to-run "
        "band.\n"
    )
    return "".join(parts)


def gap(points: list[dict[str, Any]]) -> str:
    """Say by how much the pooled explicit steps differ at most while runs follow one another."""
    rows = (row for point in points for row in point["rows"] if row["name"] == BRIDGE.name)
    return f"{100.0 * max(abs(row['begun']) for row in rows):.1g} %"


def verdicts(points: list[dict[str, Any]]) -> str:
    """List what is chosen at each load, and every criterion."""
    found = [(point["name"], asked, choice) for point in points for asked, choice in point["chosen"].items()]
    names = [f"{load}, {asked}: {choice['steps_per_sample']} steps a sample" for load, asked, choice in found]
    lines = [f"| chosen for | {' | '.join(names)} |", f"|---|{'---|' * len(names)}"]
    for key, criterion in CRITERIA.items():
        cells = [choice["verdicts"].get(key, "") for _, _, choice in found]
        lines.append(f"| {criterion} | {' | '.join(cells)} |")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
