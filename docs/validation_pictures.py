"""Small plots of the validation page, one function a picture."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")
from matplotlib import pyplot as plt

from test.anchors.posture import posture
from test.anchors.trends import ECCENTRICITIES

DPI = 80


def draw_posture(path: Path) -> None:
    """Skew and tilt over azimuth for three load eccentricities, both rows."""
    figure, axes = plt.subplots(2, 2, figsize=(9.0, 4.6), sharex=True, sharey="row", layout="constrained")
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


PICTURES = {"posture.png": draw_posture}
