"""The bearing in 3-D: parts, their motion, roller loads as colour, forces as arrows, the load zone."""

from __future__ import annotations

from typing import Any

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.record import meshes
from beardyn_core.record.description import RunDescription
from beardyn_core.record.load_colours import CONE_COLOUR, CUP_COLOUR, SPALL_COLOUR, load_colours
from beardyn_core.record.meshes import Mesh
from beardyn_core.record.run import Run
from beardyn_core.record.viewer import TIMELINE
from beardyn_core.scene.field_spall import FieldSpall
from beardyn_core.scene.patch import Patch

SNAPSHOT_NS = 5_000_000  # at 200 Hz, after which the first one is taken
ROOT = "bearing"
CAGE_COLOUR = (64, 150, 140)
ARROW_COLOURS = {
    "cup": (255, 196, 64),
    "cone": (96, 190, 255),
    "rib": (255, 110, 180),
    "pocket": (120, 230, 140),
}
RESULTANT_COLOUR = (255, 60, 255)
LONGEST_ARROW = 0.042
LONGEST_BAR = 0.055
ZONE_RADIUS = 1.08


def log_parts(stream: rr.RecordingStream, run: RunDescription) -> None:
    """Log the meshes, which do not change."""
    shape = run.shape
    stream.log("/", rr.ViewCoordinates.FLU, static=True)
    _log_mesh(stream, f"{ROOT}/cup/part", meshes.cup(shape), CUP_COLOUR)
    _log_mesh(stream, f"{ROOT}/cone/part", meshes.cone(shape), CONE_COLOUR)
    roller = meshes.roller(shape)
    for row in range(2):
        if f"cage_{row}" not in run.absent_bodies:
            _log_mesh(stream, f"{ROOT}/cage_{row}/part", meshes.cage(shape, row), CAGE_COLOUR)
        for k in range(shape.roller_count):
            if f"roller_{row}_{k}" not in run.absent_bodies:
                _log_mesh(stream, f"{ROOT}/rollers/roller_{row}_{k}", roller, (255, 255, 255))
    for number, defect in enumerate(run.defects):
        if isinstance(defect, Patch | FieldSpall) and defect.on in ("cup", "cone"):
            entity = f"{ROOT}/{defect.on}/spall_{number}"
            _log_mesh(stream, entity, meshes.spall(shape, defect), SPALL_COLOUR)
            _log_pin(stream, f"{entity}/pin", run, defect)


def _log_pin(
    stream: rr.RecordingStream, entity: str, run: RunDescription, defect: Patch | FieldSpall
) -> None:
    """Draw a line with a name from the spall to outside the bearing, as raceways are hidden."""
    shape = run.shape
    middle = defect.extent[1] if isinstance(defect, FieldSpall) else defect.offset
    axial = meshes.ROW_SIDE[defect.row] * (shape.row_spacing / 2.0 + middle)
    inner = shape.pitch_diameter / 2.0
    outer = (1.66 if defect.on == "cup" else 1.25) * shape.outer_diameter / 2.0
    ends = _polar(np.full(2, defect.azimuth), np.array([inner, outer]), axial).astype(np.float32)
    stream.log(entity, rr.LineStrips3D([ends], radii=[0.0008], colors=[SPALL_COLOUR]), static=True)
    label = f"{defect.on} {defect.kind.replace('_', ' ')}, {defect.width * 1e3:.0f} mm"
    named = rr.Points3D(ends[1:], radii=[0.0022], colors=[SPALL_COLOUR], labels=[label], show_labels=True)
    stream.log(f"{entity}/name", named, static=True)


def body_entity(name: str) -> str:
    """Name the entity of a body."""
    return f"{ROOT}/rollers/{name}" if name.startswith("roller") else f"{ROOT}/{name}"


def log_motion(stream: rr.RecordingStream, run: Run) -> None:
    """Log the pose of every body at every snapshot."""
    for body, name in enumerate(run.described().body_names):
        pose = run.bodies.pose[:, body].astype(np.float32)
        placed = rr.Transform3D.columns(translation=pose[:, :3], quaternion=pose[:, 3:])
        send(stream, body_entity(name), shown_ns(run), placed)


def roller_loads(run: Run) -> Float:
    """Give the cup-roller load at every snapshot, shape [snapshot, row, roller], [N]."""
    return run.contacts.load[..., run.contacts.of("cup")]


def log_loads(stream: rr.RecordingStream, run: Run, largest: float | None = None) -> None:
    """Log roller colours, contact forces, the resultant and the load zone.

    ``largest`` is the roller load [N] that has the last colour and the longest arrow; by default the largest
    of the run, and then the outline of the load zone over the whole run is drawn too.
    """
    shape = run.described().shape
    load = roller_loads(run)
    whole = largest is None
    if largest is None:
        largest = float(load.max(initial=0.0))
    packed = _pack_colours(load_colours(load, largest))
    for row, k in np.ndindex(2, shape.roller_count):
        if (name := f"roller_{row}_{k}") not in run.described().absent_bodies:
            coloured = rr.Mesh3D.columns(albedo_factor=packed[:, row, k])
            send(stream, body_entity(name), shown_ns(run), coloured)
    if largest == 0.0:
        return
    _log_contacts(stream, run, LONGEST_ARROW / largest)
    _log_zone(stream, run, load, largest, packed)
    if whole:
        _log_zone_outline(stream, run, load, largest)
    _log_resultant(stream, run, largest)


def _log_contacts(stream: rr.RecordingStream, run: Run, scale: float) -> None:
    contacts = run.contacts
    for kind, name in enumerate(contacts.kinds):
        here = contacts.touching[..., kind]
        if not here.any():
            continue
        per_snapshot = here.sum(axis=(1, 2))
        origins = contacts.point[..., kind, :][here]
        # Forces the rollers exert on their partners: they point out of the rollers and stay visible.
        vectors = -scale * contacts.force[..., kind, :][here]
        entity = f"{ROOT}/contact_forces/{name}"
        style = rr.Arrows3D.from_fields(colors=[ARROW_COLOURS[name]], radii=[0.0009])
        stream.log(entity, style, static=True)
        arrows = rr.Arrows3D.columns(origins=origins, vectors=vectors).partition(per_snapshot)
        send(stream, entity, shown_ns(run), arrows)


def _log_zone(
    stream: rr.RecordingStream, run: Run, load: Float, largest: float, packed: NDArray[np.uint32]
) -> None:
    """Draw bars on the outer face of each row: length is the load of the roller behind it."""
    shape = run.described().shape
    inner = ZONE_RADIUS * shape.outer_diameter / 2.0
    for row, side in enumerate(meshes.ROW_SIDE):
        azimuth, axial = _azimuths(run, row), side * shape.row_spacing / 2.0
        outer = inner + LONGEST_BAR * load[:, row] / largest
        strips = np.stack((_polar(azimuth, inner, axial), _polar(azimuth, outer, axial)), axis=2)
        count, rollers = azimuth.shape
        entity = f"{ROOT}/load_zone/row_{row}"
        stream.log(entity, rr.LineStrips3D.from_fields(radii=[0.0020]), static=True)
        bars = rr.LineStrips3D.columns(
            strips=strips.reshape(-1, 2, 3).astype(np.float32), colors=packed[:, row].reshape(-1)
        )
        send(stream, entity, shown_ns(run), bars.partition(np.full(count, rollers)))


def _log_zone_outline(stream: rr.RecordingStream, run: Run, load: Float, largest: float) -> None:
    """Draw the largest load at each azimuth over the whole run."""
    shape = run.described().shape
    inner = ZONE_RADIUS * shape.outer_diameter / 2.0
    for row, side in enumerate(meshes.ROW_SIDE):
        azimuth, axial = _azimuths(run, row), side * shape.row_spacing / 2.0
        ring = np.linspace(0.0, 2.0 * np.pi, 91)
        where = np.mod(azimuth.ravel(), 2.0 * np.pi)
        bins = np.clip(np.digitize(where, ring) - 1, 0, len(ring) - 2)
        envelope = np.zeros(len(ring) - 1)
        np.maximum.at(envelope, bins, load[:, row].ravel())
        outline = inner + LONGEST_BAR * np.append(envelope, envelope[0]) / largest
        lines = rr.LineStrips3D(
            [_polar(ring, inner, axial), _polar(ring, outline, axial)],
            radii=[0.0003, 0.0005],
            colors=[(120, 126, 140), (230, 200, 140)],
        )
        stream.log(f"{ROOT}/load_zone/outline_{row}", lines, static=True)


def _azimuths(run: Run, row: int) -> Float:
    first = run.described().body_names.index(f"roller_{row}_0")
    place = run.bodies.pose[:, first : first + run.described().roller_count, :3]
    return np.arctan2(place[..., 0], place[..., 2])


def _log_resultant(stream: rr.RecordingStream, run: Run, largest_roller_load: float) -> None:
    """Draw the force on the cup in front of the bore; half a bore stands for 6 largest roller loads."""
    if not len(run.force):
        return
    shape = run.described().shape
    origin = [0.0, max(shape.width, shape.outer_diameter / 2.0) / 2.0 + 0.006, 0.0]
    style = rr.Arrows3D.from_fields(colors=[RESULTANT_COLOUR], radii=[0.0022], origins=[origin])
    stream.log(f"{ROOT}/force_on_cup", style, static=True)
    scale = shape.bore / 2.0 / (6.0 * largest_roller_load)
    arrows = rr.Arrows3D.columns(vectors=(scale * run.force.values[:, :3]).astype(np.float32))
    send(stream, f"{ROOT}/force_on_cup", run.force.time_ns, arrows)


def shown_ns(run: Run) -> NDArray[np.int64]:
    """Give the stamps of the snapshots, the first one from 0 on: the view begins there, paused."""
    time_ns = run.bodies.time_ns.copy()
    if len(time_ns) and time_ns[0] <= SNAPSHOT_NS:
        time_ns[0] = 0
    return time_ns


def send(stream: rr.RecordingStream, entity: str, time_ns: NDArray[np.int64], columns: Any) -> None:
    """Send what an entity shows over the simulated time."""
    time = rr.TimeColumn(TIMELINE, duration=time_ns.astype("timedelta64[ns]"))
    stream.send_columns(entity, indexes=[time], columns=columns)


def _polar(azimuth: Float, radius: Any, axial: float) -> Float:
    places = (radius * np.sin(azimuth), np.full(azimuth.shape, axial), radius * np.cos(azimuth))
    return np.stack(places, axis=-1)


def _pack_colours(colours: NDArray[np.uint8]) -> NDArray[np.uint32]:
    opaque = np.full(colours.shape[:-1], 0xFF, np.uint8)
    return np.concatenate((colours, opaque[..., None]), axis=-1).view(">u4")[..., 0].astype(np.uint32)


def _log_mesh(stream: rr.RecordingStream, entity: str, mesh: Mesh, colour: tuple[int, int, int]) -> None:
    shown = rr.Mesh3D(
        vertex_positions=mesh.vertices.astype(np.float32),
        vertex_normals=mesh.normals.astype(np.float32),
        triangle_indices=mesh.triangles.astype(np.uint32),
        vertex_colors=(mesh.shades * np.array(colour)).astype(np.uint8),
    )
    stream.log(entity, shown, static=True)
