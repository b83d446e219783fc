"""Write docs/evidence/damping.md: ``python -m evidence.damping.page``."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from evidence.damping.study import (
    EFFECTS,
    SPANS_HZ,
    SPEEDS_RPM,
    TIMES_US,
    Inlet,
    Measurement,
    inlet,
    receive,
    scenes,
)
from evidence.pages import REPORTS, write_page

PAGE = REPORTS / "damping.md"


def row(received: Measurement) -> tuple[str, ...]:
    """List the cells of a run."""
    return (
        f"`{received.scene}`",
        f"{received.time_us:g}",
        *(f"{level:.2f}" for level in received.levels),
        f"{received.peak:.0f}",
        f"{received.kurtosis:.1f}",
        f"{received.share:.1%}",
        f"{received.residual:.1e}",
        received.says,
    )


def film_row(film: Inlet) -> tuple[str, ...]:
    """List the cells of a film."""
    return (
        f"{film.speed_rpm:g}",
        f"{film.entrainment:.2f}",
        f"{1e6 * film.film:.2f}",
        f"{1e6 * film.length:.0f}",
        f"{1e6 * film.time:.1f}",
        f"{1e-3 * film.corner:.1f}",
    )


def ratios(found: Sequence[Measurement]) -> str:
    """Say by how much levels fall from the least to the most damping."""
    first, last = found[0], found[-1]
    middle, high = (first.levels[k] / last.levels[k] for k in (1, 2))
    return f"{middle:.1f}, {high:.1f} and {first.peak / last.peak:.1f} (`{first.scene}`)"


def main() -> int:
    """Run and write."""
    runs = [[receive(scene, duration, time) for time in TIMES_US] for scene, duration in scenes()]
    values = {
        "films": [film_row(inlet(speed)) for speed in SPEEDS_RPM],
        "effects": EFFECTS,
        "bands": " | ".join(f"{low:g}-{high:g} Hz" for low, high in SPANS_HZ),
        "dashes": "--:|" * len(SPANS_HZ),
        "runs": [row(received) for found in runs for received in found],
        "ratios": ", ".join(map(ratios, runs)),
    }
    write_page(__file__, PAGE, values)
    return 0


if __name__ == "__main__":
    sys.exit(main())
