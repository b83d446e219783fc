"""Air drag of the cages: published coefficients, the kernel, its power in the loss report, its absence."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.choice import scene_from_text
from beardyn_core.choice.choose import choose
from beardyn_core.choice.load_cases import circumstances
from beardyn_core.choice.steady_heat import torque_by_source
from beardyn_core.effects import EffectSet, Windage
from beardyn_core.effects.windage import (
    DISC_TRANSITION,
    Annulus,
    WindageParams,
    air_density,
    air_torques,
    air_viscosity,
    annulus,
    annulus_torque,
    disc,
)
from beardyn_core.physics.bodies.layout import (
    ANGULAR,
    BODY_STATES,
    CAGE_BODY,
    CONE_BODY,
    CUP_BODY,
    ENERGY_LOST,
    RATE,
    TILT,
)
from beardyn_core.physics.bodies.losses import ENERGY_TERMS, LOSS_NAMES
from beardyn_core.physics.cage.drag import brake_cages, cage_drag_params, cage_drag_torque
from beardyn_core.physics.tiers.status import is_fatal
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import missing_effects
from beardyn_core.sensors.block import Block
from test.kernels.rig import Float
from test.runs import constant_load, started
from test.scenes import standard_scene

RADIUS, LENGTH, GAP = 0.1, 0.05, 0.005
DENSITY, VISCOSITY = 1.2, 1.5e-5
LOSS = ENERGY_LOST + LOSS_NAMES.index("windage")


def scene(effects: EffectSet | None = None) -> Scene:
    given = standard_scene()
    return replace(given, effects=replace(effects or given.effects, windage=Windage()))


def coefficient(reynolds: float) -> float:
    """Of the annulus: torque over pi rho w^2 r^4 L / 2."""
    speed = reynolds * VISCOSITY / (RADIUS * GAP)
    torque = annulus_torque(speed, annulus(RADIUS, GAP, LENGTH, DENSITY, VISCOSITY))
    return torque / (0.5 * math.pi * DENSITY * speed**2 * RADIUS**4 * LENGTH)


@pytest.mark.parametrize(
    ("reynolds", "over_gap"),
    [(10.0, 1.0), (200.0, 2.0 / 200.0**0.6), (3000.0, 1.03 / 3000.0**0.5), (1e5, 6.5e-3)],
)
def test_annulus_has_the_published_coefficients_within_a_kind_of_flow(
    reynolds: float, over_gap: float
) -> None:
    """Bilgen and Boulos (1973); kinds that are nearly alike add 1 % in the blend."""
    assert coefficient(reynolds) == pytest.approx(over_gap * (GAP / RADIUS) ** 0.3, rel=0.012)


@pytest.mark.parametrize("reynolds", [56.0, 762.0, 9990.0])
def test_kinds_of_flow_join_smoothly(reynolds: float) -> None:
    below, here, above = (math.log(coefficient(reynolds * change)) for change in (0.99, 1.0, 1.01))
    assert abs(above - 2.0 * here + below) < 1e-3


def test_slow_annulus_is_that_of_couette() -> None:
    """4 pi mu w L r1^2 r2^2 / (r2^2 - r1^2); the published fit is 4 % less at this gap."""
    outer = RADIUS + GAP
    exact = 4.0 * math.pi * VISCOSITY * DENSITY * LENGTH * (RADIUS * outer) ** 2 / (outer**2 - RADIUS**2)
    air = annulus(RADIUS, GAP, LENGTH, DENSITY, VISCOSITY)
    assert annulus_torque(0.01, air) / 0.01 == pytest.approx(exact, rel=0.06)


def test_disc_is_that_of_von_karman() -> None:
    """0.616 pi rho r^4 sqrt(nu w^3) on both sides, laminar; 0.073 rho w^2 r^5 Re^-1/5 turbulent."""
    speed = 100.0
    laminar = 0.616 * math.pi * DENSITY * RADIUS**4 * math.sqrt(VISCOSITY * speed**3)
    turbulent = 0.073 * DENSITY * speed**2 * RADIUS**5 * (speed * RADIUS**2 / VISCOSITY) ** -0.2
    assert disc(0, DENSITY, VISCOSITY, RADIUS) * speed**1.5 == pytest.approx(laminar, rel=1e-3)
    assert disc(1, DENSITY, VISCOSITY, RADIUS) * speed**1.8 == pytest.approx(turbulent, rel=1e-3)


@pytest.mark.parametrize(("over_transition", "kind"), [(0.2, 0), (5.0, 1)])
def test_end_faces_change_over_at_the_published_reynolds_number(over_transition: float, kind: int) -> None:
    air = Windage().parameters(standard_scene().bearing, 293.15)
    outer = 0.5 * standard_scene().bearing.pitch_diameter + 0.1 * standard_scene().bearing.roller_diameter
    speed = over_transition * air.transition
    reynolds = speed * outer**2 * air_density(293.15) / air_viscosity(293.15)
    assert reynolds == pytest.approx(over_transition * DISC_TRANSITION)
    of_faces = air_torques(speed, 0.0, air)[0] - annulus_torque(speed, air.outside)
    expected = (air.faces_laminar * speed**1.5, air.faces_turbulent * speed**1.8)[kind]
    assert of_faces == pytest.approx(expected, rel=3e-3)


def test_air_is_that_of_the_tables() -> None:
    """At 20 degrees 1.204 kg/m^3 and 18.1 uPa s, at 100 degrees 21.7 uPa s (ICAO standard atmosphere)."""
    assert air_density(293.15) == pytest.approx(1.204, rel=1e-3)
    assert air_viscosity(293.15) == pytest.approx(18.1e-6, rel=5e-3)
    assert air_viscosity(373.15) == pytest.approx(21.7e-6, rel=1e-2)


def naive(speed: float, side: float, air: WindageParams) -> tuple[float, float]:
    """Torques of one cage, kind of flow after kind of flow, as one would write them down."""

    def between(rate: float, gap: Annulus) -> float:
        kinds = [factor * abs(rate) ** power for factor, power in zip(gap, (1.0, 1.4, 1.5, 1.8), strict=True)]
        return math.copysign(sum(kind**16 for kind in kinds) ** (1.0 / 16.0), rate)

    turbulent = 1.0 / (1.0 + (air.transition / abs(speed)) ** 4)
    faces = (1.0 - turbulent) * air.faces_laminar * abs(speed) ** 1.5
    faces += turbulent * air.faces_turbulent * abs(speed) ** 1.8
    return between(speed, air.outside) + math.copysign(faces, speed), between(side, air.inside)


def turning(cone: float, cages: tuple[float, float]) -> Float:
    bodies = np.zeros((4, BODY_STATES))
    bodies[CONE_BODY, RATE] = cone
    bodies[CAGE_BODY:, RATE] = cages
    bodies[CUP_BODY, ANGULAR : ANGULAR + 3] = (0.3, 0.1, -0.2)
    bodies[CAGE_BODY:, TILT] = 1e-3, -2e-3
    return bodies


@pytest.mark.parametrize(
    ("cone", "cages"), [(300.0, (130.0, 125.0)), (-20.0, (-8.0, 3.0)), (0.0, (0.0, 0.0))]
)
def test_kernel_is_the_plain_law_and_keeps_momentum_and_energy(
    cone: float, cages: tuple[float, float]
) -> None:
    """Whatever turns how: couples in pairs, and what is lost is torque times speed."""
    parameters = cage_drag_params(scene())
    assert parameters is not None
    bodies, wrenches, energy = turning(cone, cages), np.zeros((4, 6)), np.zeros(ENERGY_TERMS)
    brake_cages(bodies, wrenches, energy, 1e-6, parameters)
    np.testing.assert_allclose(wrenches.sum(axis=0), 0.0, atol=1e-18)
    assert not wrenches[:, :3].any()
    axes = np.array([[-0.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1e-3], [0.0, 1.0, -2e-3]])
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    omega = bodies[:, ANGULAR : ANGULAR + 3] + bodies[:, RATE, None] * axes
    power = -float((wrenches[:, 3:] * omega).sum())
    assert energy[LOSS] == pytest.approx(1e-6 * power, rel=1e-9, abs=1e-24)
    assert energy[LOSS] >= 0.0
    for cage in (CAGE_BODY, CAGE_BODY + 1):
        cup, cone_side = (float((omega[cage] - omega[ring]) @ axes[cage]) for ring in (CUP_BODY, CONE_BODY))
        law = naive if cup and cone_side else air_torques
        expected = sum(law(cup, cone_side, parameters[0]))
        assert -float(wrenches[cage, 3:] @ axes[cage]) == pytest.approx(expected, rel=1e-6, abs=1e-15)


def test_it_is_small_and_grows_with_density_and_factor() -> None:
    """Half a watt of the whole bearing at 300 rad/s, below a thousandth of what the rest loses."""
    given = scene()
    torque = cage_drag_torque(given, 300.0)["windage"]
    assert 0.4 < 300.0 * torque < 0.55
    case = replace(circumstances(given).typical, speed=300.0)
    others = sum(torque_by_source(given, case).values()) - torque
    assert torque < 1e-3 * others
    assert torque_by_source(given, case)["windage"] == torque
    thick = replace(given, effects=replace(given.effects, windage=Windage(density=10.0, factor=2.0)))
    assert cage_drag_torque(thick, 300.0)["windage"] > 4.0 * torque
    assert cage_drag_torque(given, -300.0)["windage"] == pytest.approx(-torque)


def test_absence_leaves_no_parameters() -> None:
    assert cage_drag_params(standard_scene()) is None
    assert cage_drag_torque(standard_scene(), 300.0) == {}


def test_fast_tiers_name_it_among_what_they_miss() -> None:
    assert (
        missing_effects("quasistatic", ("windage",))
        == missing_effects("lumped", ("windage",))
        == ("windage",)
    )
    assert missing_effects("full", ("windage",)) == ()


def test_without_a_cage_it_is_refused_with_a_sentence() -> None:
    words = "scene: x\nbearing: HS130x230\nlubricant: L055\n"
    words += "effects: {preset: standard, cage: false, windage: true}\n"
    words += "operation: {kind: constant, force_kN: [0, 0, 80], speed_rpm: 1165}\n"
    with pytest.raises(
        InputError, match="windage needs cage, which is absent; switch cage on, or windage off"
    ):
        scene_from_text(words, "x")


def test_what_leaves_no_drag_or_no_gap_is_refused() -> None:
    words = (
        "scene: x\nbearing: HS130x230\nlubricant: L055\neffects: {preset: standard, windage: {factor: 0}}\n"
    )
    words += "operation: {kind: constant, force_kN: [0, 0, 80], speed_rpm: 1165}\n"
    with pytest.raises(InputError, match="factor is 0; it must be greater than 0"):
        scene_from_text(words, "x")
    with pytest.raises(InputError, match="thickness_mm is 100; it must be at most 24"):
        Windage(thickness=0.1).parameters(scene().bearing, 343.0)


def test_automatic_choice_leaves_it_out_for_its_share_of_the_torque() -> None:
    given = replace(scene(), accuracy=0.05, quantities=("torque",))
    choice = choose(given)
    assert choice.effects.windage is None
    (decision,) = (each for each in choice.decisions if each.effect == "windage")
    assert 0.0 < decision.influence["torque"] < 1e-3
    assert "N m of a torque of about" in decision.sentence()


@cache
def blocks() -> tuple[Block, ...]:
    twin = started(scene(), constant_load((0.0, 0.0, 8e4), 122.0))
    return tuple(twin.advance() for _ in range(4))


@pytest.mark.slow  # compiles a kernel of its own
def test_energy_balance_closes_and_its_power_is_torque_times_speed() -> None:
    """Between the starts of two blocks, while the cages turn as in pure rolling to a few percent."""
    first, last = blocks()[1], blocks()[-1]
    assert not is_fatal(last.status)
    assert first.audit is not None
    assert last.audit is not None
    assert last.audit.residual < 0.01
    place = LOSS_NAMES.index("windage")
    spent = last.audit.losses[place] - first.audit.losses[place]
    power = spent / (1e-9 * (last.start_ns - first.start_ns))
    assert power == pytest.approx(122.0 * cage_drag_torque(scene(), 122.0)["windage"], rel=0.05)
