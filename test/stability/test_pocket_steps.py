"""Rollers that press the bars of their pockets do not swing with the cage from step to step."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.choice import load_scene
from beardyn_core.config import load_bearing
from beardyn_core.effects import Cage, PocketFilm
from beardyn_core.physics.cage.parameters import CageParams, cage_params


@pytest.mark.parametrize("lean", [0.0, 0.44, 1.2])
@pytest.mark.parametrize("steps", [2, 3, 8])
@pytest.mark.parametrize("temperature", [293.15, 343.15, 373.15])
@pytest.mark.parametrize("bearing", ["HS130x230", "FR130x230x150", "AARK_6.5x9", "METRO120x220"])
def test_all_rollers_on_one_bar_do_not_swing_from_step_to_step(
    bearing: str, temperature: float, steps: int, lean: float
) -> None:
    """The explicit step of rollers on film, damper and spring at both ends of a bar, and of their cage."""
    scene = replace(load_scene("static_5kN"), bearing=load_bearing(bearing), temperature=temperature)
    lubricated = Cage(lubrication=PocketFilm(), bar_inclination=lean)
    scene = replace(scene, effects=replace(scene.effects, cage=lubricated))
    step = 1.0 / (25600.0 * steps)
    cage = cage_params(scene, step)
    assert cage is not None
    assert cage.film is not None
    film, parts = cage.film, scene.bearing
    assert film.thinnest < 1.0 / film.inverse_layer, "there is no film"
    physical = film.squeeze * (0.5 * parts.roller_diameter / film.thinnest) ** 1.5
    resistance = cage.damping + physical / (1.0 + film.share * physical)
    yields = 2.0 * _yielding(parts, math.cos(lean), cage)
    still, there = np.zeros_like(yields), np.eye(len(yields))
    drift = np.block([[there, step * there], [still, there]])
    kick = np.block([[there, still], [-step * cage.stiffness * yields, there - step * resistance * yields]])
    assert np.abs(np.linalg.eigvals(kick @ drift)).max() < 1.0 + 1e-6  # moving together is 1, twice
    fastest = np.linalg.eigvals(yields).real.max()
    skew = 2.0 * cage.bar_place**2 / parts.roller_transverse_inertia
    for each in (fastest, skew):
        assert step * (resistance + 0.5 * step * cage.stiffness) * each < 2.0 * 0.91


def test_at_one_step_a_sample_the_film_has_an_eighth_of_what_is_stable() -> None:
    """The dry wall alone is beyond it there."""
    scene = load_scene("static_5kN")
    scene = replace(scene, effects=replace(scene.effects, cage=Cage(lubrication=PocketFilm())))
    step, longer = 1.0 / 25600.0, 2.0 / 25600.0
    shares = []
    for each in (step, longer):
        cage = cage_params(scene, each)
        assert cage is not None
        assert cage.film is not None
        shares.append(cage.film.share)
    yields = 2.0 * _yielding(scene.bearing, math.cos(0.44), cage_params(scene, step))
    assert 0.9 < 0.25 * shares[0] / (step * np.linalg.eigvals(yields).real.max()) < 1.2
    assert shares[1] == pytest.approx(2.0 * shares[0], rel=1e-12)


def _yielding(bearing: RollerBearing, cosine: float, cage: CageParams | None) -> Float:
    """Accelerations of rollers along the pitch circle and of the cage by forces on the bars, [1/kg]."""
    assert cage is not None
    count, radius = bearing.roller_count, 0.5 * bearing.pitch_diameter
    azimuth = 2.0 * np.pi * np.arange(count) / count
    sine = math.sqrt(1.0 - cosine**2)
    normal = np.zeros((count, count + 3))  # how the approach of a roller to its bar changes with each speed
    normal[:, :count] = cosine * np.eye(count)
    normal[:, count] = -(cosine * np.cos(azimuth) + sine * np.sin(azimuth))
    normal[:, count + 1] = -(-cosine * np.sin(azimuth) + sine * np.cos(azimuth))
    normal[:, count + 2] = -cosine * radius
    inertia = np.array([*count * [bearing.roller_mass], cage.mass, cage.mass, cage.polar_inertia])
    return np.asarray(normal.T @ normal / inertia[:, None])
