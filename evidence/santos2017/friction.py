"""Tangential over normal force of each kind of contact."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.any_bearing import require_tapered
from beardyn_core.scene.operation import ConstantOperation, Step, SteppedOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import CONTACT_FIELDS, CONTACT_KINDS, Block
from evidence.santos2017.runs import SETTLED, StepRecord

Float = NDArray[np.float64]

KINDS = CONTACT_KINDS[:3]
_LEAST = {"cup": 20.0, "cone": 20.0, "rib": 5.0}  # what presses less is left out [N]
_INBOARD = 0
_JUMP, _JUMP_AT, _JUMP_ENDS = 49.0, 0.0095, 0.010  # [rad/s], [s], [s]


@dataclass(frozen=True)
class Contacts:
    """Contacts of one kind over a stretch of a run, inboard row.

    Parameters
    ----------
    normal : float64 array, shape [contact]
        Normal force, [N].
    ratio : float64 array, shape [contact]
        Tangential over normal force, [-].
    slip : float64 array, shape [contact]
        Sliding speed, [m/s].
    film_parameter : float64 array, shape [contact]
        Film thickness over composite roughness, [-].
    """

    normal: Float
    ratio: Float
    slip: Float
    film_parameter: Float

    @property
    def mean_ratio(self) -> float:
        """Tangential over normal force, both summed."""
        return float(self.ratio @ self.normal / self.normal.sum())


def contacts_of(run: StepRecord, kind: str, start: float = SETTLED, end: float = math.inf) -> Contacts:
    """Return the contacts of one kind between two times.

    Parameters
    ----------
    run : StepRecord
    kind : str
        Of `KINDS`.
    start, end : float
        [s].

    Notes
    -----
    The normal is that of the ring's surface at the azimuth of the contact: rings are cones, the cup is held
    and the cone off its place by micrometres only.
    """
    bearing = require_tapered(run.scene.bearing, "normals of ribs")
    fields = np.concatenate([_within(block, start, end) for block in run.blocks])[
        :, _INBOARD, :, CONTACT_KINDS.index(kind)
    ].reshape(-1, len(CONTACT_FIELDS))
    azimuth = np.arctan2(fields[:, 0], fields[:, 2])
    radial, along = {
        "cup": (math.cos(bearing.cup_angle), math.sin(bearing.cup_angle)),
        "cone": (math.cos(bearing.cone_angle), math.sin(bearing.cone_angle)),
        "rib": (-math.cos(bearing.rib_angle), math.sin(bearing.rib_angle)),
    }[kind]
    normals = np.stack(
        [radial * np.sin(azimuth), np.full(len(azimuth), along), radial * np.cos(azimuth)], axis=1
    )
    force = fields[:, 3:6]
    pressed = np.abs((force * normals).sum(axis=1))
    tangential = np.linalg.norm(force - (force * normals).sum(axis=1)[:, None] * normals, axis=1)
    kept = pressed > _LEAST[kind]
    roughness = bearing.rib_roughness if kind == "rib" else bearing.raceway_roughness
    return Contacts(
        pressed[kept], tangential[kept] / pressed[kept], fields[kept, 6], fields[kept, 7] / roughness
    )


def _within(block: Block, start: float, end: float) -> Float:
    instants = block.snapshot_time_ns * 1e-9
    return np.asarray(block.contacts[(instants >= start - 1e-9) & (instants < end)])


def with_speed_jump(scene: Scene) -> Scene:
    """Make the shaft 49 rad/s faster from 10 ms on: inner raceway and rollers slide then.

    Parameters
    ----------
    scene : Scene
        With a constant operation.
    """
    operation = scene.operation
    assert isinstance(operation, ConstantOperation)
    before = Step(0.0, operation.force, operation.speed)
    after = Step(_JUMP_AT, operation.force, operation.speed + _JUMP)
    return replace(scene, operation=SteppedOperation((before, after), ramp=0.0), duration=0.02)


def while_sliding(run: StepRecord, kind: str) -> Contacts:
    """Return the contacts at the first look after the jump of `with_speed_jump`."""
    return contacts_of(run, kind, _JUMP_ENDS, _JUMP_ENDS + 1e-3)
