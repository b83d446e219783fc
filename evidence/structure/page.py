"""Write docs/structure.md and its picture: ``python -m evidence.structure.page``."""

from __future__ import annotations

import sys
from collections.abc import Sequence

import numpy as np

from evidence.pages import DOCS
from evidence.structure.number import (
    DURATION,
    LOWEST_BAND,
    SETTLED,
    Kept,
    apart,
    chance,
    costs,
    first,
    kept,
    rigid,
)
from evidence.structure.pictures import draw_answer, draw_modes, draw_number
from evidence.structure.study import BOX, LINES, SPRINGS, Meshed, answers, meshes, on_springs

PAGE = DOCS / "structure.md"

HEAD = """# Modes of an axlebox

Written by `make structure`. `beardyn structure BOX` (extra `structure`: gmsh, scikit-fem) meshes a box with
the cup in it, computes its free modes and adds residual modes (Rubin 1975), which make the static bending
under the rollers right. `-o` writes them as a table in text; `beardyn_core/structure/table.py` says what is
in it. A file with `modes: box.unv` or `box.pch` in place of dimensions reads free modes of another program
from a Universal file or from Nastran ([keys](reference.md#structure-by-modes-of-another-program)). Shipped
boxes: `beardyn scenes structures`. The effect `structure` of kind `modes` takes a table into every tier
([keys](reference.md#structure)); [model.md](model.md#a-box-of-ones-own) says how to take a box of one's own.

Everything here is of the box `{box}`.

![The first eight modes](pictures/structure_modes.png)

The surface in its first eight free modes, far exaggerated, blue where it rests and red where it goes farthest
(first mesh). `beardyn structure {box} --view` shows them in motion, `--save modes.rrd` keeps that for rerun.

## Three meshes

| edge mm | elements | unknowns | first free modes Hz | below 8 kHz | raceway yields um/kN |
|--:|--:|--:|---|--:|--:|
"""

BETWEEN = """
The raceway yields under a load zone of 126 degrees on both rows, without rigid motion. From the second mesh
to the third the first ten frequencies fall by {fall:.2%} at most, the yield changes by {yielding:+.2%}.

## Modes beside finite elements

Free modes up to 12.8 kHz ({free} of them) and {residual} residual modes, third mesh: the raceway yields
{error:+.3%} of the finite elements; by the free modes alone {alone:+.1%}.

Vertical motion of the accelerometer on top under the load zone, without rigid motion, at {lines} frequencies
from 0.2 to 8 kHz, structural damping of 4 % in both (first mesh): the modes are at most
**{worst:.3f} dB** from the finite elements, the free modes alone {worst_free:.2f} dB.

![Answer of the accelerometer](pictures/structure_answer.png)

## On springs

The load zone held to the ground by a spring; lowest elastic frequencies, Hz, finite elements / modes
(first mesh).

| spring N/m | frequencies | largest difference |
|--:|---|--:|
"""

NUMBER = """
## How many modes

`highest_Hz` of the effect leaves out the free modes above it: they and the residual modes of the table become
residual modes with the same static bending. Beside all modes of the shipped table: what the raceway yields,
the largest change of the sensor's answer at 800 frequencies from 0.2 to 8 kHz, and of third octaves, all
axes, from {lowest:g} Hz up in a run of `cup_spall` in this box (tier `full`, {duration:g} s, of which the
first {settled:g} s are left out, no sensor noise).

| kHz | free + residual | yield | answer dB | run to 8 kHz dB | run to 10 kHz dB | energy | momentum |
|--:|--:|--:|--:|--:|--:|--:|--:|
{rows}

The same run with the end play a nanometre wider differs by {luck:.2f} dB, one in a rigid box by {rigid:.1f}.
Answer and third octaves stay **within 1 dB to 8 kHz from {enough} kHz upwards ({free} free modes)**, third
octaves to 10 kHz from {whole} kHz upwards ({whole_free}). *Energy* is the residual of the audit over the
losses, *momentum* the largest residual in a block of 20 ms over load times time.

![Modes left out](pictures/structure_number.png)

Processor time of a step of that run, modes taken from the lowest up, medians of three runs in turn:

| modes | us | over none |
|--:|--:|--:|
{costs}
"""


def row(meshed: Meshed) -> str:
    """Write the row of a mesh."""
    modes = meshed.built.modes
    free = modes.frequency[: modes.free_count]
    first = ", ".join(f"{each:.0f}" for each in free[:8])
    return (
        f"| {1e3 * meshed.mesh:g} | {meshed.built.elements} | {meshed.built.unknowns} | {first} | "
        f"{np.count_nonzero(free < 8e3)} | {1e9 * meshed.built.yielding[0]:.4f} |"
    )


def alone(meshed: Meshed) -> float:
    """Compute how far the yield of the free modes alone is from the finite elements."""
    from beardyn_core.structure.build import load_zone

    modes = meshed.built.modes
    free = first(modes, modes.free_count)
    zone = load_zone(free.reads.shape[0])
    return free.yielding(zone, zone) / meshed.built.yielding[0] - 1.0


def spring_row(meshed: Meshed, stiffness: float) -> str:
    """Write the row of a spring."""
    exact, found = on_springs(meshed.built, stiffness)
    both = ", ".join(f"{one:.0f} / {other:.0f}" for one, other in zip(exact, found, strict=True))
    return f"| {stiffness:.0e} | {both} | {np.max(np.abs(found / exact - 1.0)):.3%} |"


def kept_row(each: Kept, every: Kept) -> str:
    """Write the row of a number of modes."""
    return (
        f"| {each.highest / 1e3:g} | {each.free} + {each.modes - each.free} | {each.yielding:+.2%} | "
        f"{each.response:.2f} | {apart(each.levels, every.levels, 8e3):.2f} | "
        f"{apart(each.levels, every.levels):.2f} | {each.energy:.1e} | {each.momentum:.0e} |"
    )


def lowest(found: Sequence[Kept], changes: Sequence[float]) -> Kept:
    """Find the fewest modes from which on nothing changes by more than 1 dB."""
    too_few = [i for i, change in enumerate(changes) if change > 1.0]
    return found[max(too_few, default=-1) + 1]


def number_of_modes() -> str:
    """Write what changes when modes are left out, and draw it."""
    found, luck, stiff = kept(), chance(), rigid()
    every = found[-1]
    draw_number(found, luck)
    first_cost = (times := costs())[0][1]
    enough = lowest(found, [max(each.response, apart(each.levels, every.levels, 8e3)) for each in found])
    whole = lowest(found, [apart(each.levels, every.levels) for each in found])
    return NUMBER.format(
        rows="\n".join(kept_row(each, every) for each in found),
        luck=apart(luck, every.levels),
        rigid=apart(stiff, every.levels),
        enough=f"{enough.highest / 1e3:g}",
        free=enough.free,
        whole=f"{whole.highest / 1e3:g}",
        whole_free=whole.free,
        duration=DURATION,
        settled=SETTLED,
        lowest=LOWEST_BAND,
        costs="\n".join(f"| {count} | {took:.1f} | {took / first_cost:.2f} |" for count, took in times),
    )


def main() -> int:
    """Compute everything and write the page."""
    found = []
    for meshed in meshes():
        print(row(meshed), flush=True)
        found.append(meshed)
    coarse, middle, fine = found
    answer = answers(coarse.built)
    draw_answer(answer)
    draw_modes(coarse.built)
    tenth = [each.built.modes.frequency[:10] for each in (middle, fine)]
    modes = fine.built.modes
    text = HEAD.format(box=BOX) + "\n".join(row(each) for each in found) + "\n"
    text += BETWEEN.format(
        fall=float(np.max(1.0 - tenth[1] / tenth[0])),
        yielding=fine.built.yielding[0] / middle.built.yielding[0] - 1.0,
        free=modes.free_count,
        residual=len(modes.frequency) - modes.free_count,
        error=fine.built.static_error,
        alone=alone(fine),
        lines=len(LINES),
        worst=answer.worst(answer.modes),
        worst_free=answer.worst(answer.free),
    )
    text += "\n".join(spring_row(coarse, stiffness) for stiffness in SPRINGS) + "\n"
    text += number_of_modes()
    PAGE.write_text(text, encoding="utf-8")
    print(f"{PAGE} written")
    return 0


if __name__ == "__main__":
    sys.exit(main())
