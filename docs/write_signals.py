"""Make the pictures of vibration and spectra in scenes.md: ``python docs/write_signals.py``, two minutes.

Names of scenes may follow; else it is all of `SCENES`. Each is run in tier quasistatic with the effects
that its sensors ask for: a picture shows what a scene sounds like, and that is the cheapest tier with every
roller.
"""

from __future__ import annotations

import io
import sys
from pathlib import Path

import matplotlib as mpl
import numpy as np
from PIL import Image
from scipy.signal import butter, hilbert, sosfiltfilt, welch

import beardyn_core as bd
from beardyn_core.bearing.kinematics import fault_frequencies

mpl.use("Agg")
import matplotlib.pyplot as plt

sys.path.insert(0, str(Path(__file__).parents[1]))
from evidence.stamps import stamp

SCENES = (
    "healthy_140",
    "cup_spall",
    "cone_spall",
    "roller_spall_160",
    "wheel_flat",
    "polygon_wheel",
    "jointed_track",
    "spall_and_flat",
)
TIER = "quasistatic"
FOLDER = Path(__file__).with_name("pictures") / "signals"
LONGEST_S, SETTLED_S, SHOWN_S = 2.0, 0.3, 0.2
BAND_HZ = (2_000.0, 8_000.0)
ORDERS = 25.0  # of the shaft
COLOURS = 16
LINE, FAINT = "#1f4e79", "#7aa6c2"


def signal_of(name: str) -> tuple[np.ndarray, float, np.ndarray, bd.Scene]:
    """Simulate a scene: vertical acceleration [m/s^2], its rate [Hz], turns of the shaft, and the scene."""
    scene = bd.scene(name, tier=TIER, duration=LONGEST_S)
    run = bd.simulate(scene)
    time = np.asarray(run.vibration.time)
    later = time > SETTLED_S
    turns = np.interp(time[later], run.shaft.time, run.shaft.angle) / (2.0 * np.pi)
    return np.asarray(run.vibration.values)[later, 2], round(1.0 / np.diff(time).mean()), turns, scene


def envelope_orders(signal: np.ndarray, rate: float, turns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Compute the spectrum of the envelope over orders of the shaft, [m/s^2]."""
    band = sosfiltfilt(butter(4, BAND_HZ, "bandpass", fs=rate, output="sos"), signal)
    even = np.linspace(turns[0], turns[-1], len(turns))
    outline = np.interp(even, turns, np.abs(hilbert(band)))
    window = np.hanning(len(outline))
    lines = 2.0 * np.abs(np.fft.rfft((outline - outline.mean()) * window)) / window.sum()
    orders = np.fft.rfftfreq(len(outline), (even[-1] - even[0]) / (len(even) - 1))
    return orders, lines


def picture(name: str) -> bytes:
    """Draw a scene's vibration, its spectrum and that of its envelope, as PNG."""
    signal, rate, turns, scene = signal_of(name)
    figure = plt.figure(figsize=(6.4, 3.4), dpi=100)
    grid = figure.add_gridspec(2, 2)
    trace, density, lines = (figure.add_subplot(part) for part in (grid[0, :], grid[1, 0], grid[1, 1]))
    count = round(SHOWN_S * rate)
    trace.plot(SETTLED_S + np.arange(count) / rate, signal[:count], color=LINE, linewidth=0.5)
    trace.set(xlabel="time, s", ylabel="m/s²", xlim=(SETTLED_S, SETTLED_S + SHOWN_S))
    frequency, power = welch(signal, rate, nperseg=2048)
    density.plot(1e-3 * frequency[1:], 10.0 * np.log10(power[1:]), color=LINE, linewidth=0.8)
    density.set(xlabel="frequency, kHz", ylabel="dB re (m/s²)²/Hz", xlim=(0.0, 10.0))
    orders, heights = envelope_orders(signal, rate, turns)
    shown = (orders > 0.0) & (orders <= ORDERS)
    lines.plot(orders[shown], heights[shown], color=LINE, linewidth=0.8)
    lines.set(xlabel="orders of the shaft", ylabel="envelope, m/s²", xlim=(0.0, ORDERS), ylim=(0.0, None))
    faults = fault_frequencies(scene.bearing)
    marks = (
        ("cup", faults.bpfo, "left"),
        ("cone", faults.bpfi, "left"),
        ("roller", 2.0 * faults.bsf, "right"),
    )
    for words, order, side in marks:
        lines.axvline(order, color=FAINT, linewidth=1.0, linestyle=":", zorder=0)
        lines.text(order, 1.01, words, transform=lines.get_xaxis_transform(), fontsize=7, ha=side)
    figure.align_ylabels()
    figure.tight_layout(pad=0.4)
    drawn, small = io.BytesIO(), io.BytesIO()
    figure.savefig(drawn, format="png")
    plt.close(figure)
    Image.open(drawn).convert("RGB").quantize(COLOURS).save(small, format="png", optimize=True)
    return small.getvalue()


def main(names: list[str]) -> None:
    """Write the pictures."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in names or SCENES:
        path = FOLDER / f"{name}.png"
        path.write_bytes(picture(name))
        stamp(path)
        print(f"{FOLDER / name}.png is written", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
