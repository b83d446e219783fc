"""Pictures of the runs of Santos (2017), one function a picture."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from beardyn_core.effects import CoulombTraction, MixedTraction
from evidence.pages import save_small
from evidence.santos2017.comparison import SantosRuns
from evidence.santos2017.friction import contacts_of, while_sliding
from evidence.santos2017.runs import SETTLED, STEP_AT
from evidence.santos2017.spectrum import PUBLISHED_BAND, Bands, smoothed

DPI = 80
COLOURS = 256


def _save(figure: Figure, path: Path) -> None:
    """Save a figure as a PNG of 8 bits a pixel."""
    figure.savefig(path, dpi=DPI)
    plt.close(figure)
    save_small(path, path, COLOURS)


def draw_step(runs: SantosRuns, path: Path) -> None:
    """Draw the radial force on the inner ring after the load comes on."""
    figure, panel = plt.subplots(figsize=(7.4, 3.2), layout="constrained")
    for run, label, width in (
        (runs.undamped, "at once, contacts without damping", 0.6),
        (runs.sudden, "at once", 0.8),
        (runs.step, "within 0.5 ms (the shipped scene)", 1.4),
    ):
        panel.plot(1e3 * (run.time - STEP_AT), run.force[:, 2] / 1e3, label=label, linewidth=width)
    panel.axhline(5.0, color="black", linestyle=":", linewidth=1.0)
    panel.axvline(1e3 * SETTLED, color="grey", linestyle="--", linewidth=1.0)
    panel.annotate(
        "Santos (2017): force\nhas converged here", (1e3 * SETTLED, 8.0), ha="right", fontsize="small"
    )
    panel.set_xlim(-0.5, 14.0)
    panel.set_xlabel("time after the load, ms")
    panel.set_ylabel("radial force, kN")
    panel.legend(fontsize="small")
    panel.grid(alpha=0.3)
    _save(figure, path)


def draw_spectrum(runs: SantosRuns, path: Path) -> None:
    """Draw the spectra of the undamped row as it is and with stiffer contacts."""
    by_name = {each.variation.name: each for each in runs.bands}
    shown = (by_name["as it is"], by_name["contacts 4.92 times as stiff"])
    figure, panels = plt.subplots(2, 1, figsize=(7.4, 4.4), sharex=True, layout="constrained")
    for panel, each, title in zip(
        panels,
        shown,
        ("line contacts as they are", "the whole roller length in each of six slices: 4.92 times as stiff"),
        strict=True,
    ):
        _spectrum(panel, each)
        panel.set_title(title, fontsize="medium")
    panels[0].legend(fontsize="small")
    panels[1].set_xlabel("frequency, kHz")
    _save(figure, path)


def _spectrum(panel: Axes, each: Bands) -> None:
    level = smoothed(each.frequency, each.amplitude)
    panel.semilogy(each.frequency / 1e3, level, color="tab:blue", label="mean within 1 kHz")
    labels = ("rollers on the cup alone", "rollers between both raceways")
    for frequency, style, label in zip(each.bounce, (":", "--"), labels, strict=True):
        panel.axvline(frequency / 1e3, color="tab:red", linestyle=style, label=label)
    edges = (PUBLISHED_BAND / 1e3 - 1.5, PUBLISHED_BAND / 1e3 + 1.5)
    panel.axvspan(*edges, color="grey", alpha=0.3, label="band of Santos (2017)")
    panel.set_xlim(0.0, 50.0)
    panel.set_ylim(1e-3, 30.0)
    panel.set_ylabel("amplitude, N")
    panel.grid(alpha=0.3)


def draw_friction(runs: SantosRuns, path: Path) -> None:
    """Draw tangential over normal force against slip speed, the laws as lines."""
    figure, panel = plt.subplots(figsize=(7.4, 3.4), layout="constrained")
    slip = np.geomspace(1e-4, 10.0, 200)
    dry, oil = CoulombTraction(friction=0.1, regularisation_speed=0.01), MixedTraction()
    for limit, speed, label in (
        (dry.friction, dry.regularisation_speed, "dry"),
        (oil.full_film_friction, oil.regularisation_speed, "Eq. (8), full film"),
    ):
        panel.loglog(slip, limit * slip / np.hypot(slip, speed), color="black", linewidth=0.8)
        panel.annotate(label, (0.3, 1.1 * limit), fontsize="small")
    for contacts, label, marker in (
        (contacts_of(runs.loaded, "cup"), "dry, cup, 5 kN", "."),
        (while_sliding(runs.jump, "cone"), "dry, cone, after a jump of speed", "x"),
        (contacts_of(runs.loaded, "rib"), "dry, rib", "+"),
        (contacts_of(runs.lubricated, "cup"), "oil, cup, 5 kN", "."),
        (contacts_of(runs.lubricated, "rib"), "oil, rib (a fixed 5 %)", "+"),
    ):
        panel.loglog(contacts.slip, contacts.ratio, marker, markersize=4, label=label, linestyle="none")
    panel.axhline(0.1, color="grey", linestyle="--", linewidth=1.0)
    panel.set_xlim(1e-4, 10.0)
    panel.set_ylim(5e-4, 0.3)
    panel.set_xlabel("slip speed, m/s")
    panel.set_ylabel("tangential / normal force")
    panel.legend(fontsize="small", loc="lower right")
    panel.grid(alpha=0.3)
    _save(figure, path)


DRAWINGS = {
    "santos_step.png": draw_step,
    "santos_spectrum.png": draw_spectrum,
    "santos_friction.png": draw_friction,
}
