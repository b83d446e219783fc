"""Profiles and coupled laminae against what is published of them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.bearing.profile import Profile
from beardyn_core.config import load_bearing
from beardyn_core.effects import LaminaCoupling
from test.analytic.line_load import line_load

HS = load_bearing("HS130x230")


def test_profile_of_iso_16281_at_nine_tenths_of_the_half_length() -> None:
    """ISO/TS 16281: 0.00035 x 26.7 mm x ln(1/(1 - 0.81)) = 15.5 um for the roller of the HS130x230."""
    found = Profile("iso_16281").drop_at(0.9 * 25.0e-3, 25.0e-3, 26.7e-3)
    assert found == pytest.approx(15.5e-6, rel=2e-3)


def test_profile_of_iso_16281_is_that_of_lundberg_for_3_gpa() -> None:
    """0.00035 D = R (p/E*)^2, so p = E* sqrt(0.0007) = 2.995 GPa for steel."""
    modulus = 226.4e9
    pressure = 0.5 * modulus * math.sqrt(0.0007)
    assert pressure == pytest.approx(3.0e9, rel=2e-3)
    x = np.linspace(-24.9e-3, 24.9e-3, 51)
    lundberg = Profile("lundberg", design_pressure=pressure).drop_at(x, 25.0e-3, 26.7e-3, modulus)
    np.testing.assert_allclose(
        Profile("iso_16281").drop_at(x, 25.0e-3, 26.7e-3, modulus), lundberg, rtol=1e-12
    )


@pytest.mark.parametrize("laminae", [20, 40])
def test_lundberg_roller_is_pressed_evenly_at_its_design_load_when_laminae_are_coupled(laminae: int) -> None:
    """Lundberg (1939): the profile makes the pressure uniform at the design load.

    He takes the profile as what the half-space under a uniform load sinks less towards its ends, so a coupled
    line must come out flat; without coupling the same roller is unloaded towards its ends. The load of 1 GPa
    on the roller's radius, 18.5 kN. Even within 2 % up to 0.9 of the half length; the last twentieth, where
    the logarithm is singular, within 15 %.
    """
    pressure = 1.0e9
    load = math.pi * 0.5 * HS.roller_diameter * pressure**2 / (0.5 * HS.material.contact_modulus)
    load *= HS.effective_length
    bearing = replace(HS, profile=Profile("lundberg", design_load=load))
    coupled = line_load(bearing, load, laminae=laminae, coupling=LaminaCoupling(pressure=pressure))
    mean = load / HS.effective_length
    inner = np.abs(coupled.place) < 0.45 * HS.effective_length
    np.testing.assert_allclose(coupled.load_per_length[inner] / mean, 1.0, atol=0.02)
    np.testing.assert_allclose(coupled.load_per_length / mean, 1.0, atol=0.15)
    alone = line_load(bearing, load, laminae=laminae)
    assert alone.load_per_length[-1] < 0.85 * mean
    straight = line_load(HS, load, laminae=laminae, coupling=LaminaCoupling(pressure=pressure))
    assert straight.load_per_length[-1] > 1.3 * straight.load_per_length[laminae // 2]
