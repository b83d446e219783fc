"""Rolling resistance: limits of the laws and soft checks; published numbers are anchors."""

from __future__ import annotations

import math

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.rolling_resistance import (
    RollingContact,
    aihara_line,
    biboulet_houpert_force,
    biboulet_houpert_line,
    hertz_half_width,
    hysteresis_line,
    zhou_hoeprich_line,
)
from beardyn_core.config import load_bearing, load_lubricant
from beardyn_core.effects import Rib, RollingResistance
from beardyn_core.physics.statics.static import solve
from beardyn_core.physics.statics.torque import running_torque
from evidence.validation.losses import RPM, bearing_32216


def line_contact(load: float = 5e3, speed: float = 5.0) -> RollingContact:
    return RollingContact(load, speed, 12e-3, 50e-3, 226e9, 0.02, 15e-9)


def test_biboulet_houpert_meets_martins_solution_for_light_loads() -> None:
    """Reynolds' equation of rigid cylinders, parabolic gap, h = 4.896 eta u R/w: F = 2.080 sqrt(eta u w).

    F is the integral of h p'/2 up to the exit; the published coefficient 1.42 is 3.5 % below.
    """
    edge = 0.47513  # exit abscissa over sqrt(2 R h0), Reynolds' condition
    exit_gap = 1.0 + edge**2
    x = np.tan(np.linspace(-math.pi / 2 + 1e-6, math.atan(edge), 400_001))
    gap = 1.0 + x**2
    slope = (gap - exit_gap) / gap**3  # p' in 12 eta u/h0^2
    pressure = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(x))])
    assert abs(pressure[-1]) < 1e-4
    load = 24.0 * np.trapezoid(pressure, x)  # in eta u R/h0
    force = 6.0 * math.sqrt(2.0) * np.trapezoid(gap * slope, x)  # in eta u sqrt(R/h0)
    coefficient = force / math.sqrt(load)
    assert load == pytest.approx(4.896, rel=1e-3)
    contact = line_contact(load=1e-3, speed=10.0)
    per_length = contact.load / contact.length
    martin = coefficient * math.sqrt(contact.viscosity * contact.entrainment_speed * per_length)
    assert biboulet_houpert_force(contact) / contact.length == pytest.approx(martin, rel=0.04)


def test_biboulet_houpert_forgets_the_load_in_the_elastic_regime() -> None:
    """The elastic limit is 1.42 (1.45/1.4) U^0.75."""
    heavy, heavier = (biboulet_houpert_line(line_contact(load)) for load in (2e4, 4e4))
    assert heavier == pytest.approx(heavy, rel=1e-3)
    contact = line_contact(4e4)
    limit = 1.42 * 1.45 / 1.4 * (2.0 * contact.speed_parameter) ** 0.75
    assert heavier == pytest.approx(
        2.0 * limit * contact.contact_modulus * contact.radius**2 * contact.length, rel=1e-3
    )
    assert biboulet_houpert_line(line_contact(0.0)) == 0.0


def test_the_published_laws_agree_within_a_factor_of_two() -> None:
    """Three independent regressions for one line contact of an axlebox bearing."""
    couples = [law(line_contact()) for law in (aihara_line, zhou_hoeprich_line, biboulet_houpert_line)]
    assert max(couples) < 2.0 * min(couples)


def test_hysteresis_is_johnsons() -> None:
    """10 kN on 50 mm, R = 12 mm: b = 0.165 mm, and 0.7 % of the energy: M = 2 a b Q/(3 pi)."""
    width = hertz_half_width(2e5, 12e-3, 226e9)
    assert width == pytest.approx(math.sqrt(4 * 2e5 * 12e-3 / (math.pi * 113e9)))
    assert hysteresis_line(1e4, width, 0.007) == pytest.approx(2 * 0.007 * width * 1e4 / (3 * math.pi))


def test_palmgrens_rule_is_of_the_same_size() -> None:
    """Palmgren (1959): M0 = 1e-7 f0 (nu n)^(2/3) d^3 with f0 = 6, M1 = 4e-4 P d; a soft check, factor 2.

    80 kN, 2000 rpm, 12.5 mm2/s: 2.99 + 5.76 N m against rolling and ribs here.
    """
    bearing = load_bearing("HS130x230")
    static = solve(bearing, (0.0, 0.0, 80e3), end_play=bearing.end_play, speed=2000 * RPM)
    found = running_torque(
        bearing,
        load_lubricant("L055"),
        373.15,
        static,
        2000 * RPM,
        rib=Rib(friction=0.05, drilling=True),
    )
    oil = load_lubricant("L055").kinematic_viscosity(373.15) * 1e6
    diameter = 0.5 * (130.0 + 230.0)
    speed_part = 1e-10 * 6.0 * (oil * 2000.0) ** (2 / 3) * diameter**3
    load_part = 4e-4 * 80e3 * diameter * 1e-3
    assert (speed_part, load_part) == pytest.approx((2.99, 5.76), rel=0.01)
    assert 0.5 < found.total / (speed_part + load_part) < 2.0
    assert found.rib > 0.0
    assert found.total == found.rolling + found.rib


def test_unknown_law_is_refused() -> None:
    bearing, static = bearing_32216()
    spherical = RollingResistance(kind="kugel")  # type: ignore[arg-type]
    with pytest.raises(InputError, match=r"kind is 'kugel'; allowed are aihara, zhou_hoeprich"):
        running_torque(bearing, load_lubricant("FVA3"), 323.15, static, 50.0, resistance=spherical)
