"""Write docs/evidence/structure.md and its picture: ``python -m evidence.structure.page``."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import numpy as np

from evidence.pages import REPORTS, write_page
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

PAGE = REPORTS / "structure.md"


def row(meshed: Meshed) -> tuple[str, ...]:
    """List the cells of a mesh."""
    modes = meshed.built.modes
    free = modes.frequency[: modes.free_count]
    return (
        f"{1e3 * meshed.mesh:g}",
        f"{meshed.built.elements}",
        f"{meshed.built.unknowns}",
        ", ".join(f"{each:.0f}" for each in free[:8]),
        f"{np.count_nonzero(free < 8e3)}",
        f"{1e9 * meshed.built.yielding[0]:.4f}",
    )


def alone(meshed: Meshed) -> float:
    """Compute how far the yield of the free modes alone is from the finite elements."""
    from beardyn_core.structure.build import load_zone

    modes = meshed.built.modes
    free = first(modes, modes.free_count)
    zone = load_zone(free.reads.shape[0])
    return free.yielding(zone, zone) / meshed.built.yielding[0] - 1.0


def spring_row(meshed: Meshed, stiffness: float) -> tuple[str, ...]:
    """List the cells of a spring."""
    exact, found = on_springs(meshed.built, stiffness)
    both = ", ".join(f"{one:.0f} / {other:.0f}" for one, other in zip(exact, found, strict=True))
    return f"{stiffness:.0e}", both, f"{np.max(np.abs(found / exact - 1.0)):.3%}"


def kept_row(each: Kept, every: Kept) -> tuple[str, ...]:
    """List the cells of a number of modes."""
    return (
        f"{each.highest / 1e3:g}",
        f"{each.free} + {each.modes - each.free}",
        f"{each.yielding:+.2%}",
        f"{each.response:.2f}",
        f"{apart(each.levels, every.levels, 8e3):.2f}",
        f"{apart(each.levels, every.levels):.2f}",
        f"{each.energy:.1e}",
        f"{each.momentum:.0e}",
    )


def lowest(found: Sequence[Kept], changes: Sequence[float]) -> Kept:
    """Find the fewest modes from which on nothing changes by more than 1 dB."""
    too_few = [i for i, change in enumerate(changes) if change > 1.0]
    return found[max(too_few, default=-1) + 1]


def number_of_modes() -> dict[str, Any]:
    """Work out what changes when modes are left out, and draw it."""
    found, luck, stiff = kept(), chance(), rigid()
    every = found[-1]
    draw_number(found, luck)
    first_cost = (times := costs())[0][1]
    enough = lowest(found, [max(each.response, apart(each.levels, every.levels, 8e3)) for each in found])
    whole = lowest(found, [apart(each.levels, every.levels) for each in found])
    return {
        "numbers": [kept_row(each, every) for each in found],
        "luck": apart(luck, every.levels),
        "rigid": apart(stiff, every.levels),
        "enough": f"{enough.highest / 1e3:g}",
        "free": enough.free,
        "whole": f"{whole.highest / 1e3:g}",
        "whole_free": whole.free,
        "duration": DURATION,
        "settled": SETTLED,
        "lowest": LOWEST_BAND,
        "costs": [(count, f"{took:.1f}", f"{took / first_cost:.2f}") for count, took in times],
    }


def main() -> int:
    """Compute everything and write the page."""
    found = []
    for meshed in meshes():
        print(*row(meshed), sep=" | ", flush=True)
        found.append(meshed)
    coarse, middle, fine = found
    answer = answers(coarse.built)
    draw_answer(answer)
    draw_modes(coarse.built)
    tenth = [each.built.modes.frequency[:10] for each in (middle, fine)]
    modes = fine.built.modes
    values = {
        "box": BOX,
        "meshes": [row(each) for each in found],
        "fall": float(np.max(1.0 - tenth[1] / tenth[0])),
        "yielding": fine.built.yielding[0] / middle.built.yielding[0] - 1.0,
        "free_modes": modes.free_count,
        "residual": len(modes.frequency) - modes.free_count,
        "error": fine.built.static_error,
        "alone": alone(fine),
        "lines": len(LINES),
        "worst": answer.worst(answer.modes),
        "worst_free": answer.worst(answer.free),
        "springs": [spring_row(coarse, stiffness) for stiffness in SPRINGS],
        **number_of_modes(),
    }
    write_page(__file__, PAGE, values)
    print(f"{PAGE} written")
    return 0


if __name__ == "__main__":
    sys.exit(main())
