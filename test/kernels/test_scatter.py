"""Kernels that know scatter: the crown of each roller, and the ends of its pocket."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from beardyn_core.effects import EffectSet, LaminaCoupling
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.bodies.layout import (
    ANGLE,
    AXIAL,
    AXIS,
    CAGE_BODY,
    LAMINA_DROP,
    LAMINA_PLACE,
    OVERSIZE,
    POCKET_ANGLE,
    POSITION,
)
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.physics.tiers.tiers import lumped_parameters, quasistatic_parameters
from beardyn_core.scene.scatter import Scatter
from beardyn_core.scene.scene import Scene
from test.kernels.casting import Float, through
from test.kernels.fault_entries import moving_contacts, worn_pockets
from test.kernels.rig import Rig, parameters_of
from test.scenes import scene_with

Z = 17


def made(effects: EffectSet | None = None, **variations: Any) -> Scene:
    return replace(scene_with(effects), scatter=Scatter(seed=3, **variations))


def parameters(scene: Scene, width: int) -> Parameters:
    return parameters_of(scene, width)


def cup_contacts(lanes: Any, p: Parameters, scene: Scene) -> Float:
    """Outputs of `moving_contacts` of the first roller, pressed by some depths, tilted, and skewed."""
    bearing = scene.bearing
    cases = []
    for depth, tilt, skew in [(3e-6, 0.0, 0.0), (1.2e-5, 1e-4, 0.0), (2e-5, -2e-4, 5e-4), (-1e-4, 0.0, 0.0)]:
        angle = bearing.contact_angle + tilt
        axis = np.array([math.sin(angle), skew, math.cos(angle)])
        outer = bearing.cup_angle
        centre = np.array([0.5 * bearing.pitch_diameter, 0.0, 0.5 * bearing.row_spacing])
        place = centre + bearing.roller_mass_offset * axis
        place = place + depth * np.array([math.cos(outer), 0.0, -math.sin(outer)])
        cases.append([0.0, 0.0, *place, *axis, 0.01, 0.0, 0.02])
    rows = np.repeat(np.array(cases), lanes.width, axis=0)
    return through(lanes, moving_contacts, rows, 6, p).reshape(len(cases), lanes.width, 6)[:, 0]


@pytest.mark.parametrize(
    "effects", [EffectSet(), replace(EffectSet(), lamina_coupling=LaminaCoupling())], ids=["plain", "coupled"]
)
def test_error_of_a_crown_is_that_drop_more_in_the_table_of_the_laminae(
    lanes: Any, effects: EffectSet
) -> None:
    scene = made(effects, profile=8e-6)
    scattered, nominal = parameters(scene, lanes.width), parameters(scene_with(effects), lanes.width)
    assert scene.scatter is not None
    drop = scene.scatter.deviations(scene.bearing).profile[0, 0]
    assert abs(drop) > 1e-6
    table = nominal.laminae.copy()
    table[LAMINA_DROP] += drop * (table[LAMINA_PLACE] / (0.5 * scene.bearing.effective_length)) ** 2
    found = cup_contacts(lanes, scattered, scene)
    np.testing.assert_allclose(
        found, cup_contacts(lanes, nominal._replace(laminae=table), scene), rtol=1e-9, atol=1e-14
    )
    assert np.abs(found[:3, 4] / cup_contacts(lanes, nominal, scene)[:3, 4] - 1.0).max() > 0.01


def test_longer_roller_has_less_room_between_the_ends_of_its_pocket(lanes: Any) -> None:
    scene = made(roller_length=2e-4)
    p, bearing = parameters(scene, lanes.width), scene.bearing
    assert scene.scatter is not None
    longer = scene.scatter.deviations(bearing).roller_length[0, 0]
    cage, roller = p.effects.cage, p.roller
    assert cage is not None
    axis = np.array([math.sin(bearing.contact_angle), 0.0, math.cos(bearing.contact_angle)])
    slides = np.linspace(-4e-4, 4e-4, 33)
    middle = np.array([0.5 * bearing.pitch_diameter, 0.0, cage.roller_place / axis[2]])
    middle[2] = (cage.roller_place - axis[0] * middle[0]) / axis[2]
    cases = np.array([[*(middle + slide * axis), *axis, *[0.0] * 16] for slide in slides])
    rows = np.repeat(cases, lanes.width, axis=0)

    def pushed(worn: Any, cage: Any) -> Float:
        return through(lanes, worn_pockets, rows, 6, 0, worn, roller, cage).reshape(33, lanes.width, 6)[:, 0]

    shorter = cage._replace(half_end_clearance=cage.half_end_clearance - 0.5 * longer)
    found = pushed(p.effects.faults.pockets, cage)
    np.testing.assert_allclose(found, pushed(None, shorter), rtol=1e-9, atol=1e-9)
    assert np.abs(found - pushed(None, cage)).max() > 1.0


def test_pockets_stand_where_they_were_made() -> None:
    scene = made(pocket_place=1e-4)
    assert scene.scatter is not None
    place = scene.scatter.deviations(scene.bearing).pocket_place
    arrangement = Arrangement(Z, 8)
    for p in (
        parameters(scene, 8),
        quasistatic_parameters(scene, parameters(scene, 8)).base,
        lumped_parameters(scene, parameters(scene, 8)).base,
    ):
        angle = arrangement.to_rollers(p.rollers[:, POCKET_ANGLE])
        ahead = (angle - 2.0 * math.pi * np.arange(Z) / Z) * 0.5 * scene.bearing.pitch_diameter
        np.testing.assert_allclose(ahead, place, atol=1e-16)


def test_crown_of_a_roller_without_tilt_is_its_mean_drop() -> None:
    scene = made(profile=8e-6)
    assert scene.scatter is not None
    base = parameters(scene, 8)
    lumped = lumped_parameters(scene, base)
    assert lumped.base.effects.faults.crowns is None
    fine = (np.arange(10_000) + 0.5) / 5_000 - 1.0
    mean = scene.scatter.deviations(scene.bearing).profile * (fine**2).mean()
    found = Arrangement(Z, 8).to_rollers(lumped.base.rollers[:, OVERSIZE])
    np.testing.assert_allclose(found, -mean, rtol=1e-6)
    np.testing.assert_array_equal(base.rollers[:, OVERSIZE], 0.0)  # that of the full tier is left alone


def test_rollers_start_in_their_own_pockets_and_the_cage_where_most_of_them_fit() -> None:
    """0.8 mm of end play, all to one side: the rollers of a row stand 0.4 mm off, 0.25 mm beyond the room.

    The cage comes with them: no other place of it presses the roller that presses most any less.
    """
    scene = replace(
        made(pocket_place=5e-5, pocket_clearance=2e-5, roller_length=5e-5, roller_diameter=3e-6),
        end_play=8e-4,
    )
    assert scene.scatter is not None
    bearing, deviations = scene.bearing, scene.scatter.deviations(scene.bearing)
    rig = Rig.at_equilibrium(scene, (0.0, 1.76e4, 0.0), 0.0)
    fields = rig.fields()
    places = 2.0 * np.pi * np.arange(Z) / Z + deviations.pocket_place / (0.5 * bearing.pitch_diameter)
    np.testing.assert_allclose(fields[ANGLE], places, rtol=0.0, atol=1e-15)

    shift = fields[AXIAL] - 0.5 * bearing.row_spacing - bearing.roller_mass_offset * fields[AXIS + 2]
    room = 0.5 * (bearing.cage.axial_clearance - deviations.roller_length)
    outward = np.array([-1.0, 1.0])
    cage = outward * rig.state.bodies[CAGE_BODY:, POSITION + 1]
    pressed = (np.abs(shift - cage[:, None]) - room).max(axis=1)
    anywhere = np.linspace(-1e-3, 1e-3, 20_001)
    least = (np.abs(shift[:, None] - anywhere[:, None]) - room[:, None]).max(axis=2).min(axis=1)
    assert np.abs(cage).max() > 1e-4
    assert np.all(pressed <= np.maximum(least, 0.0) + 1e-12)
