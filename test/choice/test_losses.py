"""Losses of the choice against plain formulas, one by one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.choice.load_cases import circumstances
from beardyn_core.choice.losses import Losses
from beardyn_core.choice.statics import Statics
from beardyn_core.effects import CoulombTraction, LineFilm, LoadSharingTraction
from beardyn_core.physics.lamina_table import equivalent_radius
from beardyn_core.physics.statics.torque import entrainment_speeds
from test.kernels import naive_traction

SCENE = load_scene("static_80kN", effects="full")
LAWS = [
    LoadSharingTraction(),
    LoadSharingTraction(film_traction="eyring"),
    LoadSharingTraction(film_traction="bair_winer", inlet_shear=False),
    CoulombTraction(0.1, 0.02, regularisation="arctangent"),
]


@pytest.fixture(scope="module")
def losses() -> Losses:
    case = circumstances(SCENE).typical
    static = Statics(SCENE).at(case)
    assert static is not None
    return Losses(SCENE, case, static)


def whole_roller() -> naive_traction.Lamina:
    bearing = SCENE.bearing
    return naive_traction.Lamina(
        bearing.effective_length, float(equivalent_radius(bearing, np.zeros(1), "cone")[0]),
        bearing.material.contact_modulus, bearing.raceway_roughness, SCENE.lubricant, SCENE.temperature,
    )  # fmt: skip


@pytest.mark.parametrize("law", LAWS)
def test_rollers_slip_until_the_traction_of_the_runs_drives_them(
    losses: Losses, law: CoulombTraction | LoadSharingTraction
) -> None:
    """0.3 %: the force is linear between slips that are 4 % apart."""
    film = SCENE.effects.film
    drive = losses.drive(law, film)
    assert 0.0 < drive.slip < 0.1
    speed = entrainment_speeds(SCENE.bearing, losses.speed)[1] + 1e-3
    loads = np.minimum(losses.static.cone_load, losses.static.cup_load)
    force = 0.0
    for load in loads[losses.static.cone_load > 0.0].tolist():
        if isinstance(law, CoulombTraction):
            force += naive_traction.dry_friction(load, drive.slip * speed, law)
        else:
            force += naive_traction.shared_friction(
                load, drive.slip * speed, speed, whole_roller(), law, film
            )
    assert force == pytest.approx(drive.needed, rel=3e-3)


@pytest.mark.parametrize("film", [LineFilm(), LineFilm(isoviscous=True, thermal="none", supply="fresh")])
def test_the_film_of_the_most_loaded_roller_is_that_of_the_formulas(losses: Losses, film: LineFilm) -> None:
    load, speed = float(losses.static.cone_load.max()), entrainment_speeds(SCENE.bearing, losses.speed)[1]
    expected = naive_traction.film(load, speed + 1e-3, whole_roller(), film) / SCENE.bearing.raceway_roughness
    assert losses.film_parameter(film) == pytest.approx(expected, rel=1e-4)


def test_rollers_of_a_shaft_at_rest_need_nothing() -> None:
    case = replace(circumstances(SCENE).typical, speed=0.0)
    static = Statics(SCENE).at(case)
    assert static is not None
    resting = Losses(SCENE, case, static)
    assert resting.total == 0.0
    assert resting.film_parameter(SCENE.effects.film) == 0.0
