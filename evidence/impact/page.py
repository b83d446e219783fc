"""Write docs/evidence/impact.md and its pictures: ``python -m evidence.impact.page``."""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from beardyn_core.config import load_bearing
from beardyn_core.scene.surface import SHORTEST_WAVE
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
from evidence.impact.study import RATE, SPANS_KHZ, received, run
from evidence.pages import PICTURES, REPORTS, save_small, write_page

PAGE = REPORTS / "impact.md"
CROSSING, SPECTRA = PICTURES / "impact_crossing.png", PICTURES / "impact_spectra.png"
SHOWN = (Case(10e-3), Case(10e-3, length=WHOLE))


def name(case: Case) -> str:
    """Name a case in a table."""
    if case.width == 0.0:
        return "healthy"
    length = "whole" if case.length == WHOLE else f"{1e3 * case.length:g}"
    return f"{case.on} {1e3 * case.width:g} x {length}"


def crossing_row(case: Case) -> tuple[str, ...]:
    """List what one crossing does."""
    found = crossing(case)
    return (
        name(case),
        f"{case.speed:g}",
        f"{1e3 * found.spacing:.2f}",
        f"{found.louder:.2f}",
        f"{found.sharper:.2f}",
        f"{found.pulses:.1f}",
        f"{1e3 * found.burst:.2f}",
        f"{found.jitter:.2%}",
    )


def received_row(case: Case) -> tuple[str, ...]:
    """List what is received in one run."""
    found = received(case)
    assert found.status == "fine", found.status
    return (
        name(case),
        f"{case.speed:g}",
        f"{1e-3 * case.load:g}",
        f"{found.peak:.0f}",
        *(f"{level:.2f}" for level in found.levels),
        f"{found.kurtosis:.1f}",
        f"{found.ringing:.1f}",
        f"{1e-3 * found.band[0]:.1f}-{1e-3 * found.band[1]:.1f}" if found.stands_out else "none",
        f"{found.line:.0f}",
        f"{found.raw:.0f}",
    )


def cases_of_crossings() -> Iterator[Case]:
    """List the cases of the first table."""
    for speed in BOTH:
        yield from (case for case in over_width(speed) if case.width > 1e-3)
        yield from across(speed)


def cases_received() -> list[Case]:
    """List the cases of the second table, each speed together."""
    found: list[Case] = []
    for speed in BOTH:
        found += [healthy(speed, load) for load in LOADS]
        found += [*over_width(speed), *over_load(speed)]
        found += [Case(speed=speed, on=part) for part in PARTS]
        found += [*over_area(speed), *across(speed)]
    found += [case for each in OVER_SPEED for case in (healthy(each.speed), each)]
    return list(dict.fromkeys(found))


def shares_row(part: str, speed: float) -> tuple[str, ...]:
    """List the shares of the power of a spall on one part."""
    shares = received(Case(speed=speed, on=part)).shares
    return (part, f"{speed:g}", *(f"{share:.0%}" for share in shares))


def sink_rows() -> Iterator[tuple[str, ...]]:
    """List how deep a roller sinks into the narrowest spall, by each law."""
    bearing, width = load_bearing(BEARING), 1e-3
    for arc in np.linspace(0.0, 0.5 * width + 1e-4, 7):
        cells = [float(sinks(bearing, law, width, float(arc), np.array([1e4]))[0]) for law in LAWS]
        yield (f"{1e3 * arc:.1f}", *(f"{1e6 * cell:.1f}" for cell in cells))


def strike_rows() -> Iterator[tuple[str, ...]]:
    """List the strikes of a held roller over narrow spalls, by each law."""
    for width in (0.5e-3, 1e-3, 2e-3, 3e-3):
        yield (f"{1e3 * width:g}", *(f"{strike(law, width, 1e4, 90.0):.0f}" for law in LAWS))


def damping_row(time: float) -> tuple[str, ...]:
    """List what one time of contact damping changes."""
    case = Case(10e-3, length=WHOLE, damping=time)
    found, one = received(case), crossing(case)
    return (
        f"{1e6 * time:g}",
        f"{found.peak:.0f}",
        f"{found.kurtosis:.0f}",
        f"{one.louder:.1f}",
        f"{one.pulses:.1f}",
    )


def above(*cases: Case) -> str:
    """Write the part of the power above 5 kHz of some cases."""
    return listed([100.0 * sum(received(case).shares[2:]) for case in cases], ".0f") + " %"


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
        long = "as long as the roller" if case.length == WHOLE else f"{1e3 * case.length:g} mm long"
        title = f"spall {1e3 * case.width:g} mm wide, {long}; grey: a roller is over the spall"
        axis.set_title(title, fontsize="medium")
        axis.set(ylabel="seat [m/s$^2$]", xlim=(-edge - 1.0, edge + 4.0))
        forces = axis.twinx()
        forces.plot(1e3 * found.time, 1e-3 * found.force, "C1", lw=0.9)
        forces.set_ylabel("force [kN]", color="C1")
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
            axis.semilogy(
                frequency,
                np.sqrt(density),
                colour,
                lw=0.9,
                label=name(case).replace("cup", "spall on the cup, mm:"),
            )
        axis.set(xlabel="frequency [kHz]", title=f"{speed:g} km/h", xlim=(0, 20), ylim=(1e-4, 3.0))
        axis.grid(True, alpha=0.3)
    axes[0].set_ylabel("m/s$^2$/Hz$^{1/2}$")
    axes[0].legend()
    _save(figure, SPECTRA)


def main() -> int:
    """Run and write."""
    for case in every():
        found = received(case)
        if case.on == "cup" and case.width > 0.0:
            crossing(case)
        print(name(case), case.speed, case.load, f"{found.peak:.1f} {found.rms:.2f}", flush=True)
    for case in ranged():
        print(name(case), case.speed, case.load, f"{received(case).peak:.1f}", flush=True)
    draw()
    write_page(__file__, PAGE, values())
    print(f"{PAGE} written")
    return 0


def values() -> dict[str, Any]:
    """Work out the numbers of the page."""
    rings = [ring_down(Case(speed=speed)) for speed in BOTH]
    silent = [
        received(replace(healthy(200.0), shortest_wave=each)).levels[3] for each in (SHORTEST_WAVE, 1e-3)
    ]
    return {
        "effects": EFFECTS,
        "noise": every()[0].scene().sensors[0].noise_density,
        "crossings": [crossing_row(case) for case in cases_of_crossings()],
        "frequencies": listed([1e-3 * ring.frequency for ring in rings], ".1f") + " kHz",
        "dampings": listed([100.0 * ring.damping for ring in rings], ".1f") + " %",
        "both": listed(BOTH, "g"),
        "speeds": listed(SPEEDS, "g"),
        "bands": " | ".join(f"{low:g}-{high:g} kHz" for low, high in SPANS_KHZ),
        "dashes": "--:|" * len(SPANS_KHZ),
        "received": [received_row(case) for case in cases_received()],
        "shares": [shares_row(part, speed) for speed in BOTH for part in PARTS],
        "loud": loud(),
        "published": published(),
        "narrow": ", ".join(
            listed([received(case).peak for case in over_width(speed)[:2]], ".0f") for speed in BOTH
        ),
        "strikes": list(strike_rows()),
        "sinks": list(sink_rows()),
        "damped": [damping_row(time) for time in TIMES],
        "high": above(*(Case(speed=speed) for speed in BOTH)),
        "whole": above(*(Case(speed=speed, length=WHOLE) for speed in BOTH)),
        "sound": listed([received(healthy(speed)).kurtosis for speed in SPEEDS], ".1f"),
        "ringing": listed([received(healthy(speed)).ringing for speed in SPEEDS], ".1f"),
        "left_out": [
            (what, f"{found.kurtosis:.1f}", f"{found.ringing:.1f}", f"{found.ringing_rms:.2f}")
            for what, found in ((what, received(case)) for what, case in LEFT_OUT.items())
        ],
        "silent": "{:.1f} m/s^2 instead of {:.1f}".format(*silent),
    }


if __name__ == "__main__":
    sys.exit(main())
