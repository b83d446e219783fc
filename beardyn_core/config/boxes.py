"""The scene of one axlebox of several: its faults, its lot, and on the right side all of it mirrored."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from beardyn_core.base.edge import Vector
from beardyn_core.base.packed import pack_file
from beardyn_core.effects import EffectSet, ModalStructure
from beardyn_core.scene.axleboxes import Box
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import Accelerometer
from beardyn_core.structure.modes import FIELDS, Modes
from beardyn_core.structure.mounted_box import modes_of_effects
from beardyn_core.structure.table import table_text

_SEEDS = 2**32
_APART = 7919  # between the seeds of boxes: left and right rails have neighbouring ones


def scene_of_box(scene: Scene, box: Box) -> Scene:
    """Make the scene of one axlebox; the load comes from `beardyn_core.rail.train`.

    Every box has another bearing of the lot and other noise: seeds go up from those of the first, which has
    the scene's own. Boxes that are not faulty lose the scene's defects, missing rollers and wheel defects.

    Parameters
    ----------
    scene : Scene
        With `axleboxes`, which the scene of the box has no more.
    """
    assert scene.axleboxes is not None
    train = scene.axleboxes
    number = train.boxes.index(box)
    own = replace(scene, axleboxes=None, seed=(scene.seed + _APART * number) % _SEEDS)
    if scene.scatter is not None:
        own = replace(own, scatter=replace(scene.scatter, seed=(scene.scatter.seed + number) % _SEEDS))
    if box.name not in train.faulty:
        operation = own.operation
        if isinstance(operation, QuarterVehicleOperation):
            operation = replace(operation, wheel_defects=())
        own = replace(own, defects=(), missing_rollers=(), operation=operation)
    return mirror_box(own) if box.side == "right" else own


def mirror_box(scene: Scene) -> Scene:
    """Mirror box, suspension, sensors and rows of a scene at y = 0: a left axlebox becomes a right one.

    Row 0 stays the one at -y: inboard on the left, outboard on the right. The operation stays as it is.
    """
    mounting = scene.mounting
    return replace(
        scene,
        mounting=replace(
            mounting,
            box_centre=_turn_place(mounting.box_centre),
            suspension_centre=_turn_place(mounting.suspension_centre),
            load_offset=_turn_place(mounting.load_offset),
            side="left" if mounting.side == "right" else "right",
        ),
        sensors=tuple(map(_mirrored_sensor, scene.sensors)),
        effects=_with_mirrored_box(scene.effects),
        defects=tuple(replace(each, row=1 - each.row) for each in scene.defects),
        missing_rollers=tuple(replace(each, row=1 - each.row) for each in scene.missing_rollers),
        waviness=tuple(replace(each, row=1 - each.row) for each in scene.waviness),
    )


def _turn_place(place: Vector) -> Vector:
    return (place[0], -place[1] if place[1] else 0.0, place[2])


def _mirrored_sensor(sensor: Accelerometer) -> Accelerometer:
    return replace(sensor, position=_turn_place(sensor.position))


def _with_mirrored_box(effects: EffectSet) -> EffectSet:
    """Mirror the table of modes of effects, where they have one."""
    structure = effects.structure
    if not isinstance(structure, ModalStructure):
        return effects
    modes = modes_of_effects(replace(effects, structure=replace(structure, highest=None)))
    assert modes is not None
    content = pack_file(table_text(mirrored_modes(modes)), structure.table)
    # the factors are in the modes already
    mirrored = replace(structure, content=content, stiffness_factor=1.0, damping_factor=1.0)
    return replace(effects, structure=mirrored)


def mirrored_modes(modes: Modes) -> Modes:
    """Mirror the modes of a box at the plane y = 0."""
    raceway = modes.raceway[:, ::-1].copy()
    raceway[:, :, FIELDS.index("axial")] *= -1.0
    aside = np.array([1.0, -1.0, 1.0])
    xy, xz, yz = modes.products
    return replace(
        modes,
        raceway=raceway,
        seats={name: shape * aside for name, shape in modes.seats.items()},
        places={name: _turn_place(place) for name, place in modes.places.items()},
        centre=_turn_place(modes.centre),
        products=(-xy, xz, -yz),
    )
