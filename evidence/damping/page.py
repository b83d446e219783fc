"""Write docs/damping.md: ``python -m evidence.damping.page``."""

from __future__ import annotations

import sys

from evidence.damping.study import EFFECTS, SPANS_HZ, SPEEDS_RPM, TIMES_US, Heard, hear, inlet, scenes
from evidence.pages import DOCS

PAGE = DOCS / "damping.md"

HEAD = """# Damping of the contacts

Written by `python -m evidence.damping.page`. `contact_damping` resists the approach of roller and raceway
by its tangent stiffness times 5 us. A gap that shrinks under a roller on the edge of a patch is approach too.

## Where the number comes from

- Kraemer, E. (1992) gives 2.5 to 25 us times the stiffness for a whole rolling bearing. What its rings lose
  in their seats is in that, so the upper end is much for a contact alone.
- Wijnant, Y. H., Wensing, J. A. and van Nijen, G. C. (1999), The influence of lubrication on the dynamic
  behaviour of ball bearings, J. Sound Vib. 222, 579-596, put a spring with a damper, fitted to solutions
  of the whole lubricated contact, in place of each contact of a ball bearing. We have no such solutions for
  line contacts of this size, and no measurement of one.
- An estimate of our own from the film: what approaches with v adds v l to the flow through the inlet of
  length l, as an entrainment u larger by v l / h would; with h ~ u^0.7 that is a damping time of 0.7 l / u.
  It holds for the flooded film of a roller under 20 kN on the cup of HS130x230, up to the frequency at which
  the film no longer fills the contact within a period:

| rpm | entrainment m/s | film um | inlet um | damping time us | up to kHz |
|--:|--:|--:|--:|--:|--:|
"""

BETWEEN = """
So 5 us is inside the quoted range, of the film's own order, and assumed: nobody has measured it. The steel's
own hysteresis is in the [rolling resistance](effects.md), not here. The film's damping would fall with the
frequency above the last column and with the speed; the twin's does neither.

## What it changes

Vertical acceleration of the axlebox in the `full` tier with the effects `{effects}` after 0.2 s, no sensor
noise; m/s².

| run | us | {bands} | peak | kurtosis | share in the losses | energy residual | status |
|---|--:|{dashes}--:|--:|--:|--:|---|
"""

ENDING = """
From one end of the range to the other the levels from 500 Hz to 2 kHz, where the axlebox rides on its
rollers, and from 2 to 8 kHz and the largest acceleration fall by factors of {ratios}. The band
below does not change. Levels above 500 Hz are known no better than this.
"""


def row(heard: Heard) -> str:
    """Write a row of the table."""
    bands = " | ".join(f"{level:.2f}" for level in heard.levels)
    return (
        f"| `{heard.scene}` | {heard.time_us:g} | {bands} | {heard.peak:.0f} | {heard.kurtosis:.1f} | "
        f"{heard.share:.1%} | {heard.residual:.1e} | {heard.says} |"
    )


def main() -> int:
    """Run and write."""
    lines = []
    for speed in SPEEDS_RPM:
        film = inlet(speed)
        lines.append(
            f"| {film.speed_rpm:g} | {film.entrainment:.2f} | {1e6 * film.film:.2f} | "
            f"{1e6 * film.length:.0f} | {1e6 * film.time:.1f} | {1e-3 * film.corner:.1f} |"
        )
    bands = " | ".join(f"{low:g}-{high:g} Hz" for low, high in SPANS_HZ)
    text = (
        HEAD
        + "\n".join(lines)
        + "\n"
        + BETWEEN.format(effects=EFFECTS, bands=bands, dashes="--:|" * len(SPANS_HZ))
    )
    endings = []
    for scene, duration in scenes():
        found = [hear(scene, duration, time_us) for time_us in TIMES_US]
        text += "".join(f"{row(heard)}\n" for heard in found)
        first, last = found[0], found[-1]
        endings.append(
            f"{first.levels[1] / last.levels[1]:.1f}, {first.levels[2] / last.levels[2]:.1f} and "
            f"{first.peak / last.peak:.1f} (`{first.scene}`)"
        )
    text += ENDING.format(ratios=", ".join(endings))
    PAGE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
