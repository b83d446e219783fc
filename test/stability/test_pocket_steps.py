"""Rollers that press the bars of their pockets do not swing with the cage from step to step."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.config import load_bearing
from beardyn_core.effects import Cage, PocketFilm
from beardyn_core.model.cage import cage_params


@pytest.mark.parametrize("lean", [0.0, 0.44])
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
    film, parts, count = cage.film, scene.bearing, scene.bearing.roller_count
    assert film.thinnest < 1.0 / film.inverse_layer, "there is no film"
    physical = film.squeeze * (0.5 * parts.roller_diameter / film.thinnest) ** 1.5
    resistance = cage.damping + physical / (1.0 + film.share * physical)
    least = min(cage.mass, cage.polar_inertia / (0.5 * parts.pitch_diameter) ** 2)
    along = 2.0 * math.cos(lean) ** 2 * np.array([[1.0, -1.0], [-count, count]])
    yields = along / [[parts.roller_mass], [least]]  # of all rollers alike, and of the cage, to both ends
    skew = np.array([[2.0 * math.cos(lean) ** 2 * cage.bar_place**2 / parts.roller_transverse_inertia]])
    for each in (yields, skew):
        still, there = np.zeros_like(each), np.eye(len(each))
        drift = np.block([[there, step * there], [still, there]])
        kick = np.block([[there, still], [-step * cage.stiffness * each, there - step * resistance * each]])
        assert np.abs(np.linalg.eigvals(kick @ drift)).max() < 1.0 + 1e-6  # moving together is 1, twice
