"""Write docs/structure.md and its picture: ``python -m evidence.structure.page``."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np

from evidence.pages import DOCS, PICTURES, save_small
from evidence.structure.study import BOX, LINES, SPRINGS, Answer, Meshed, answers, meshes, on_springs

PAGE = DOCS / "structure.md"
PICTURE = PICTURES / "structure_answer.png"

HEAD = """# Modes of an axlebox

Written by `make structure`. `beardyn structure BOX` (extra `structure`: gmsh, scikit-fem) meshes a box with
the cup in it, computes its free modes and adds residual modes (Rubin 1975), which make the static bending
under the rollers right. `-o` writes them as a table in text; `beardyn_core/structure/table.py` says what is
in it. A file with `modes: box.unv` in place of dimensions reads free modes of another program from a
Universal file ([keys](reference.md#structure-by-modes-of-another-program)). Shipped boxes: `beardyn scenes
structures`. The effect `structure` of kind `modes` takes a table into the full tier
([keys](reference.md#structure)).

Everything here is of the box `{box}`.

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
    free = modes.below(float(modes.frequency[modes.free_count - 1]))
    zone = load_zone(free.reads.shape[0])
    return free.yielding(zone, zone) / meshed.built.yielding[0] - 1.0


def spring_row(meshed: Meshed, stiffness: float) -> str:
    """Write the row of a spring."""
    exact, found = on_springs(meshed.built, stiffness)
    both = ", ".join(f"{one:.0f} / {other:.0f}" for one, other in zip(exact, found, strict=True))
    return f"| {stiffness:.0e} | {both} | {np.max(np.abs(found / exact - 1.0)):.3%} |"


def draw(answer: Answer, target: Path) -> None:
    """Draw both answers over frequency."""
    import matplotlib

    matplotlib.use("agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(figsize=(7.0, 3.4), layout="constrained")
    axes.loglog(LINES, 1e12 * np.abs(answer.elements), "k", lw=2.5, label="finite elements")
    axes.loglog(LINES, 1e12 * np.abs(answer.modes), "C1", lw=1.2, label="free and residual modes")
    axes.loglog(LINES, 1e12 * np.abs(answer.free), "C0:", lw=1.2, label="free modes alone")
    axes.set(
        xlabel="frequency [Hz]", ylabel="elastic answer [nm/kN]", title=f"{BOX}: raceways to axlebox_top"
    )
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    with tempfile.TemporaryDirectory() as folder:
        raw = Path(folder) / "raw.png"
        figure.savefig(raw, dpi=110)
        save_small(raw, target, 32)


def main() -> int:
    """Compute everything and write the page."""
    found = []
    for meshed in meshes():
        print(row(meshed), flush=True)
        found.append(meshed)
    coarse, middle, fine = found
    answer = answers(coarse.built)
    draw(answer, PICTURE)
    first = [each.built.modes.frequency[:10] for each in (middle, fine)]
    modes = fine.built.modes
    text = HEAD.format(box=BOX) + "\n".join(row(each) for each in found) + "\n"
    text += BETWEEN.format(
        fall=float(np.max(1.0 - first[1] / first[0])),
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
    PAGE.write_text(text, encoding="utf-8")
    print(f"{PAGE} written")
    return 0


if __name__ == "__main__":
    sys.exit(main())
