"""Rolling couple, drag and their matrix against the plain formulas."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.bearing import rolling_resistance as laws
from beardyn_core.bearing.film_thickness import thermal_loading
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.choice.load_cases import circumstances
from beardyn_core.choice.losses import Losses
from beardyn_core.choice.statics import Statics
from beardyn_core.effects import Drag, EffectSet, LineFilm, RollingResistance
from beardyn_core.physics.drag import AIR_DENSITY, CYLINDER_EXPONENT, CYLINDER_FRICTION, drag_params
from beardyn_core.physics.lamina_table import equivalent_radius
from beardyn_core.physics.rolling_resistance import oil_supply, rolling_params
from beardyn_core.scene.scene import Scene
from test.kernels import naive_losses
from test.kernels.casting import through
from test.kernels.loss_entries import couple_matrices, drags, rolling_couples
from test.scenes import scene_with, tapered

Float = NDArray[np.float64]
CASES = np.random.default_rng(7)
LOAD = 10.0 ** CASES.uniform(0.0, 4.5, 200)
SPEED = 10.0 ** CASES.uniform(-2.0, 1.3, 200)


def scene_of(**options: Any) -> Scene:
    return scene_with(replace(EffectSet(), rolling_resistance=RollingResistance(**options)))


def couples(scene: Scene, lanes: Any, ring: int, load: Any, speed: Any) -> Float:
    effects = scene.effects
    supply = oil_supply(effects.film)
    law = rolling_params(
        scene.bearing, effects.rolling_resistance, scene.lubricant, scene.temperature, supply
    )
    cases = np.stack(np.broadcast_arrays(load, speed), axis=-1).astype(float)
    return through(lanes, rolling_couples, cases, 1, ring, law)[:, 0]


def contact(scene: Scene, ring: int, load: float, speed: float) -> laws.RollingContact:
    bearing = scene.bearing
    return laws.RollingContact(
        load,
        speed,
        float(equivalent_radius(bearing, np.zeros(1), ("cup", "cone")[ring])[0]),
        bearing.effective_length,
        bearing.material.contact_modulus,
        scene.lubricant.dynamic_viscosity(scene.temperature),
        scene.lubricant.pressure_viscosity_at(scene.temperature),
    )


def reduction(scene: Scene, speed: float) -> float:
    oil = scene.lubricant
    return laws.thermal_reduction(
        thermal_loading(
            oil.dynamic_viscosity(scene.temperature),
            oil.temperature_coefficient,
            speed,
            oil.thermal_conductivity,
        )
    )


@pytest.mark.parametrize("kind", naive_losses.FORMS)
@pytest.mark.parametrize("ring", [0, 1])
def test_couple_is_that_of_the_plain_formula(lanes: Any, kind: str, ring: int) -> None:
    """Logarithms of 1e-10, times ten in the tenth power of Biboulet and Houpert."""
    scene = scene_of(kind=kind, supply=0.6)
    supply = oil_supply(scene.effects.film)
    exact = [
        0.6
        * naive_losses.rolling_couple(kind, contact(scene, ring, q, u + 1e-3), supply)
        * reduction(scene, u + 1e-3)
        for q, u in zip(LOAD, SPEED, strict=True)
    ]
    np.testing.assert_allclose(couples(scene, lanes, ring, LOAD, SPEED), exact, rtol=1e-8)


def test_isothermal_couple_and_hysteresis_add_up(lanes: Any) -> None:
    scene = scene_of(kind="zhou_hoeprich", thermal=False, hysteresis=0.007)
    exact = []
    for q, u in zip(LOAD, SPEED, strict=True):
        line = contact(scene, 1, q, u + 1e-3)
        width = laws.hertz_half_width(q / line.length, line.radius, line.contact_modulus)
        exact.append(
            naive_losses.rolling_couple("zhou_hoeprich", line, oil_supply(scene.effects.film))
            + laws.hysteresis_line(q, width, 0.007)
        )
    np.testing.assert_allclose(couples(scene, lanes, 1, LOAD, SPEED), exact, rtol=1e-8)


def test_hysteresis_alone_does_not_ask_for_the_speed(lanes: Any) -> None:
    scene = scene_of(kind="hysteresis", hysteresis=0.01)
    slow, fast = (couples(scene, lanes, 0, LOAD, u) for u in (0.01, 10.0))
    np.testing.assert_array_equal(slow, fast)
    assert np.all(slow > 0.0)


@pytest.mark.parametrize("kind", naive_losses.FORMS)
def test_an_unloaded_contact_rolls_freely_and_a_light_one_nearly_so(lanes: Any, kind: str) -> None:
    """With enough oil: a starved light contact has little but its hysteresis."""
    scene = scene_of(kind=kind, hysteresis=0.007)
    plenty = replace(scene.effects, film=LineFilm(supply="flooded"))
    found = couples(scene_with(plenty), lanes, 0, np.array([0.0, 1e-3, 1.0, 10.0]), 5.0)
    assert found[0] == 0.0
    assert found[1] == pytest.approx(1e-3 * found[2], rel=1e-3)
    assert np.all(np.diff(found) > 0.0)


def test_speed_of_either_sign_and_standstill_are_finite(lanes: Any) -> None:
    found = couples(scene_of(), lanes, 1, 1e4, np.array([-5.0, 5.0, 0.0]))
    assert found[0] == found[1]
    assert 0.0 < found[2] < 0.02 * found[1]  # slow contacts find enough oil


@pytest.mark.parametrize("field", [0, 1])
def test_a_nan_is_seen_in_the_couple(lanes: Any, field: int) -> None:
    cases = np.tile([500.0, 5.0], (8, 1))
    cases[5, field] = np.nan
    found = couples(scene_of(), lanes, 0, cases[:, 0], cases[:, 1])
    assert np.isnan(found[5])
    assert np.isfinite(np.delete(found, 5)).all()


def moving(rng: np.random.Generator) -> Float:
    place = np.array([0.0925, 0.0, 0.0375]) + rng.normal(0.0, 1e-4, 3)
    axis = np.array([0.18, 0.0, 0.98]) + rng.normal(0.0, 1e-3, 3)
    axis /= np.linalg.norm(axis)
    velocity = np.array([0.0, 4.8, 0.0]) * rng.choice([-1.0, 1.0]) + rng.normal(0.0, 0.02, 3)
    omega = rng.normal(0.0, 300.0) * axis + rng.normal(0.0, 2.0, 3)
    cup = [*rng.normal(0.0, 1e-5, 3), 0.0, 0.0, 1.0, *rng.normal(0.0, 0.1, 3), *rng.normal(0.0, 1.0, 3)]
    return np.array([*place, *axis, *velocity, *omega, *cup])


def test_drag_and_churning_are_those_of_the_plain_formulas(lanes: Any) -> None:
    """Force against the tangential flow past the centre, couple against the spin; both square-like."""
    effect = Drag(fill=0.1, drag_coefficient=0.9, churning=1.5)
    scene = scene_with(replace(EffectSet(), drag=effect))
    bearing, oil = scene.bearing, scene.lubricant
    density = 0.1 * oil.density + 0.9 * AIR_DENSITY
    radius, length = 0.5 * bearing.roller_diameter, bearing.roller_length
    rng = np.random.default_rng(3)
    cases = np.array([moving(rng) for _ in range(64)])
    found = through(lanes, drags, cases, 6, drag_params(scene))
    for case, wrench in zip(cases, found, strict=True):
        place, axis, velocity, omega, origin, _, cup_velocity, cup_omega = case.reshape(8, 3)
        flow = (velocity - cup_velocity - np.cross(cup_omega, place - origin))[1]
        force = -0.5 * density * 0.9 * length * 2.0 * radius * abs(flow) * flow
        spin = float((omega - cup_omega) @ axis)
        reynolds = abs(spin) * radius**2 / oil.kinematic_viscosity(scene.temperature)
        surface = 2.0 * math.pi * radius * length
        wall = CYLINDER_FRICTION * reynolds**-CYLINDER_EXPONENT
        cylinder = 0.5 * wall * density * (spin * radius) ** 2 * surface * radius
        discs = 0.5 * density * spin**2 * radius**5 * 3.87 / math.sqrt(reynolds)
        couple = -1.5 * math.copysign(cylinder + discs, spin) * axis
        np.testing.assert_allclose(wrench[:3], [0.0, force, 0.0], rtol=1e-9, atol=1e-15)
        np.testing.assert_allclose(wrench[3:], couple, rtol=1e-6, atol=1e-12)


@pytest.mark.parametrize("speed", [3.0, 122.0])
def test_rolling_rollers_lose_to_the_medium_what_the_choice_counts(lanes: Any, speed: float) -> None:
    """A roller in pure rolling turns about the line that touches the cup at rest; one formula, rounding."""
    scene = scene_with(replace(EffectSet(), drag=Drag(churning=1.5)))
    bearing, angle = tapered(scene), scene.bearing.contact_angle
    orbit = cage_speed(bearing, speed)
    axis = np.array([math.sin(angle), 0.0, math.cos(angle)])
    line = np.array([math.sin(bearing.cup_angle), 0.0, math.cos(bearing.cup_angle)])
    apex = np.array([0.0, 0.0, bearing.apex_place])
    place = apex + (bearing.apex_distance + bearing.roller_mass_offset) * axis
    # its mass centre has the speed of its orbit
    about = np.cross(line, place - apex)
    omega = line * (orbit * place[0] / about[1])
    velocity = np.cross(omega, place - apex)
    case = np.array([*place, *axis, *velocity, *omega, *np.zeros(3), 0.0, 0.0, 1.0, *np.zeros(6)])
    wrench = through(lanes, drags, case[None], 6, drag_params(scene))[0]
    power = -float(wrench[:3] @ velocity + wrench[3:] @ omega)
    case_of_load = circumstances(scene).typical
    turning = replace(case_of_load, speed=speed)
    static = Statics(scene).at(case_of_load)
    assert static is not None
    torque = Losses(scene, turning, static).drag
    assert torque * speed == pytest.approx(scene.roller_total * power, rel=1e-9)


@pytest.mark.parametrize("reynolds", [1e3, 3e3, 1e4, 3e4, 1e5])
def test_skin_friction_of_a_cylinder_is_that_of_theodorsen_and_regier(reynolds: float) -> None:
    """NACA Report 793 (1944): 1/sqrt(f) = -0.6 + 4.07 log10(Re sqrt(f)); 10 %."""
    friction = 0.01
    for _ in range(100):
        friction = (-0.6 + 4.07 * math.log10(reynolds * math.sqrt(friction))) ** -2
    assert CYLINDER_FRICTION * reynolds**-CYLINDER_EXPONENT == pytest.approx(friction, rel=0.1)


def test_a_rotary_damper_is_an_outer_product_in_the_rotations(lanes: Any) -> None:
    rng = np.random.default_rng(5)
    cases = np.column_stack([rng.normal(size=(50, 3)), rng.uniform(0.0, 10.0, 50)])
    expected = np.zeros((50, 6, 6))
    expected[:, 3:, 3:] = cases[:, 3, None, None] * cases[:, :3, None] * cases[:, None, :3]
    lower = np.tril_indices(6)
    found = through(lanes, couple_matrices, cases, 21)
    np.testing.assert_allclose(found, expected[:, lower[0], lower[1]], rtol=1e-12, atol=1e-14)
