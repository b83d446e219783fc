"""Write docs/impact.md and its pictures: ``python -m evidence.impact.page``."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from beardyn_core.config import load_bearing
from evidence.impact.cases import (
    BEARING,
    BOTH,
    EFFECTS,
    LEFT_OUT,
    LOADS,
    OVER_SPEED,
    PARTS,
    SPEEDS,
    TIMES,
    WHOLE,
    Case,
    across,
    every,
    healthy,
    over_area,
    over_load,
    over_width,
    ranged,
)
from evidence.impact.crossing import crossing, ring_down
from evidence.impact.edges import LAWS, sinks, strike
from evidence.impact.loud import listed, loud
from evidence.impact.published import published
from evidence.impact.study import RATE, SPANS_KHZ, heard, run
from evidence.pages import DOCS, PICTURES, save_small

PAGE = DOCS / "impact.md"
CROSSING, SPECTRA = PICTURES / "impact_crossing.png", PICTURES / "impact_spectra.png"
SHOWN = (Case(10e-3), Case(10e-3, length=WHOLE))

HEAD = """# Impacts of spalls in a ringing box

Written by `make impact`. Rollers pass a spall of HS130x230 in the box `high_speed` (effect `structure`,
[its modes](structure.md)), full tier, all other effects as in `{effects}` and the same in every run, steps of
4.9 us; constant speed and load on smooth rails, scatter of grade G1, no background but the noise of a
piezoelectric accelerometer, {noise:g} m/s^2 per root Hz. The spall is 100 um deep in the inboard row, in the
middle of the load zone of the cup, 25 mm long unless it says *whole*, which is the whole contact. Levels are
vertical, m/s^2, of the sensor `axlebox_top` at 51.2 kHz; a train of 460 mm wheel radius. The rows on the
[validation page](validation.md) and their tolerances were written before the runs.

## One crossing

![Entry, exit and ring-down](pictures/impact_crossing.png)

Above a spall of half the contact, below one of the whole contact, both 10 mm wide at 200 km/h and 80 kN. A
roller that enters gives up its load over the first 0.5 mm, about: the box is pushed away. It takes the load
up again before the trailing edge; over a whole contact it was free in between, and strikes several times.

*Way*: of the contact between the loudest places of the two events. *Louder, sharper*: peak acceleration and
fastest change of the force of the rollers on the cup, exit over entry. *Pulses*: of that force at an exit.
*Burst*: how long the envelope from 5 to 16 kHz stays above a tenth of its largest power. *Jitter*: scatter of
the times from exit to exit over their mean.

| spall | km/h | way mm | louder | sharper | pulses | burst ms | jitter |
|---|--:|--:|--:|--:|--:|--:|--:|
"""

RINGS = """
After the exit of the 6 mm spall the strongest line above 3 kHz rings at {frequencies}, with {dampings} of
critical damping at {speeds} km/h. The modes have 2 % by assumption; one exponential fits them badly, for
neighbouring modes beat.

## Spectra

![Healthy and spalled](pictures/impact_spectra.png)

*Kurtosis* of the whole signal and of its part from 5 to 16 kHz (3 for noise). *Band*: that of the shipped
kurtogram. *Line*: fault line in the spectrum of the squared envelope of that band, *raw* in the spectrum of
the signal itself, both over the median around it.

| case | km/h | kN | peak | {bands} | kurtosis | 5-16 kHz | band kHz | line dB | raw dB |
|---|--:|--:|--:|{dashes}--:|--:|---|--:|--:|
"""

SHARES = """
Share of the power in the same bands, spall of 6 mm at 80 kN:

| part | km/h | {bands} |
|---|--:|{dashes}
"""

CAUSES = """
## What does not agree, and why

Runs that remove the cause stand beside.

- **Above about 2 mm the width does not make a spall of one length louder** where the rest of the contact
  carries the roller. From there on all load has left the spalled part before it is taken up again, and it
  is taken up where the far edge is as near as the roller is pressed in, on the same slope at every width. A
  longer way adds nothing to that; what grows with a spall on a rig is its area, as above.
- **A spall of 1 mm is louder than one of 2 mm**: peaks of {narrow} m/s^2 at {speeds} km/h. Edges give way
  under the roller as those of an elastic half-space do, where a held roller strikes harder over 1 mm, too:
  it gives up its load and takes it up again at once, one stroke of twice the change; over 2 mm there is a
  pause between. Largest force from 2 to 10 kHz on a roller of 10 kN that is held between the rings and
  passes at 90 km/h, in N, over a spall of half its length: with rigid edges, with those of the twin, and
  strip by strip on an elastic half-space (`evidence/impact/edges.py`):

| width mm | rigid | ours | elastic |
|--:|--:|--:|--:|
{strikes}

  Sink into the slot of 1 mm under 10 kN, in um:

| mm from the middle | rigid | ours | elastic |
|--:|--:|--:|--:|
{sinks}

- **How many times a roller strikes at the exit** rests on the damping of the contacts, which is assumed
  within its quoted range ([damping](damping.md)); 10 mm, whole contact, 200 km/h:

| damping us | peak | kurtosis | louder | pulses |
|--:|--:|--:|--:|--:|
"""

ENDING = """
- **A sound bearing is not Gaussian from 5 kHz on at low speed**: kurtosis {ringing} there and {sound} of
  everything at {speeds} km/h. At the ends of the load zone, where rollers carry little, they leave the
  raceways over its waves and come back, and nothing covers that, faint as it is. A bearing that is preloaded
  all around has none of it; cages with their film, and half of the step, change little. What nothing covers
  is what is wrong: waves shorter than 1 mm are left out of the grade, and at 90 km/h the others end below
  3 kHz. With waves to 0.2 mm, as far as contacts pass them on (`shortest_wave_mm`), a sound bearing is
  Gaussian as [measured ones](levels.md) are. Sound bearings under 80 kN, at 90 km/h unless told otherwise:

| | kurtosis | 5-16 kHz | rms there |
|---|--:|--:|--:|
{left_out}

- **The power above 5 kHz** is {high} of all of a cup spall of 6 mm at {both} km/h,
  and {whole} of one over the whole contact. Axleboxes with faults of a race are said to ring
  mostly there; no figure of one was found.
- **The raw spectrum shows the fault line, too**, other than on trains: there is no background here, and
  strikes are as regular as the jitter says.
- **The kurtogram chooses bands that touch the Nyquist frequency**, as on measured records: it has no upper
  limit.
- The sound bearing falls silent above 8 kHz at 200 km/h for the same reason: with waves to 0.2 mm its rms
  from 10 to 20 kHz is {silent}.
- Not tried: edges rounded by running, debris, floors that are not flat; the fast tiers; other boxes.
"""


def name(case: Case) -> str:
    """Name a case in a table."""
    if case.width == 0.0:
        return "sound"
    length = "whole" if case.length == WHOLE else f"{1e3 * case.length:g}"
    return f"{case.on} {1e3 * case.width:g} x {length}"


def crossing_row(case: Case) -> str:
    """Write what one crossing does."""
    found = crossing(case)
    return (
        f"| {name(case)} | {case.speed:g} | {1e3 * found.spacing:.2f} | {found.louder:.2f} | "
        f"{found.sharper:.2f} | {found.pulses:.1f} | {1e3 * found.burst:.2f} | {found.jitter:.2%} |"
    )


def heard_row(case: Case) -> str:
    """Write what is heard in one run."""
    found = heard(case)
    levels = " | ".join(f"{level:.2f}" for level in found.levels)
    band = f"{1e-3 * found.band[0]:.1f}-{1e-3 * found.band[1]:.1f}" if found.stands_out else "none"
    assert found.status == "fine", found.status
    return (
        f"| {name(case)} | {case.speed:g} | {1e-3 * case.load:g} | {found.peak:.0f} | {levels} | "
        f"{found.kurtosis:.1f} | {found.ringing:.1f} | {band} | {found.line:.0f} | {found.raw:.0f} |"
    )


def cases_of_crossings() -> Iterator[Case]:
    """List the cases of the first table."""
    for speed in BOTH:
        yield from (case for case in over_width(speed) if case.width > 1e-3)
        yield from across(speed)


def cases_heard() -> list[Case]:
    """List the cases of the second table, each speed together."""
    found: list[Case] = []
    for speed in BOTH:
        found += [healthy(speed, load) for load in LOADS]
        found += [*over_width(speed), *over_load(speed)]
        found += [Case(speed=speed, on=part) for part in PARTS]
        found += [*over_area(speed), *across(speed)]
    found += [case for each in OVER_SPEED for case in (healthy(each.speed), each)]
    return list(dict.fromkeys(found))


def shares_row(part: str, speed: float) -> str:
    """Write the shares of the power of a spall on one part."""
    shares = " | ".join(f"{share:.0%}" for share in heard(Case(speed=speed, on=part)).shares)
    return f"| {part} | {speed:g} | {shares} |"


def sink_rows() -> Iterator[str]:
    """Write how deep a roller sinks into the narrowest spall, by each law."""
    bearing, width = load_bearing(BEARING), 1e-3
    for arc in np.linspace(0.0, 0.5 * width + 1e-4, 7):
        cells = [float(sinks(bearing, law, width, float(arc), np.array([1e4]))[0]) for law in LAWS]
        yield f"| {1e3 * arc:.1f} | " + " | ".join(f"{1e6 * cell:.1f}" for cell in cells) + " |"


def strike_rows() -> Iterator[str]:
    """Write the strikes of a held roller over narrow spalls, by each law."""
    for width in (0.5e-3, 1e-3, 2e-3, 3e-3):
        cells = " | ".join(f"{strike(law, width, 1e4, 90.0):.0f}" for law in LAWS)
        yield f"| {1e3 * width:g} | {cells} |"


def damping_row(time: float) -> str:
    """Write what one time of contact damping changes."""
    case = Case(10e-3, length=WHOLE, damping=time)
    found, one = heard(case), crossing(case)
    return (
        f"| {1e6 * time:g} | {found.peak:.0f} | {found.kurtosis:.0f} | {one.louder:.1f} | {one.pulses:.1f} |"
    )


def above(*cases: Case) -> str:
    """Write the part of the power above 5 kHz of some cases."""
    return listed([100.0 * sum(heard(case).shares[2:]) for case in cases], ".0f") + " %"


def _save(figure: Any, target: Path) -> None:
    with tempfile.TemporaryDirectory() as folder:
        raw = Path(folder) / "raw.png"
        figure.savefig(raw, dpi=90)
        save_small(raw, target, 48)


def draw() -> None:
    """Draw a crossing with its ring-down, and the spectra of a sound and a spalled bearing."""
    import matplotlib

    matplotlib.use("agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(2, 1, figsize=(7.0, 4.6), sharex=True, layout="constrained")
    for case, axis in zip(SHOWN, axes, strict=True):
        found = crossing(case)
        axis.plot(1e3 * found.time, found.motion, "C0", lw=0.7)
        edge = 0.5e3 * case.width / found.speed
        axis.axvspan(-edge, edge, color="0.8")
        axis.set(ylabel="seat [m/s$^2$]", xlim=(-edge - 1.0, edge + 4.0))
        forces = axis.twinx()
        forces.plot(1e3 * found.time, 1e-3 * found.force, "C1", lw=0.9)
        forces.set_ylabel("force [kN]", color="C1")
    axes[0].set_title("grey: the contact is over the spall")
    axes[1].set_xlabel("time [ms]")
    _save(figure, CROSSING)
    figure, axes = plt.subplots(1, 2, figsize=(7.0, 2.9), sharey=True, layout="constrained")
    for speed, axis in zip(BOTH, axes, strict=True):
        for case, colour in ((Case(speed=speed), "C3"), (healthy(speed), "C0")):
            signal = run(case).signal
            count = 1024
            window = np.hanning(count)
            pieces = np.lib.stride_tricks.sliding_window_view(signal, count)[:: count // 2] * window
            density = (np.abs(np.fft.rfft(pieces, axis=1)) ** 2).mean(axis=0) * 2.0
            density /= RATE * float(np.sum(window**2))
            frequency = 1e-3 * np.fft.rfftfreq(count, 1.0 / RATE)
            axis.semilogy(frequency, np.sqrt(density), colour, lw=0.9, label=name(case))
        axis.set(xlabel="frequency [kHz]", title=f"{speed:g} km/h", xlim=(0, 20), ylim=(1e-4, 3.0))
        axis.grid(True, alpha=0.3)
    axes[0].set_ylabel("m/s$^2$/Hz$^{1/2}$")
    axes[0].legend()
    _save(figure, SPECTRA)


def main() -> int:
    """Run and write."""
    for case in every():
        found = heard(case)
        if case.on == "cup" and case.width > 0.0:
            crossing(case)
        print(name(case), case.speed, case.load, f"{found.peak:.1f} {found.rms:.2f}", flush=True)
    for case in ranged():
        print(name(case), case.speed, case.load, f"{heard(case).peak:.1f}", flush=True)
    draw()
    bands = " | ".join(f"{low:g}-{high:g} kHz" for low, high in SPANS_KHZ)
    dashes = "--:|" * len(SPANS_KHZ)
    rings = [ring_down(Case(speed=speed)) for speed in BOTH]
    text = HEAD.format(effects=EFFECTS, noise=every()[0].scene().sensors[0].noise_density)
    text += "".join(f"{crossing_row(case)}\n" for case in cases_of_crossings())
    text += RINGS.format(
        frequencies=listed([1e-3 * ring.frequency for ring in rings], ".1f") + " kHz",
        dampings=listed([100.0 * ring.damping for ring in rings], ".1f") + " %",
        speeds=listed(BOTH, "g"),
        bands=bands,
        dashes=dashes,
    )
    text += "".join(f"{heard_row(case)}\n" for case in cases_heard())
    text += SHARES.format(bands=bands, dashes=dashes)
    text += "".join(f"{shares_row(part, speed)}\n" for speed in BOTH for part in PARTS)
    text += loud()
    text += published()
    peaks = [listed([heard(case).peak for case in over_width(speed)[:2]], ".0f") for speed in BOTH]
    text += CAUSES.format(
        narrow=", ".join(peaks),
        speeds=listed(BOTH, "g"),
        strikes="\n".join(strike_rows()),
        sinks="\n".join(sink_rows()),
    )
    text += "".join(f"{damping_row(time)}\n" for time in TIMES)
    text += ending()
    PAGE.write_text(text, encoding="utf-8")
    print(f"{PAGE} written")
    return 0


def ending() -> str:
    """Write what does not agree, and what was left out to find the causes."""
    rows = [(name, heard(case)) for name, case in LEFT_OUT.items()]
    silent = [heard(replace(healthy(200.0), shortest_wave=each)).levels[3] for each in (2e-4, None)]
    return ENDING.format(
        high=above(*(Case(speed=speed) for speed in BOTH)),
        whole=above(*(Case(speed=speed, length=WHOLE) for speed in BOTH)),
        both=listed(BOTH, "g"),
        sound=listed([heard(healthy(speed)).kurtosis for speed in SPEEDS], ".1f"),
        ringing=listed([heard(healthy(speed)).ringing for speed in SPEEDS], ".1f"),
        speeds=listed(SPEEDS, "g"),
        left_out="\n".join(
            f"| {name} | {found.kurtosis:.1f} | {found.ringing:.1f} | {found.ringing_rms:.2f} |"
            for name, found in rows
        ),
        silent="{:.1f} m/s^2 instead of {:.1f}".format(*silent),
    )


if __name__ == "__main__":
    sys.exit(main())
