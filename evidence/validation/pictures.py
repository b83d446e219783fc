"""Small plots of the validation page, one function a picture."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")
from matplotlib import pyplot as plt

from evidence.validation import skid, whirl
from evidence.validation.posture import posture
from evidence.validation.trends import ECCENTRICITIES

DPI = 80


def draw_posture(path: Path) -> None:
    """Draw skew and tilt over azimuth for three load eccentricities, both rows."""
    figure, axes = plt.subplots(2, 2, figsize=(6.8, 3.7), sharex=True, sharey="row", layout="constrained")
    for condition in ECCENTRICITIES:
        run = posture(condition)
        for row, name in ((0, "inboard row"), (1, "outboard row")):
            label = f"{condition.eccentricity:g} mm off centre"
            axes[0, row].plot(run.azimuth, run.skew[row], label=label)
            axes[1, row].plot(run.azimuth, run.tilt[row], label=label)
            axes[0, row].set_title(name)
    for panel in axes.flat:
        panel.grid(alpha=0.3)
        panel.set_xlim(-180, 180)
        panel.set_xticks(range(-180, 181, 90))
    axes[0, 0].set_ylabel("skew, mrad")
    axes[1, 0].set_ylabel("tilt, mrad")
    axes[1, 0].set_xlabel("azimuth from the top, deg")
    axes[1, 1].set_xlabel("azimuth from the top, deg")
    axes[0, 1].legend(fontsize="small")
    figure.savefig(path, dpi=DPI)
    plt.close(figure)


def draw_whirl(path: Path) -> None:
    """Draw the rms radius of whirl over speed, over axial load and over radial load added to an axial one."""
    figure, axes = plt.subplots(1, 3, figsize=(9.0, 2.9), sharey=True, layout="constrained")
    axes[0].plot(whirl.SPEEDS, whirl.microns(whirl.over_speed()), "o-")
    axes[0].set_title(f"{whirl.AXIAL / 1e3:g} kN axial, {whirl.REVOLUTIONS:g} rev.")
    axes[0].set_xlabel("shaft speed, rad/s")
    loads = [load / 1e3 for load in whirl.LOADS]
    axes[1].plot(loads, whirl.microns(whirl.over_load()), "o-")
    axes[1].set_title(f"{whirl.LOADED_SPEED:g} rad/s, {whirl.LOADED_REVOLUTIONS:g} rev.")
    axes[1].set_xlabel("axial load, kN")
    radial = [load / 1e3 for load in whirl.RADIAL]
    axes[2].plot(radial, whirl.microns(whirl.over_radial()), "o-", label="whirl, rms")
    spacing = whirl.microns(whirl.over_radial(), "spacing")
    axes[2].plot(radial, spacing, "s--", label="uneven spacing, rms")
    axes[2].set_title(f"added to {whirl.COMBINED_AXIAL / 1e3:g} kN axial")
    axes[2].set_xlabel("radial load, kN")
    play = whirl.play()
    for panel in axes:
        panel.axhline(play, color="grey", linestyle=":", label="radial play")
        panel.grid(alpha=0.3)
        panel.legend(fontsize="small")
    axes[0].set_ylabel("orbit of the cage, µm")
    figure.savefig(path, dpi=DPI)
    plt.close(figure)


def draw_skid(path: Path) -> None:
    """Draw the slip of the cages over radial load, for each grease and end play."""
    figure, panel = plt.subplots(figsize=(5.6, 3.2), layout="constrained")
    for filling in skid.SERIES:
        panel.semilogx(
            skid.LOADS_KN, [100.0 * slip for slip in skid.slips(filling)], "o-", label=filling.name
        )
    panel.axvline(skid.MINIMUM_KN, color="grey", linestyle=":", label="0.02 C")
    light = (skid.LOADS_KN[0], skid.LIGHT_KN)
    panel.fill_between(light, 10.0, 60.0, alpha=0.25, color="grey", label="published at light load")
    panel.set_xlabel("radial load, kN")
    panel.set_ylabel("cage slip, %")
    panel.set_ylim(-2.0, 100.0)
    panel.grid(alpha=0.3)
    panel.legend(fontsize="small", loc="upper left", bbox_to_anchor=(1.0, 1.0))
    figure.savefig(path, dpi=DPI)
    plt.close(figure)


DRAWINGS = {"posture.png": draw_posture, "whirl.png": draw_whirl, "skid.png": draw_skid}
