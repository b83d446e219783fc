"""Write docs/sensors.md: ``python -m evidence.service.page``."""

from __future__ import annotations

import sys

from beardyn_core.choice import load_scene
from beardyn_core.config import load_background, load_sensor, shipped_names
from evidence.pages import DOCS
from evidence.service.study import PARTS, SPANS_HZ, TIERS, Heard, hear, services, with_parts

PAGE = DOCS / "sensors.md"

HEAD = """# Sensors and what they hear

Written by `python -m evidence.service.page`.

## Kinds

`type` of a sensor takes its figures from a file in `config/sensors`, each figure with its source or
marked as assumed; what the sensor itself gives takes its place: `{name: top, type: iepe_100,
range_m_per_s2: 200}`.

| `type` | noise, m/s²/√Hz | range, m/s² | resonance, kHz | low pass, kHz | what it is |
|---|--:|--:|--:|--:|---|
"""

CHAIN = """
The reading of each axis: specific force of the box at the place of the sensor; measured path, where
there is one; resonance of the accelerometer on its mounting and low pass of its amplifier; anti-aliasing
to 3.2 to 51.2 kHz (flat to 0.4 of it, 70 dB down from 0.6); electrical pickup; white noise; clipping at
the range. The same in every tier. Delays are taken out of the time stamps, so blocks come later by 12
samples for a resonance or low pass and by 64 for a measured path. The lower limit of
piezoelectric sensors is left out: all of them read gravity.

## A measured path

`measured_paths: [{path: ratio.csv, axes: [z]}]` of a sensor is the ratio of the acceleration at the
sensor to that of the rigid box at its place: a CSV file with `frequency_Hz` and either `real` and
`imaginary` or `magnitude_dB` and `phase_deg`, or a Universal file (data set 58; extra `structure`). It
is applied as a filter of 160 ms (80 ms at 51.2 kHz) **behind the rigid model**: rollers and raceways do
not feel it. That is the cheaper and less true kind of a structure, for boxes that were measured and not
modelled; `beardyn explain` and the recorded scene name it so. Below its first frequency the ratio goes
to 1 at rest, so that gravity stays; a row at 0 Hz is not used. Above its last one it fades to
nothing within a tenth. A ratio that rings longer, or has its response before its cause, is refused.

## Background

`background` of a scene: a file of `config/backgrounds`, a path, or the keys of one. Each part is absent
unless it is given, and all but the last are forces on the journal, so that they take the way through the
bearing:

- `roughness`: short waves of wheel and rail, 4 mm to 0.5 m, through the contact patch (Remington 1987)
  and the vehicle on its track, to 8 kHz. Levels by CNOSSOS-EU and ISO 3095.
- `drive`: gear mesh and motor orders. `other_bearing`: rollers that pass in the bearing at the other end
  of the axle, and strokes of its fault. `knocks`: a Poisson process of lognormal impulses. Their levels
  are **assumed**; no published ones were found. All act vertically, and lines are as strong at every
  speed above a turn a second.
- `pickup`: side bands of the inverter's switching, in millivolts in the sensors' cables; levels assumed.

A background with forces samples the load at 20 kHz instead of 2 or 10, and needs steps of a sample or
shorter. The forces are part of the load: a twin node has them from the load node of the same scene. Fed
with a load from elsewhere, of which it cannot know what is in it, it adds none; where that load comes with
less than 20 kHz, or live, it says so in its log and on `/diagnostics` (WARN). Pickup is the sensors' own and
always there.

Parts:

| background | parts | what it is |
|---|---|---|
"""


SERVICE = """
## Service scenes

Vertical reading; rms, m/s². The monitor is the shipped one; its analyses by verdict. Effects as chosen for
each scene (5 % and 1.5 dB), in boxes that ring, with the load's background; wheelsets of freight and high
speed bend in the twin too.
"""


def _kinds() -> str:
    rows = ""
    for name in shipped_names("sensors"):
        kind = load_sensor(name)
        resonance, low_pass = (
            "-" if value is None else f"{1e-3 * value:g}"
            for value in (kind.mounting_resonance, kind.low_pass)
        )
        rows += (
            f"| `{name}` | {kind.noise_density:.2g} | {kind.range:g} | {resonance} | {low_pass} | "
            f"{kind.description} |\n"
        )
    return rows


def _backgrounds() -> str:
    rows = ""
    for name in shipped_names("backgrounds"):
        background = load_background(name)
        parts = ", ".join(part for part in PARTS if getattr(background, part) is not None)
        rows += f"| `{name}` | {parts} | {background.description} |\n"
    return rows


def _table(first: str, found: list[tuple[str, Heard]]) -> str:
    bands = " | ".join(f"{low:g}-{high:g} Hz" for low, high in SPANS_HZ)
    text = f"| {first} | {bands} | peak | kurtosis | monitor |\n|---|{'--:|' * len(SPANS_HZ)}--:|--:|---|\n"
    for name, heard in found:
        cells = " | ".join(f"{level:.3g}" for level in heard.levels)
        said = ", ".join(f"{verdict} {count}" for verdict, count in sorted(heard.verdicts.items()))
        text += f"| {name} | {cells} | {heard.peak:.0f} | {heard.kurtosis:.2f} | {said} |\n"
    return text


def main() -> int:
    """Run and write."""
    text = HEAD + _kinds() + CHAIN + _backgrounds()
    text += "\n## What each part adds\n\nVertical reading of `service_high_speed`, tier `quasistatic`; rms, "
    text += "m/s².\n\n"
    scene = load_scene("service_high_speed", tier="quasistatic")
    choices: list[tuple[str, ...]] = [(), *((part,) for part in PARTS), PARTS]
    text += _table("background", [(", ".join(p) or "none", hear(with_parts(scene, *p))) for p in choices])
    text += SERVICE
    for tier in TIERS:
        rows = [(f"`{each.name}`", hear(each)) for each in services(tier)]
        text += f"\nTier `{tier}`:\n\n{_table('scene', rows)}"
    PAGE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
