"""Coin and roller in the trough as a rerun animation: bodies, contact points, heights, energies."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from beardyn_core.base.arrays import Float
from beardyn_core.laboratory.rolling import ATTITUDE, FIRST_CONTACT, PLACE, Rolling
from beardyn_core.laboratory.search import SURFACE_LINE
from beardyn_core.record.rerun_view import rerun_file

TIMELINE = "time"
_FLOOR_COLOUR, _BODY_COLOUR, _POINT_COLOUR = (122, 136, 160), (255, 196, 64), (255, 60, 255)
_PATH_COLOUR = (96, 190, 255)
_FLOOR_HALF_ANGLE = np.radians(70.0)
_SPACING = 0.15  # of the troughs along their axis, [m]
_CIRCLE_POINTS = 49


def save_rolling(runs: Sequence[Rolling], target: Path, *, replace: bool = True) -> Path:
    """Write an ``.rrd`` file.

    Parameters
    ----------
    runs : sequence of Rolling
        Each in a trough of its own, side by side.
    replace : bool
        Whether a file that is there is replaced.

    Raises
    ------
    InputError
        The file cannot be written.
    """
    with rerun_file(target, "contacts", _blueprint(runs), replace) as stream:
        stream.log("/", rr.ViewCoordinates.RIGHT_HAND_Y_UP, static=True)
        for number, run in enumerate(runs):
            _log_run(stream, f"trough_{number}", run, number * _SPACING)
    return target


def _blueprint(runs: Sequence[Rolling]) -> rrb.Blueprint:
    middle = 0.5 * (len(runs) - 1) * _SPACING
    eye = rrb.EyeControls3D(
        kind=rrb.Eye3DKind.Orbital,
        position=np.array([0.35, 0.35, middle + 0.75]),
        look_target=np.array([0.0, -0.2, middle]),
        eye_up=(0.0, 1.0, 0.0),
    )
    heights = rrb.TimeSeriesView(
        name="height [mm]", contents=[f"/trough_{number}/height" for number in range(len(runs))]
    )
    energies = rrb.TimeSeriesView(
        name="energy of the roller [J]", contents=[f"/trough_{len(runs) - 1}/energy/**"]
    )
    view = rrb.Spatial3DView(origin="/", name="trough", eye_controls=eye)
    return rrb.Blueprint(
        rrb.Horizontal(view, rrb.Vertical(heights, energies), column_shares=[3, 2]), collapse_panels=True
    )


def _log_run(stream: rr.RecordingStream, entity: str, run: Rolling, shift: float) -> None:
    radius, body = run.trough.radius, run.body
    angles = np.linspace(-_FLOOR_HALF_ANGLE, _FLOOR_HALF_ANGLE, 61)
    arc = np.stack([radius * np.sin(angles), -radius * np.cos(angles)], axis=-1)
    half = 0.5 * body.thickness + 0.01
    rails = [np.column_stack([arc, np.full(len(arc), shift + side * half)]) for side in (-1.0, 1.0)]
    rungs = [np.stack([rails[0][i], rails[1][i]]) for i in range(0, len(arc), 6)]
    floor = rr.LineStrips3D([*rails, *rungs], radii=[0.0006], colors=[_FLOOR_COLOUR])
    stream.log(f"{entity}/floor", floor, static=True)
    circles = rr.LineStrips3D(_circles(run), radii=[0.0005], colors=[_BODY_COLOUR])
    stream.log(f"{entity}/body/circles", circles, static=True)
    seconds = rr.TimeColumn(TIMELINE, duration=run.time)
    place = run.history[:, PLACE : PLACE + 3] + np.array([0.0, 0.0, shift])
    attitude = run.history[:, ATTITUDE : ATTITUDE + 4]
    turned = np.roll(attitude, -1, axis=1).astype(np.float32)
    placed = rr.Transform3D.columns(translation=place.astype(np.float32), quaternion=turned)
    stream.send_columns(f"{entity}/body", indexes=[seconds], columns=placed)
    stream.log(f"{entity}/path", rr.LineStrips3D([place], radii=[0.0003], colors=[_PATH_COLOUR]), static=True)
    style = rr.Points3D.from_fields(radii=[0.0012], colors=[_POINT_COLOUR])
    stream.log(f"{entity}/contacts", style, static=True)
    points = contact_points(run) + np.array([0.0, 0.0, shift])
    shown = rr.Points3D.columns(positions=points.reshape(-1, 3).astype(np.float32))
    per_sample = np.full(len(points), body.circles)
    stream.send_columns(f"{entity}/contacts", indexes=[seconds], columns=shown.partition(per_sample))
    _log_curve(stream, f"{entity}/height", seconds, run.height * 1e3, body.name)
    for name, values in run.energies.items():
        _log_curve(stream, f"{entity}/energy/{name}", seconds, values, name)


def _circles(run: Rolling) -> list[Float]:
    """Draw circles of the body with a diameter that shows its turning, in its own axes."""
    angles = np.linspace(0.0, 2.0 * np.pi, _CIRCLE_POINTS)
    ring = run.body.radius * np.stack([np.cos(angles), np.sin(angles), 0.0 * angles], axis=-1)
    strips = [ring + np.array([0.0, 0.0, place]) for place in run.body.places]
    half = 0.5 * run.body.thickness
    spoke = np.array([[-run.body.radius, 0.0, half], [run.body.radius, 0.0, half]])
    return [*strips, spoke]


def contact_points(run: Rolling) -> Float:
    """Compute the points of the floor under the circles, shape [sample, circle, 3], [m]."""
    floor, count = run.trough.floor(), run.body.circles
    assert len(SURFACE_LINE.equations) == 3  # parameters kept for each circle: its own, then the floor's two
    parameters = run.history[:, FIRST_CONTACT:].reshape(len(run.time), count, 3)
    return np.array([[floor.frame(row[1:]).point for row in sample] for sample in parameters])


def _log_curve(
    stream: rr.RecordingStream, entity: str, seconds: rr.TimeColumn, values: Float, name: str
) -> None:
    stream.log(entity, rr.SeriesLines.from_fields(names=[name]), static=True)
    stream.send_columns(entity, indexes=[seconds], columns=rr.Scalars.columns(scalars=values))
