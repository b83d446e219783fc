"""Pictures of docs/evidence/structure.md: the first modes, the answer of the sensor, the number of modes."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.ticker import ScalarFormatter
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from beardyn_core.base.arrays import Float
from beardyn_core.record.rerun_modes import exaggerate_shape, title
from beardyn_core.structure.build import Built
from beardyn_core.study.measures import BAND_CENTRES
from evidence.pages import PICTURES, save_small
from evidence.structure.number import LOWEST_BAND, Kept, apart
from evidence.structure.study import BOX, LINES, Answer

matplotlib.use("agg")
SHOWN = 8
_LIGHT = np.array([0.4, 0.5, 0.77])


def draw_modes(built: Built) -> None:
    """Draw the surface in the first modes, coloured by how far each place goes."""
    triangles = built.body.surface.triangles
    figure, every = plt.subplots(2, 4, figsize=(11.0, 5.6), subplot_kw={"projection": "3d"})
    for mode, axes in enumerate(every.flat[:SHOWN]):
        shape = exaggerate_shape(built, mode)
        moved = (built.body.surface.places + shape)[triangles]
        far = np.linalg.norm(shape, axis=1)[triangles].mean(axis=1)
        normal = np.cross(moved[:, 1] - moved[:, 0], moved[:, 2] - moved[:, 0])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        shade = 0.55 + 0.45 * np.clip(normal @ _LIGHT, 0.0, 1.0)
        colours = plt.get_cmap("turbo")(0.08 + 0.84 * far / far.max())
        colours[:, :3] *= shade[:, None]
        axes.add_collection3d(
            Poly3DCollection(moved, facecolors=colours, edgecolors="none", antialiased=False)
        )
        low, high = moved.min(axis=(0, 1)), moved.max(axis=(0, 1))
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
        axes.set_box_aspect(high - low, zoom=1.1)
        axes.view_init(elev=24.0, azim=58.0)
        axes.set_axis_off()
        axes.set_title(title(built, mode), y=-0.08, fontsize=10)
    figure.subplots_adjust(0.0, 0.06, 1.0, 1.0, 0.0, 0.06)
    _save(figure, "structure_modes.png", 160)


def draw_answer(answer: Answer) -> None:
    """Draw the answers of finite elements and modes over frequency."""
    figure, axes = plt.subplots(figsize=(7.0, 3.4), layout="constrained")
    axes.loglog(LINES, 1e12 * np.abs(answer.elements), "k", lw=2.5, label="finite elements")
    axes.loglog(LINES, 1e12 * np.abs(answer.modes), "C1", lw=1.2, label="free and residual modes")
    axes.loglog(LINES, 1e12 * np.abs(answer.free), "C0:", lw=1.2, label="free modes alone")
    axes.set(ylabel="elastic answer [nm/kN]", title=f"{BOX}: raceways to axlebox_top")
    _over_frequency(axes, (200, 500, 1000, 2000, 4000, 8000))
    axes.legend()
    _save(figure, "structure_answer.png", 32)


def draw_number(found: Sequence[Kept], chance: Float) -> None:
    """Draw what changes when modes are left out, and the third octaves of the runs."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.0, 3.8), layout="constrained")
    every, fewer = found[-1], found[:-1]
    highest = [each.highest for each in fewer]
    left.semilogy(highest, [max(each.response, 1e-3) for each in fewer], "C0o-", label="answer to 8 kHz")
    left.semilogy(
        highest, [apart(each.levels, every.levels) for each in fewer], "C1s-", label="run: third octaves"
    )
    left.axhline(apart(chance, every.levels), color="C1", ls=":", label="run: end play 1 nm wider")
    left.axhline(1.0, color="k", lw=0.8)
    left.set(ylabel="largest change [dB]", title="free modes up to")
    _over_frequency(left, (1000, 2000, 4000, 6000, 10000))
    left.legend()
    seen = BAND_CENTRES > 0.99 * LOWEST_BAND
    for each, style in ((found[0], "C2"), (found[3], "C0"), (every, "k")):
        words = f"to {each.highest / 1e3:g} kHz" if each is not every else "all"
        right.plot(BAND_CENTRES[seen], each.levels[seen], style, label=words)
    right.set(ylabel="third octave re 1 µm/s² [dB]", title="cup_spall, all axes")
    right.set_xscale("log")
    _over_frequency(right, (200, 500, 1000, 2000, 5000, 10000))
    right.legend()
    _save(figure, "structure_number.png", 32)


def _over_frequency(axes: Any, ticks: tuple[int, ...]) -> None:
    axes.set_xscale("log")
    axes.set_xticks(ticks)
    axes.xaxis.set_major_formatter(ScalarFormatter())
    axes.minorticks_off()
    axes.set_xlabel("frequency [Hz]")
    axes.grid(True, alpha=0.3)


def _save(figure: Any, name: str, colours: int) -> None:
    with tempfile.TemporaryDirectory() as folder:
        raw = Path(folder) / "raw.png"
        figure.savefig(raw, dpi=110)
        plt.close(figure)
        save_small(raw, PICTURES / name, colours)
