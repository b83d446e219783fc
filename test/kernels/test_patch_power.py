"""Work and power of a contact over patches: what the gap's slope turns, stores, damps and rubs away."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from beardyn_core.effects import EffectSet, LaminaCoupling
from beardyn_core.scene.patch import Patch
from beardyn_core.scene.waviness import Waviness
from test.kernels.casting import Float, through
from test.kernels.fault_entries import damaged_contacts, powers
from test.kernels.rig import parameters_of
from test.scenes import scene_with


@pytest.mark.parametrize("kind", ["dent", "spall"])
@pytest.mark.parametrize(
    ("effects", "tolerance"),
    [(EffectSet(), 1e-3), (replace(EffectSet(), lamina_coupling=LaminaCoupling()), 2e-2)],
    ids=["independent", "coupled"],
)
def test_work_of_the_leaning_normal_is_what_the_elastic_energy_loses(
    lanes: Any, effects: EffectSet, tolerance: float, kind: str
) -> None:
    """Over azimuth and spin, with patches and waves on both surfaces; central differences of the energy.

    At a fixed place of the roller the energy changes by the gap alone, so energy / azimuth = - torque. With
    coupled laminae the passes of `couple_laminae` leave more.
    """
    scene = scene_with(
        effects,
        defects=(
            Patch("cup", 0, 0.3, 6e-3, 3e-5, 0.03, 3e-3, kind=kind),
            Patch("roller", 0, 0.2, 5e-3, 2e-5, 0.03, 3e-3, kind=kind),
        ),
        waviness=(Waviness("cup", 0, (17,), (1e-6,)), Waviness("roller", 0, (6,), (1e-6,))),
    )
    p = parameters_of(scene, lanes.width)
    bearing = scene.bearing
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    middle = np.array([0.5 * bearing.pitch_diameter, 0.0, 0.5 * bearing.row_spacing])
    axis = np.array([sine, 0.0, cosine])
    place = middle + bearing.roller_mass_offset * axis + 3e-5 * np.array([cosine, 0.0, -sine])
    corners = [(a, b) for a in np.linspace(0.2731, 0.3267, 7) for b in np.linspace(0.012, 0.39, 7)]

    def at(azimuths: Any) -> Float:
        cases = np.array([[a, b, *place, *axis] for a, b in azimuths])
        return through(lanes, damaged_contacts, np.repeat(cases, lanes.width, axis=0), 7, p)[:: lanes.width]

    step = 1e-8
    found = at(corners)
    by_ring = (at([(a + step, b) for a, b in corners]) - at([(a - step, b) for a, b in corners]))[:, 0]
    by_roller = (at([(a, b + step) for a, b in corners]) - at([(a, b - step) for a, b in corners]))[:, 0]
    spin_moment = found[:, 4:7] @ axis  # the contact's azimuth in the roller falls with the spin
    orbit_torque = place[0] * found[:, 2] + found[:, 6]
    scale = np.abs(by_ring).max() / (2.0 * step)
    assert scale > 10.0
    np.testing.assert_allclose(spin_moment, by_roller / (2.0 * step), atol=tolerance * scale)
    np.testing.assert_allclose(orbit_torque, -by_ring / (2.0 * step), atol=tolerance * scale)


def crossing(lanes: Any, rate: float, orbit: float, kind: str = "dent") -> Float:
    """Roll over the edges of a patch on the cup and of one on the roller: outputs of `powers`, and dE/dt.

    ``rate``: of approach [m/s]; ``orbit``: [rad/s]. The roller turns backwards as if it rolled on the cup.
    """
    patches = (
        Patch("cup", 0, 0.3, 6e-3, 1e-5, 0.03, 3e-3, kind=kind),
        Patch("roller", 0, 0.2, 5e-3, 8e-6, 0.03, 3e-3, kind=kind),
    )
    # a dent slopes all over, a spall at its edges
    on_cup, on_roller = np.linspace(0.28, 0.32, 20), 0.19
    if kind == "spall":
        on_cup, on_roller = np.linspace(0.316, 0.327, 20), 0.38
    scene = scene_with(EffectSet(), defects=patches)
    # an instant: no contact begins or ends within it
    p = parameters_of(scene, lanes.width)._replace(step=1e-15)
    bearing = scene.bearing
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    axis = np.array([sine, 0.0, cosine])
    outer = bearing.contact_angle + bearing.half_angle
    normal = np.array([math.cos(outer), 0.0, -math.sin(outer)])
    middle = np.array([0.5 * bearing.pitch_diameter, 0.0, 0.5 * bearing.row_spacing])
    place = middle + bearing.roller_mass_offset * axis + 3e-5 * normal
    spin = -8.0 * orbit
    turning = spin - orbit * axis[2]  # of the roller against its orbit frame

    def at(time: float) -> Float:
        here = place + time * rate * normal
        velocity = rate * normal + np.array([0.0, orbit * place[0], 0.0])
        cases = np.array(
            [[a + orbit * time, on_roller - turning * time, *here, *axis, *velocity, orbit, spin]
             for a in on_cup]
        )  # fmt: skip
        return through(lanes, powers, np.repeat(cases, lanes.width, axis=0), 4, p)[:: lanes.width]

    change = (at(1e-9) - at(-1e-9))[:, 0] / 2e-9
    return np.column_stack([at(0.0), change])


@pytest.mark.parametrize("kind", ["dent", "spall"])
@pytest.mark.parametrize("rate", [-0.02, 0.0, 0.1])
def test_power_of_a_contact_over_a_patch_is_stored_damped_or_rubbed_away(
    lanes: Any, rate: float, kind: str
) -> None:
    """The gap moves under the roller: 5 m/s along slopes of 1 in 100 are as much as the rate of approach."""
    energy, work, damped, slid, change = crossing(lanes, rate, 52.0, kind).T
    assert energy.min() > 1e-3
    assert damped.min() >= 0.0
    still = crossing(lanes, rate, 0.0, kind)[:, 2]
    assert np.abs(damped - still).max() > 0.2 * np.abs(damped).max()
    np.testing.assert_allclose(work, -(change + damped + slid), atol=1e-5 * np.abs(work).max())
