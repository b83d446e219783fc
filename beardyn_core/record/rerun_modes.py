"""The first modes of an axlebox in motion: its surface, coloured by how far each place goes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.record.load_colours import load_colours
from beardyn_core.record.rerun_bearing import send
from beardyn_core.record.rerun_view import BACKGROUND, rerun_file
from beardyn_core.record.viewer import TIMELINE
from beardyn_core.structure.build import Built

SHOWN = 8
FRAMES = 24  # of one turn, which takes a second whatever the mode
_LARGEST = 0.06  # displacement as shown, share of the size of the box


def exaggerate_shape(built: Built, mode: int) -> Float:
    """Scale the shape of a free mode so that it can be seen, shape [corner, 3], [m]."""
    shape = built.shapes[mode]
    places = built.body.surface.places
    size = np.linalg.norm(np.ptp(places, axis=0))
    return np.asarray(shape * (_LARGEST * size / np.linalg.norm(shape, axis=1).max()))


def title(built: Built, mode: int) -> str:
    """Name a mode by its frequency and damping."""
    modes = built.modes
    return f"{mode + 1}: {modes.frequency[mode]:.0f} Hz, damping {modes.damping_ratio[mode]:.3g}"


def save_modes(built: Built, target: Path, *, replace: bool = True) -> Path:
    """Write an ``.rrd`` file in which the first free modes move side by side.

    Parameters
    ----------
    built : Built
    target : Path
    replace : bool
        Whether a file that is there is replaced.

    Raises
    ------
    InputError
        The file cannot be written.
    """
    surface = built.body.surface
    shown = range(min(SHOWN, len(built.shapes)))
    turn = np.arange(FRAMES) / FRAMES
    eye = rrb.EyeControls3D(
        kind=rrb.Eye3DKind.Orbital,
        position=surface.places.mean(axis=0)
        + np.array([0.35, 0.95, 0.55]) * np.ptp(surface.places, axis=0).max(),
        look_target=surface.places.mean(axis=0),
        eye_up=(0.0, 0.0, 1.0),
    )
    views = [
        rrb.Spatial3DView(
            origin=f"mode_{mode + 1}",
            name=title(built, mode),
            background=BACKGROUND,
            line_grid=False,
            eye_controls=eye,
        )
        for mode in shown
    ]
    layout = rrb.Blueprint(
        rrb.Grid(*views, grid_columns=4),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(state="collapsed", timeline=TIMELINE, loop_mode="all", play_state="playing"),
        auto_views=False,
    )
    with rerun_file(target, built.modes.name, layout, replace) as stream:
        stream.log("/", rr.ViewCoordinates.FLU, static=True)
        for mode in shown:
            shape = exaggerate_shape(built, mode)
            far = np.linalg.norm(shape, axis=1)
            skin = rr.Mesh3D.from_fields(
                triangle_indices=surface.triangles.astype(np.uint32),
                vertex_normals=_normals(surface.places, surface.triangles),
                vertex_colors=load_colours(far, float(far.max())),
            )
            stream.log(f"mode_{mode + 1}", skin, static=True)
            moved = surface.places + np.sin(2.0 * np.pi * turn)[:, None, None] * shape
            positions = rr.Mesh3D.columns(vertex_positions=moved.reshape(-1, 3).astype(np.float32))
            time_ns = np.round(1e9 * turn).astype(np.int64)
            send(stream, f"mode_{mode + 1}", time_ns, positions.partition([len(shape)] * FRAMES))
    return target


def _normals(places: Float, triangles: Any) -> NDArray[np.float32]:
    """Give the mean outward normal at each corner, triangles counted by their area."""
    first, second, third = (places[triangles[:, i]] for i in range(3))
    found = np.zeros_like(places)
    np.add.at(found, triangles, np.cross(second - first, third - first)[:, None])
    return (found / np.linalg.norm(found, axis=1, keepdims=True)).astype(np.float32)
