"""Mount a sensor wrongly and see what is made of it: docs/evidence/estimator.md.

``python -m evidence.follow.mountings OWN BOXES``: sets that ``beardyn sweep high_speed_axlebox --runs 48
--seed 77 -o OWN`` and ``beardyn sweep high_speed_boxes --runs 48 --seed 78 -o BOXES`` have made.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import cos, radians, sin
from pathlib import Path
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.follow.descriptors import AXES
from beardyn_core.follow.estimator import Estimator, read_estimator
from beardyn_core.follow.labelled import stretches_of_set
from beardyn_core.follow.mounting import EXCHANGED, GAIN, TURNED
from beardyn_core.follow.mounting_search import mountings_of, strangeness_of
from beardyn_core.monitor.chain import Stretch
from beardyn_core.population.labelled_set import LabelledSet
from evidence.follow.boxes import NEXT as BEFORE
from evidence.follow.boxes import PAGE, SHIPPED
from evidence.pages import write_section

TITLE = "## A sensor that is not mounted as stated\n"
FAMILIAR, UNEXPLAINED, RIGHT, AMONG, WRONG = "familiar", "unexplained", "right", "among others", "wrong"
OUTCOMES = (FAMILIAR, UNEXPLAINED, RIGHT, AMONG, WRONG)
NEAR = {TURNED: 5.0, GAIN: 3.0, EXCHANGED: 0.0}  # of an amount, [degree], [dB]

HEAD = f"""{TITLE}
Written by `python -m evidence.follow.mountings OWN BOXES`: {{runs}} runs of `quasistatic` of the sweep
`high_speed_axlebox`, drawn from a seed that was not learnt from, each with every mistake of the table. Where
a signal is unlike what was learnt from, `beardyn estimate` looks for an exchange of channels, a turn of up to
45° about one axis, or a gain, of one axis or all, that would make it familiar, by powers and cross powers of
the axes in twelfths of an octave. *Familiar*: nothing is noticed; *unexplained*: strange, and no mounting is
named; *right*: the mistake alone is named, a turn within {{turn:g}}° and a gain within {{gain:g}} dB;
*among others*: it is one of several.

| mistake | {{outcomes}} |
|---{"|--:" * len(OUTCOMES)}|
"""
TAIL = """A gain
that is wrong by less than the levels of the population differ is not noticed; what it does to the estimates
is not measured here. A reversed axis has the same levels; two mistakes at once are not looked for.

"""


@dataclass(frozen=True)
class Mistake:
    """A way to mount a sensor that is not the one stated."""

    words: str
    matrix: A[Float, "of what is recorded over what is there"]
    kind: str = ""
    axes: tuple[str, ...] = ()
    amount: float = 0.0


def mistakes() -> tuple[Mistake, ...]:
    """List what is tried."""
    found = [Mistake("none", np.eye(3))]
    for order in ((0, 2, 1), (1, 0, 2), (2, 1, 0), (1, 2, 0)):
        axes = tuple(AXES[k] for k in order)
        found.append(Mistake(f"channels {', '.join(axes)}", np.eye(3)[list(order)], EXCHANGED, axes))
    for about, degrees in ((0, 10.0), (0, 20.0), (1, 15.0), (1, 30.0), (2, 15.0), (2, 30.0)):
        words = f"turned by {degrees:g}° about {AXES[about]}"
        found.append(Mistake(words, _turned(about, degrees), TURNED, (AXES[about],), degrees))
    for which, decibels in (((0, 1, 2), 6.0), ((0, 1, 2), -19.8), ((2,), 6.0), ((1,), -10.0), ((2,), 19.8)):
        axes = tuple(AXES[k] for k in which)
        gain = np.eye(3)
        for k in which:
            gain[k, k] = 10.0 ** (decibels / 20.0)
        words = f"gain of {'all axes' if len(which) > 1 else axes[0]} {decibels:+g} dB"
        found.append(Mistake(words, gain, GAIN, axes, decibels))
    return tuple(found)


def _turned(about: int, degrees: float) -> Float:
    """Give the axes, as rows, of a sensor that is turned by the rule of the right hand."""
    one, two = (about + 1) % 3, (about + 2) % 3
    rows = np.eye(3)
    rows[one, [one, two]] = cos(radians(degrees)), sin(radians(degrees))
    rows[two, [one, two]] = -sin(radians(degrees)), cos(radians(degrees))
    return rows


def outcome(stretch: Stretch, mistake: Mistake, estimator: Estimator) -> str:
    """Judge what is made of a run with a mistake."""
    recorded = replace(stretch, acceleration=stretch.acceleration @ mistake.matrix.T)
    if strangeness_of([recorded], estimator) <= 1.0:
        return FAMILIAR
    found = mountings_of([recorded], estimator)
    if not found:
        return UNEXPLAINED
    right = [
        each.kind == mistake.kind
        and each.axes == mistake.axes
        and abs(each.amount - mistake.amount) <= NEAR[each.kind]
        for each in found
    ]
    return RIGHT if right == [True] else AMONG if any(right) else WRONG


def section(own: Path, boxes: Path) -> str:
    """Judge both sets and write the section."""
    estimator = read_estimator(SHIPPED)
    usual = list(stretches_of_set(LabelledSet(own), None))
    lines = []
    for mistake in mistakes():
        count = Counter(outcome(each, mistake, estimator) for each in usual)
        lines.append(f"| {mistake.words} | {' | '.join(str(count[each]) for each in OUTCOMES)} |\n")
        print(lines[-1], end="", flush=True)
    others = Counter(
        outcome(each, mistakes()[0], estimator) for each in stretches_of_set(LabelledSet(boxes), None)
    )
    print(others)
    accused = others[WRONG] + others[AMONG] + others[RIGHT]
    of_others = f"Of {others.total()} runs of other boxes and sensor places (`high_speed_boxes`)"
    return (
        HEAD.format(runs=len(usual), turn=NEAR[TURNED], gain=NEAR[GAIN], outcomes=" | ".join(OUTCOMES))
        + "".join(lines)
        + f"\n{of_others} {others[FAMILIAR]} are familiar, {others[UNEXPLAINED]} are strange without a "
        + f"reason, and {accused} {'is' if accused == 1 else 'are'} called wrongly mounted. {TAIL}"
    )


def main(words: Sequence[str] | None = None) -> int:
    """Write the section of the page."""
    parser = argparse.ArgumentParser(prog="python -m evidence.follow.mountings", description=__doc__)
    parser.add_argument("own", type=Path, metavar="OWN", help="set of the sweep high_speed_axlebox")
    parser.add_argument("boxes", type=Path, metavar="BOXES", help="set of the sweep high_speed_boxes")
    args = parser.parse_args(words)
    write_section(PAGE, TITLE, section(args.own, args.boxes), BEFORE)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
