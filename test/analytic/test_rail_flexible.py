"""Sideways with a wheelset that rolls, bends and twists: a plain integration, the rigid limit, no hunting."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from beardyn_core.config import load_vehicle
from beardyn_core.rail.build import RIDE_RATE, load_history
from beardyn_core.rail.course import course
from beardyn_core.rail.flexible import (
    ROLL,
    FlexibleVehicle,
    flexible_motion,
    flexible_vehicle,
    with_modes,
)
from beardyn_core.rail.lateral import lateral_motion, lateral_vehicle
from beardyn_core.rail.wheelset import HALF_GAUGE, Shaft, bending, half_shaft, torsion
from beardyn_core.scene.mounting import Guidance, Mounting
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation
from beardyn_core.scene.running import Curve

VEHICLES = ("emu_300", "passenger_coach", "freight_y25")
MOUNTING = Mounting()
OPERATION = QuarterVehicleOperation(
    load_vehicle("emu_300"), Irregularity("none"), ((0.0, 25.0),), wheelset="elastic"
)
CURVE = (Curve(250.0, 0.05, 5.0, 60.0, 15.0, "right"),)
RADIUS = 0.46


def half_axle() -> Shaft:
    half = half_shaft(OPERATION, MOUNTING, MOUNTING.box_mass)
    assert half is not None
    return half


def elastic(operation: QuarterVehicleOperation) -> FlexibleVehicle:
    vehicle = flexible_vehicle(operation, MOUNTING)
    assert vehicle is not None
    return vehicle


def few(operation: QuarterVehicleOperation) -> FlexibleVehicle:
    """Two bending modes a plane and one of torsion: slow enough for a plain integration."""
    half = half_axle()
    return with_modes(
        operation, MOUNTING, half, bending(half, 900.0, symmetric=False).first(2), torsion(half).first(1)
    )


def plain_motion(operation, vehicle, speed, plan, times, every):
    """Forces of each wheel and flange one by one, at contacts that go where the wheelset lets them."""
    guidance, share = operation.vehicle.guidance, vehicle.rigid
    half = half_axle()
    bent, twisted = bending(half, 900.0, symmetric=False).first(2), torsion(half).first(1)
    size = len(vehicle.mass)

    def slope(time, state):
        place, rate = state[:size], state[size:]
        curvature, lean = np.interp(time, times, plan.curvature), np.interp(time, times, plan.lean)
        rolling = np.hypot(speed, 0.5)

        def contact(of):
            """Sideways and backwards motion of the left contact."""
            tilt = of[ROLL] + bent.wheel_slope @ of[5:7]
            return of[0] + RADIUS * tilt, HALF_GAUGE * of[1] + bent.wheel @ of[7:9] + RADIUS * twisted.wheel[
                0
            ] * of[9]

        aside, _ = contact(place)
        aside_rate, back_rate = contact(rate)
        on_side, on_back = 0.0, 0.0
        for side in (1.0, -1.0):  # half of the axle: half of each wheel
            grown = RADIUS + side * guidance.conicity * aside
            forwards = speed - side * (back_rate + HALF_GAUGE * speed * curvature)
            along = share.creep * (forwards - speed / RADIUS * grown) / rolling
            across = share.creep * (aside_rate - speed * place[1]) / rolling
            grip = 1 / np.sqrt(1 + (along**2 + across**2) / share.creep_limit**2)
            on_side -= 0.5 * grip * across
            on_back += side * 0.5 * grip * along
        beyond = abs(aside) - share.clearance
        if beyond > 0.0:
            outwards = np.sign(aside)
            spring, damper = share.flange_stiffness * beyond, share.flange_damping * aside_rate * outwards
            on_side -= (spring + damper if spring + damper > 0.0 else spring) * outwards
        force = -vehicle.stiffness @ place - vehicle.damping @ rate
        force[[0, 2, 3]] += share.mass[[0, 2, 3]] * lean
        force[0] += on_side
        force[1] += HALF_GAUGE * on_back
        force[ROLL] += RADIUS * on_side
        force[5:7] += RADIUS * bent.wheel_slope * on_side
        force[7:9] += bent.wheel * on_back
        force[9] += RADIUS * twisted.wheel[0] * on_back
        return np.concatenate([rate, force / vehicle.mass])

    solution = solve_ivp(
        slope,
        (0.0, times[-1]),
        np.zeros(2 * size),
        "LSODA",
        times[::every],
        rtol=1e-6,
        atol=1e-9,
        max_step=2e-3,
    )
    return solution.y.T[:, :size]


def test_a_flexible_sway_is_that_of_a_plain_integration():
    """Through a tight curve, against the flange, and out of it."""
    step = 2.5e-4
    time = np.arange(12_000) * step
    vehicle, speed = few(OPERATION), np.full(len(time), 25.0)
    plan = course(CURVE, np.asarray(25.0 * time, dtype=np.float64), speed)
    swayed = flexible_motion(vehicle, speed, plan, np.zeros(len(time)), step)
    plain = plain_motion(OPERATION, vehicle, 25.0, plan, time, 40)
    assert np.abs(plain[:, 0]).max() > 5e-3
    for axis in range(4):
        assert np.abs(swayed.motion[::40, axis] - plain[:, axis]).max() < 0.02 * np.abs(plain[:, axis]).max()
    tilt = plain @ vehicle.tilt
    assert swayed.flexing is not None
    assert np.abs(tilt).max() > 1e-5
    assert np.abs(swayed.flexing.tilt[::40] - tilt).max() < 0.03 * np.abs(tilt).max()


def test_a_stiff_wheelset_on_a_stiff_track_is_the_rigid_one():
    step = 2.5e-4
    time = np.arange(12_000) * step
    speed = np.full(len(time), 25.0)
    plan = course(CURVE, np.asarray(25.0 * time, dtype=np.float64), speed)
    half = half_axle()
    bent, twisted = bending(half, 900.0, symmetric=False), torsion(half)
    vehicle = with_modes(OPERATION, MOUNTING, half, bent.first(0), twisted.first(0))
    hard = vehicle.stiffness.copy()
    hard[ROLL, ROLL] = 1e14
    swayed = flexible_motion(
        dataclasses.replace(vehicle, stiffness=hard), speed, plan, np.zeros(len(time)), step
    )
    rigid = lateral_motion(lateral_vehicle(OPERATION, MOUNTING), speed, plan, np.zeros(len(time)), step)
    for ours, theirs in (
        (swayed.rail_force, rigid.rail_force),
        (swayed.yaw_moment, rigid.yaw_moment),
        (swayed.motion, rigid.motion),
    ):
        assert np.abs(ours - theirs).max() < 1e-5 * np.abs(theirs).max()


def rates(vehicle: FlexibleVehicle, speed: float) -> np.ndarray:
    """State matrix with linear creep."""
    creep, size = vehicle.rigid.creep, len(vehicle.mass)
    damping = vehicle.damping + creep / speed * (
        np.outer(vehicle.aside, vehicle.aside) + np.outer(vehicle.along, vehicle.along)
    )
    stiffness = vehicle.stiffness + creep * vehicle.rigid.steering * np.outer(vehicle.along, vehicle.aside)
    stiffness[:, 1] -= creep * vehicle.aside
    lower = np.hstack([-stiffness, -damping]) / vehicle.mass[:, None]
    return np.vstack([np.hstack([np.zeros((size, size)), np.eye(size)]), lower])


@pytest.mark.parametrize("conicity", [0.02, 0.1, 0.3])
@pytest.mark.parametrize("name", VEHICLES)
def test_no_hunting_up_to_400_kmh(name, conicity):
    loaded = dataclasses.replace(load_vehicle(name), guidance=Guidance(conicity=conicity))
    vehicle = elastic(dataclasses.replace(OPERATION, vehicle=loaded))
    for speed in np.geomspace(1.0, 400 / 3.6, 12):
        assert np.linalg.eigvals(rates(vehicle, speed)).real.max() < 0.0


def test_a_push_at_the_flange_tilts_the_journal_and_dies_away():
    """Energy of roll, bending and torsion only leaves: damping and creep take it."""
    vehicle = elastic(OPERATION)
    steps = 20_000
    speed = np.full(steps, 55.0)
    plan = course((), np.asarray(55.0 / RIDE_RATE * np.arange(steps), dtype=np.float64), speed)
    kink = np.zeros(steps)
    kink[2000:3000] = 8e-3  # the track jumps aside, onto the flange, for 25 ms
    swayed = flexible_motion(vehicle, speed, plan, kink, 1.0 / RIDE_RATE)
    assert swayed.flexing is not None
    swing = [np.abs(swayed.flexing.tilt[n : n + 2000]).max() for n in range(2000, steps, 2000)]
    assert swing[0] > 1e-4
    assert swing[-1] < 0.02 * swing[0]


def test_the_journal_feels_roll_and_bending():
    """Over a rough alignment the load upwards and along has what a rigid wheelset does not send."""
    rough = dataclasses.replace(
        OPERATION, irregularity=Irregularity("fra_5"), speed_profile=((0.0, 40.0),), lateral=True
    )
    bent, rigid = (
        load_history(dataclasses.replace(rough, wheelset=kind), MOUNTING, 2.0, 3).wrench[400:]
        for kind in ("elastic", "rigid")
    )
    assert np.std(bent[:, 1]) == pytest.approx(np.std(rigid[:, 1]), rel=0.2)
    # slow forces are those of the rigid one
    assert bent[:, 2].mean() == pytest.approx(rigid[:, 2].mean(), rel=1e-3)
    assert np.std(bent[:, 2] - rigid[:, 2]) > 0.01 * np.std(rigid[:, 2])
