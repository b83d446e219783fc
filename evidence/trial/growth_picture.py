"""Draw what a monitor finds of spalls while they grow, for three surfaces, as docs/pictures/growth.png.

``python -m evidence.trial.page FOLDER`` draws it of the folder of the trial `growth`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from evidence.pages import PICTURES, save_small

PICTURE = PICTURES / "growth.png"
WIDTH_PX, HEIGHT_PX, DPI = 1200, 420, 100
COLOURS = 64
_WHAT = {"fine": "smooth bearing", "typical": "typical bearing", "coarse": "rough bearing"}
_DARK = 0.75  # share from which the text on a field is light


def draw(found: dict[str, Any], path: Path = PICTURE) -> None:
    """Draw the share of spalls found of the JSON object of a trial with surfaces: part by width."""
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, layout="constrained")
    rows = found["sizes"]
    surfaces = [each["surface"] for each in rows[0]["surfaces"]]
    parts = list(dict.fromkeys(row["fault"] for row in rows))
    widths = list(dict.fromkeys(row["width_m"] for row in rows))
    alarms = found["slices"][0]["false_alarms"]
    figure.suptitle(
        "Spalls that the monitor finds and names right, while they grow; "
        f"{alarms['count']} of {alarms['total']} healthy bearings raise an alarm"
    )
    for place, axes in enumerate(np.atleast_1d(figure.subplots(1, len(surfaces), sharey=True))):
        counts = [[row["surfaces"][place]["found"] for row in rows if row["fault"] == part] for part in parts]
        _draw_surface(axes, counts)
        axes.set_title(f"{_WHAT[surfaces[place]]} ({surfaces[place]} surface)", fontsize=11)
        axes.set_xticks(range(len(widths)), [f"{1e3 * width:g}" for width in widths])
        axes.set_yticks(range(len(parts)), parts)
        axes.set_xlabel("width of the spall along the raceway, mm")
    figure.savefig(path, dpi=DPI, format="png")
    save_small(path, path, COLOURS)


def _draw_surface(axes: Axes, counts: list[list[dict[str, Any]]]) -> None:
    share = np.array([[each["count"] / each["total"] for each in row] for row in counts])
    axes.imshow(share, cmap="Greens", vmin=0.0, vmax=1.0, aspect="auto")
    for i, j in np.ndindex(share.shape):
        each = counts[i][j]
        colour = "white" if share[i, j] >= _DARK else "black"
        axes.text(j, i, f"{each['count']} of\n{each['total']}", ha="center", va="center", color=colour)
    axes.set_xticks(np.arange(share.shape[1] + 1) - 0.5, minor=True)
    axes.set_yticks(np.arange(share.shape[0] + 1) - 0.5, minor=True)
    axes.grid(which="minor", color="white", linewidth=2)
    axes.tick_params(which="both", length=0)
