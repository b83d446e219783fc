"""The rail model at its limits: 400 km/h with loss of contact, half of the step, standstill, hard strikes."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

from beardyn_core.config import load_vehicle
from beardyn_core.rail.build import RIDE_RATE, load_history
from beardyn_core.rail.excitation import rail_height, wheel_height
from beardyn_core.rail.lateral import lateral_vehicle
from beardyn_core.rail.vehicle import GRAVITY, quarter_vehicle, ride
from beardyn_core.scene.excitation import Corrugation, DippedJoint, WheelFlat, WheelPolygon
from beardyn_core.scene.mounting import Guidance, Mounting
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation, Track, Vehicle
from beardyn_core.scene.running import Curve
from test.analytic.rail_rides import ride_of
from test.examples import fast_ones

VEHICLE = Vehicle("emu", "ICE3-like", 47.8e3, 3.5e3, 350e3, 20e3)
SMOOTH = QuarterVehicleOperation(VEHICLE, Irregularity("none"), ((0.0, 120 / 3.6),))
STRIKES: dict[str, dict[str, Any]] = {
    "flat": {"wheel_defects": (WheelFlat(0.06),)},
    "joint": {"rail_defects": (DippedJoint(8.0, 20e-3, 0.3, 10.0),)},
    "polygon": {"wheel_defects": (WheelPolygon(20, 100e-6),)},
    "corrugation": {"rail_defects": (Corrugation(0.08, 60e-6),)},
}


def height_of(operation, rate, seconds):
    position = operation.speed_profile[0][1] * np.arange(round(seconds * rate)) / rate
    height = wheel_height(operation.wheel_defects, 0.5 * operation.wheel_diameter, position)
    return height + rail_height(operation.rail_defects, position)


@pytest.mark.parametrize("strike", STRIKES)
@pytest.mark.parametrize("speed_kmh", [50.0, 200.0, 400.0])
def test_half_of_the_step_changes_a_strike_by_less_than_3_percent(strike, speed_kmh):
    operation = dataclasses.replace(SMOOTH, speed_profile=((0.0, speed_kmh / 3.6),), **STRIKES[strike])
    vehicle = quarter_vehicle(operation, Mounting())
    seconds = 1.0
    whole = ride(vehicle, height_of(operation, RIDE_RATE, seconds), 1 / RIDE_RATE)
    half = ride(vehicle, height_of(operation, 2 * RIDE_RATE, seconds), 0.5 / RIDE_RATE)
    assert whole.contact_force.max() == pytest.approx(half.contact_force.max(), rel=0.03)
    assert np.isfinite(whole.wheel).all()
    assert whole.contact_force.max() < 2e6


@pytest.mark.parametrize("speed_kmh", fast_ones([0.0, 0.5, 20.0, 400.0, -400.0], 1, 3))
@pytest.mark.parametrize("vehicle", ["emu_300", "passenger_coach", "freight_y25"])
def test_every_vehicle_is_bounded_at_every_speed_with_all_that_shakes_it(vehicle, speed_kmh):
    operation = QuarterVehicleOperation(
        load_vehicle(vehicle),
        Irregularity("fra_6"),
        ((0.0, speed_kmh / 3.6),),
        wheel_defects=(WheelFlat(0.06), WheelPolygon(20, 50e-6)),
        rail_defects=(DippedJoint(5.0, 15e-3, 1.0, 18.0), Corrugation(0.05, 30e-6)),
        curves=(Curve(300.0, 0.15, 20.0, 200.0, 40.0),) if speed_kmh < 100 else (),
        lateral=True,
    )
    history = load_history(operation, Mounting(), 4.0, seed=3)
    first, last = history.wrench[10_000:20_000], history.wrench[30_000:]
    assert np.isfinite(history.wrench).all()
    assert (last.std(axis=0) < 3.0 * first.std(axis=0) + 500.0).all()
    assert np.abs(history.wrench[:, :3]).max() < 1.5e6
    assert np.abs(history.bogie).max() < 0.2


@pytest.mark.parametrize("conicity", [0.02, 0.1, 0.3])
@pytest.mark.parametrize("vehicle", ["emu_300", "passenger_coach", "freight_y25"])
def test_no_hunting_up_to_400_kmh(vehicle, conicity):
    """All lateral eigenvalues decay: the stiff longitudinal guidance holds the wheelset."""
    loaded = dataclasses.replace(load_vehicle(vehicle), guidance=Guidance(conicity=conicity))
    share = lateral_vehicle(dataclasses.replace(SMOOTH, vehicle=loaded), Mounting())
    for speed in np.geomspace(1.0, 400 / 3.6, 12):
        stiffness, damping = share.stiffness.copy(), share.damping.copy()
        damping[0, 0] += share.creep / speed
        damping[1, 1] += share.creep * 0.75**2 / speed
        stiffness[0, 1] -= share.creep
        stiffness[1, 0] += share.creep * 0.75 * share.steering
        lower = np.hstack([-stiffness, -damping]) / share.mass[:, None]
        rates = np.vstack([np.hstack([np.zeros((4, 4)), np.eye(4)]), lower])
        assert np.linalg.eigvals(rates).real.max() < 0.0


@pytest.mark.parametrize("pads", [20e6, 1000e6])
def test_soft_and_hard_tracks_are_bounded(pads):
    track = dataclasses.replace(Track(), pad_stiffness=pads, pad_damping=10e3)
    operation = dataclasses.replace(
        SMOOTH, track=track, speed_profile=((0.0, 400 / 3.6),), wheel_defects=(WheelFlat(0.06),)
    )
    response, _ = ride_of(operation, Mounting(), 2.0, seed=1)
    assert response.contact_force.min() == 0.0
    assert response.contact_force.max() < 8e5
    assert response.contact_force.mean() == pytest.approx(
        quarter_vehicle(operation, Mounting()).static_force, rel=0.05
    )


@pytest.mark.parametrize(
    ("strike", "speed_kmh", "least", "most"),
    [
        ({"wheel_defects": (WheelFlat(0.035),)}, 120.0, 25.0, 60.0),
        ({"wheel_defects": (WheelFlat(0.1),)}, 120.0, 50.0, 200.0),
        ({"wheel_defects": (WheelFlat(0.1),)}, 200.0, 50.0, 200.0),
        ({"rail_defects": (DippedJoint(12.0, 30e-3, 1.0, 15.0),)}, 200.0, 30.0, 100.0),
    ],
    ids=["small flat", "large flat", "large flat, fast", "bad joint"],
)
def test_strikes_open_the_contact_and_shake_the_axlebox(strike, speed_kmh, least, most):
    """Field figures for axleboxes over flats and joints: 50 to 200 g, with the modes of a wheelset in them.

    Here the half wheelset is rigid: a flat of 35 mm gives 32 g, one of 100 mm 66 g.
    """
    operation = dataclasses.replace(SMOOTH, speed_profile=((0.0, speed_kmh / 3.6),), **strike)
    response, step = ride_of(operation, Mounting(), 2.0, seed=1)
    assert response.contact_force.min() == 0.0
    shaking = np.abs(np.diff(response.box, 2)).max() / step**2 / GRAVITY
    assert least < shaking < most
