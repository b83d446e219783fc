"""Write docs/hard.md from what `make hard` wrote: ``python -m evidence.hard.page hard.json``, or several."""

from __future__ import annotations

import argparse
import json
from collections import Counter
from pathlib import Path
from typing import Any

from beardyn_core.physics.tiers.status import LARGEST_CHATTER_INDEX, LARGEST_PENETRATION
from evidence.hard.case import RUN_AS
from evidence.hard.catalogue import CASES
from evidence.hard.report import cells, outcome_from
from evidence.hard.run import STARTS, WITHOUT_STARTS
from evidence.hard.verdict import FAILED, GOOD, KNOWN, SKIPPED
from evidence.pages import DOCS

PAGE = DOCS / "hard.md"

HEAD = """# Hard cases

Written by `python -m evidence.hard.page hard.json` from the numbers of `make hard`: {count} situations in
which codes of this kind break, on {kernels} kernels; {fast} of them are also in the fast tests. `make hard`
runs them side by side, prints this table, goes on where it was interrupted, and fails when a case fails that
is not listed below with its reason. Every case is run from five starts a nanometre of end play apart, and a
verdict that a nanometre changes is a failure. `make hard ARGS="load --jobs 1"` runs a topic or a case.

**{summary}.**

| verdict | means |
|---|---|
| holds | went to its end, everything below within its limits, no status bit |
| reports | the same, with a warning that it has to or may give |
| ends | the run ended with the sentence it has to end with |
| refused | configuration or load was refused with a sentence |
| known failure | fails, for the reason given |
| FAILED | fails |

| run as | means |
|---|---|
{run_as}

## What is measured

- **Energy residual**: |work in - all losses - numerical dissipation - change of stored energy| over the
  losses (or 0.1 J), every term integrated from its own force times velocity; at most 1e-2.
- **Penetration**: largest approach of a roller and a raceway; at most {penetration:.0f} um, beyond which
  the contact law does not hold.
- **Chatter index**: largest over raceway contacts and blocks of rms(b) / rms(mu N) with b² = (f_n -
  (f_(n-1) + f_(n+1))/2)² - (f_(n+1) - f_(n-1))²/8, not below 0, f the friction at every step; reported
  above {chatter:g}. Friction that flips between its limits at every step has 2, at every second one 0.7.
- **Frame error**: largest deviation of a roller axis or a quaternion from length 1; at most 1e-12.
- **Momentum residual**: change of the momentum of journal, rollers and cages in a block that load, weight
  and the force on the cup do not account for, over force times time; at most 1e-9.
- **Status**: bits 1 not finite, 2 penetration, 4 chatter, 8 off the rib, 16 film out of range, 32 rib edge,
  of all starts. Of a coarse step that ends in numbers that are not finite nothing else is shown.
- **Starts**: how many starts a nanometre of end play apart came to the verdict; the numbers beside it are
  the largest of them. What is refused before anything runs has one.
- **Half the step**: from the first start, what it changes in mean force, force scatter, mean torque, cage
  speed and largest roller load; the one that fills most of its band is shown. The band is the limit of
  convergence (0.5 % of the means, 20 % of the scatter) and the scatter between blocks, at most 5 %. The
  bearing is chaotic: where two runs differ, five of each step, whose rollers begin up to a micrometre from
  the middle of their pockets, decide, and the band is that between runs. Starts a nanometre apart would
  not do: they share their first strikes, and a band between them is too narrow by half.

"""

CHATTER = """## Finite is not stable

One roller of this bearing between two raceways, 10 kN, friction 0.1 rounded over 10 mm/s, pulled back by a
cage with 20 N: half of that is the right friction on the cup. Explicit steps follow up to 1.1 us. Beyond,
everything stays finite **and the mean stays right**, while the friction flips between its limits from step
to step. A log of every second step shows a calm run. The twin's monitor looks at every step, and reports it.

| method | step us | mean friction N | scatter N | scatter, every second step N | chatter index | monitor |
|---|--:|--:|--:|--:|--:|---|
"""


def main() -> None:
    """Read and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "numbers", type=Path, nargs="+", metavar="JSON", help="one run, or parts of it; of a case the last"
    )
    parts = [json.loads(path.read_text(encoding="utf-8")) for path in parser.parse_args().numbers]
    PAGE.write_text(page(joined(parts)), encoding="utf-8")


def joined(parts: list[dict[str, Any]]) -> dict[str, Any]:
    """Join parts of the battery that were run apart, in the order of the catalogue."""
    found = {case["name"]: case for part in parts for case in part["cases"]}
    kernels = max(part["kernels"] for part in parts)
    return {
        **parts[-1],
        "kernels": kernels,
        "cases": [found[case.name] for case in CASES if case.name in found],
    }


def page(data: dict[str, Any]) -> str:
    """Put the whole page together."""
    cases = data["cases"]
    parts = [
        HEAD.format(
            count=len(cases),
            kernels=data["kernels"],
            fast=sum(case["fast"] for case in cases),
            summary=counted(cases),
            run_as="\n".join(f"| {name} | {how} |" for name, how in RUN_AS.items()),
            penetration=LARGEST_PENETRATION * 1e6,
            chatter=LARGEST_CHATTER_INDEX,
        ),
        *known(cases),
        CHATTER + "\n".join(chatter_row(row) for row in data["hidden_chatter"]) + "\n\n",
    ]
    parts += [
        section(topic, [case for case in cases if case["topic"] == topic])
        for topic in dict.fromkeys(case["topic"] for case in cases)
    ]
    return "".join(parts).rstrip("\n") + "\n"


def counted(cases: list[dict[str, Any]]) -> str:
    """Count the verdicts of each kind."""
    counts = Counter(case["outcome"]["verdict"] for case in cases)
    found = [f"{counts[v]} {v}" for v in (*GOOD, KNOWN, SKIPPED, FAILED) if counts[v]]
    return f"{len(cases)} cases: {', '.join(found)}"


def known(cases: list[dict[str, Any]]) -> list[str]:
    """List what fails or was skipped, and why, and what has fewer starts."""
    lines = [
        f"- `{case['name']}`, {case['outcome']['verdict']}: {'; '.join(case['outcome']['reasons'])}."
        f"{' ' if case['known_failure'] else ''}{case['known_failure']}\n"
        for case in cases
        if case["outcome"]["verdict"] in (KNOWN, SKIPPED, FAILED)
    ]
    fewer = [
        f"- `{case['name']}`: {case['outcome']['starts']} of {STARTS} starts was run.\n"
        for case in cases
        if case["outcome"]["starts"] < STARTS and case["run_as"] not in WITHOUT_STARTS
    ]
    names = {case["name"] for case in cases}
    left = ", ".join(f"`{case.name}`" for case in CASES if case.name not in names)
    return [
        *(["## Not run\n\n", f"Of this state of the code: {left}.\n\n"] if left else []),
        *(["## What does not pass\n\n", *lines, "\n"] if lines else []),
        *(["## Fewer starts\n\n", *fewer, "\n"] if fewer else []),
    ]


def chatter_row(row: dict[str, Any]) -> str:
    """Write a row of the table of hidden chatter."""
    monitor = "chatter" if row["status"] & 4 else "silent"
    return (
        f"| {row['method']} | {row['step'] * 1e6:g} | {row['mean']:.3f} | {row['scatter']:.1f} | "
        f"{row['scatter_every_second']:.1f} | {row['index']:.2f} | {monitor} |"
    )


def section(topic: str, cases: list[dict[str, Any]]) -> str:
    """Write the cases of a topic: what would break, and what was measured."""
    why = ["| case | what would break | guard | run as |", "|---|---|---|---|"]
    why += [f"| `{case['name']}` | {case['breaks']} | {case['guard']} | {case['run_as']} |" for case in cases]
    rows = [
        "| case | verdict | energy | um | chatter | frame | momentum | status | starts | half the step |",
        "|---|---|--:|--:|--:|--:|--:|--:|--:|---|",
    ]
    says = []
    for case in cases:
        outcome = outcome_from(case["outcome"])
        name, *numbers, _wall = cells(outcome)
        rows.append(f"| `{name}` | {' | '.join(numbers)} |")
        if outcome.sentence and outcome.verdict in GOOD:
            says.append(f"- `{name}`: {outcome.sentence}")
    sentences = ["", "Sentences:", "", *says] if says else []
    return "\n".join([f"## {topic.capitalize()}", "", *why, "", *rows, *sentences, "", ""])


if __name__ == "__main__":
    main()
