"""The compiled runs against plain ones that integrate the same equations with a library's solver."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from beardyn_core.config import load_vehicle
from beardyn_core.rail.course import course
from beardyn_core.rail.lateral import lateral_motion, lateral_vehicle
from beardyn_core.rail.vehicle import (
    BODY,
    BOGIE,
    BOX,
    GRAVITY,
    WHEEL,
    equivalent_displacement,
    quarter_vehicle,
    ride,
)
from beardyn_core.rail.wheelset import HALF_GAUGE
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation, Vehicle
from beardyn_core.scene.running import Curve

VEHICLE = Vehicle("emu", "ICE3-like", 47.8e3, 3.5e3, 350e3, 20e3)
SMOOTH = QuarterVehicleOperation(VEHICLE, Irregularity("none"), ((0.0, 120 / 3.6),))
FREIGHT = dataclasses.replace(SMOOTH, vehicle=load_vehicle("freight_y25"), wheelset="rigid")
STEP = 2.5e-5


class NaiveRide:
    """Every coordinate by name, every force by its law."""

    def __init__(self, operation, mounting):
        self.vehicle = quarter_vehicle(operation, mounting)
        self.rail = self.vehicle.rail
        self.rates = self.rail.rates()
        self.suspension = operation.vehicle.primary_suspension
        self.mounting = mounting
        self.count = len(self.rail.share)

    def split(self, state):
        cars, waves = state[:8], state[8:-1].reshape(self.count, 6)
        return cars[:4], cars[4:], waves, state[-1]

    def contact(self, state, height):
        place, _, waves, shortest = self.split(state)
        flexibility = self.vehicle.contact_flexibility
        compression = flexibility * self.vehicle.static_force ** (2 / 3)
        compression += height + waves[:, 0].sum() + shortest - place[WHEEL]
        return (max(compression, 0.0) / flexibility) ** 1.5

    def springs(self, squeeze):
        """Load of the progressive springs, compressed by so much beyond their rest."""
        at_rest = self.suspension.compression(self.vehicle.mass[[BODY, BOGIE]].sum() * GRAVITY)
        compression = max(at_rest + squeeze, 0.0)
        meeting = self.suspension.meeting_load / self.suspension.soft_stiffness
        if compression < meeting:
            return self.suspension.soft_stiffness * compression
        return self.suspension.meeting_load + self.suspension.stiff_stiffness * (compression - meeting)

    def primary(self, squeeze, speed):
        if self.suspension is None:
            return self.mounting.stiffness[2] * squeeze + self.mounting.damping[2] * speed
        load = self.springs(squeeze)
        friction = self.suspension.friction_ratio * load * np.tanh(speed / self.suspension.friction_speed)
        return load + friction - self.vehicle.mass[[BODY, BOGIE]].sum() * GRAVITY

    def slope(self, state, height):
        place, speed, waves, shortest = self.split(state)
        stiffness, damping = self.vehicle.stiffness, self.vehicle.damping
        force = np.zeros(4)
        for upper, lower in ((BODY, BOGIE), (BOX, WHEEL)):
            spring = -stiffness[upper, lower] * (place[lower] - place[upper])
            spring -= damping[upper, lower] * (speed[lower] - speed[upper])
            force[upper] += spring
            force[lower] -= spring
        primary = self.primary(place[BOX] - place[BOGIE], speed[BOX] - speed[BOGIE])
        force[BOGIE] += primary
        force[BOX] -= primary
        contact = self.contact(state, height) - self.vehicle.static_force
        force[WHEEL] += contact
        moving = np.einsum("wij,wj->wi", self.rates, waves)
        moving[:, 3] -= self.rail.inverse_mass * contact
        giving = (-self.rail.residual_flexibility * contact - shortest) / self.rail.residual_time
        return np.concatenate([speed, force / self.vehicle.mass, moving.ravel(), [giving]])

    def run(self, height, times):
        solution = solve_ivp(
            lambda t, y: self.slope(y, height(t)),
            (0.0, times[-1]),
            np.zeros(8 + 6 * self.count + 1),
            t_eval=times,
            rtol=1e-6,
            atol=1e-10,
            max_step=2e-4,
        )
        return solution.y.T

    def energy(self, state):
        """Kinetic energy and that of springs and contact beyond rest, [J]."""
        place, speed, waves, shortest = self.split(state)
        rail, vehicle = self.rail, self.vehicle
        total = 0.5 * np.sum(vehicle.mass * speed**2)
        total += 0.5 * vehicle.stiffness[BODY, BODY] * (place[BODY] - place[BOGIE]) ** 2
        total += 0.5 * -vehicle.stiffness[BOX, WHEEL] * (place[BOX] - place[WHEEL]) ** 2
        squeeze = place[BOX] - place[BOGIE]
        if self.suspension is None:
            total += 0.5 * self.mounting.stiffness[2] * squeeze**2
        else:
            grid = np.linspace(0.0, squeeze, 201)
            rest = self.springs(0.0)
            total += np.trapezoid([self.springs(at) - rest for at in grid], grid)
        # modal shares weigh mass and seats of each wave
        total += 0.5 * np.sum(rail.share[:, None] * rail.mass * waves[:, 3:] ** 2)
        stretch = np.stack([waves[:, 0] - waves[:, 1], waves[:, 1] - waves[:, 2], waves[:, 2]], axis=1)
        total += 0.5 * np.sum(rail.share[:, None] * rail.seats * stretch**2)
        total += 0.5 * np.sum(rail.share * rail.stiffness * waves[:, 0] ** 2)
        total += 0.5 * shortest**2 / rail.residual_flexibility
        flexibility, force = vehicle.contact_flexibility, self.contact(state, 0.0)
        rest = flexibility * vehicle.static_force ** (2 / 3)
        moved = waves[:, 0].sum() + shortest - place[WHEEL]
        pressed = max(rest + moved, 0.0)
        # what the contact stores, less what the weight at rest has given
        total += 0.4 * (pressed * force - rest * vehicle.static_force) - vehicle.static_force * moved
        return total


def bump(time):
    """A dip of 3 mm that lets the wheel fly, gone after 30 ms."""
    within = np.clip(time / 0.03, 0.0, 1.0)
    return -3e-3 * np.sin(np.pi * within) ** 2


@pytest.mark.parametrize("operation", [SMOOTH, FREIGHT], ids=["linear", "progressive"])
def test_a_ride_is_that_of_a_plain_integration(operation):
    naive = NaiveRide(operation, Mounting())
    time = np.arange(1800) * STEP
    states = naive.run(bump, time)
    response = ride(naive.vehicle, bump(time), STEP)
    force = np.array([naive.contact(state, bump(t)) for state, t in zip(states, time, strict=True)])
    assert force.min() == 0.0
    assert force.max() > 1.8 * naive.vehicle.static_force
    assert np.abs(response.contact_force - force).max() < 0.02 * force.max()
    assert np.abs(response.wheel - states[:, WHEEL]).max() < 2e-3 * np.abs(states[:, WHEEL]).max()
    assert np.abs(response.bogie - states[:, BOGIE]).max() < 2e-3 * np.abs(states[:, BOGIE]).max()


@pytest.mark.parametrize("operation", [SMOOTH, FREIGHT], ids=["linear", "progressive"])
def test_energy_of_the_unforced_system_never_grows(operation):
    """After the dip nothing is put in: seats, dampers and friction take the energy out."""
    naive = NaiveRide(operation, Mounting())
    time = np.arange(3200) * STEP
    states = naive.run(bump, time)
    free = np.flatnonzero(time > 0.0301)[::10]
    energy = np.array([naive.energy(states[n]) for n in free])
    assert energy[0] > 50.0
    assert (np.diff(energy) < 1e-5 * energy[0]).all()
    assert energy[-1] < 0.9 * energy[0]


def test_the_compiled_ride_dies_away_after_a_blow():
    """The impulse method itself puts no energy in: nine seconds after a flight there is nothing left."""
    for operation in (SMOOTH, FREIGHT):
        vehicle = quarter_vehicle(operation, Mounting())
        response = ride(vehicle, 5.0 * bump(np.arange(400_000) * STEP), STEP)
        assert response.contact_force.min() == 0.0
        swing = [
            np.abs(response.contact_force[n : n + 40_000] / vehicle.static_force - 1).max()
            for n in range(0, 400_000, 40_000)
        ]
        assert swing[0] > 1.0
        assert (np.diff(swing) < 1e-6).all()
        assert swing[-1] < 0.02


def test_a_progressive_suspension_carries_the_weight_at_rest():
    for payload in (0.0, 70e3):
        loaded = dataclasses.replace(FREIGHT, payload=payload)
        vehicle = quarter_vehicle(loaded, Mounting())
        response = ride(vehicle, np.zeros(4000), STEP)
        assert np.allclose(response.contact_force, vehicle.static_force, rtol=1e-9, atol=0)
        assert np.abs(response.excess).max() < 1e-3


def test_the_bogie_shift_makes_a_linear_suspension_press_likewise():
    """stiffness x shift + damping x its speed is the force that the linear law lacks."""
    mounting = Mounting()
    time = np.arange(40_000) * STEP
    force = 3e3 * np.sin(2 * np.pi * 3.0 * np.maximum(time - 0.1, 0.0))
    shift = equivalent_displacement(force, mounting, 2, STEP)
    felt = mounting.stiffness[2] * shift + mounting.damping[2] * np.gradient(shift, STEP)
    assert np.abs(felt - force).max() < 0.01 * 3e3
    assert equivalent_displacement(
        force, dataclasses.replace(mounting, damping=(0.0, 0.0, 0.0)), 2, STEP
    ) == pytest.approx(force / mounting.stiffness[2])


def naive_sway(operation, mounting, speed, plan, times, every):
    """Forces of each wheel and flange, one by one."""
    guidance = operation.vehicle.guidance
    share = lateral_vehicle(operation, mounting)
    radius, arm = 0.5 * operation.wheel_diameter, 0.5 * guidance.axlebox_spacing
    load = (share.mass[0] + share.mass[2] + share.mass[3]) * GRAVITY
    coefficient = 1e7 * (load / 85e3) ** (2 / 3)

    def slope(time, state):
        place, rate = state[:4], state[4:]
        curvature, lean = np.interp(time, times, plan.curvature), np.interp(time, times, plan.lean)
        rolling = np.hypot(speed, 0.5)
        force = share.mass * lean
        force[1] = 0.0
        for side in (0.5, -0.5):  # the left and the right wheel, half of the axle: half of each
            grown = radius + 2 * side * guidance.conicity * place[0]
            forwards = speed - 2 * side * HALF_GAUGE * (rate[1] + speed * curvature)
            along = coefficient * (forwards - speed / radius * grown) / rolling
            aside = coefficient * (rate[0] - speed * place[1]) / rolling
            grip = 1 / np.sqrt(1 + (along**2 + aside**2) / (guidance.friction * load) ** 2)
            force[0] -= 0.5 * grip * aside
            force[1] += 2 * side * HALF_GAUGE * 0.5 * grip * along
        beyond = abs(place[0]) - guidance.flange_clearance
        if beyond > 0.0:
            outwards = np.sign(place[0])
            spring = guidance.flange_stiffness * beyond
            damper = guidance.flange_damping * rate[0] * outwards
            force[0] -= 0.5 * (spring + damper if spring + damper > 0.0 else spring) * outwards
        primary = mounting.stiffness[1] * (place[2] - place[0]) + mounting.damping[1] * (rate[2] - rate[0])
        secondary = 0.5 * guidance.secondary_stiffness * (place[3] - place[2])
        secondary += 0.5 * guidance.secondary_damping * (rate[3] - rate[2])
        force += [primary, 0.0, secondary - primary, -secondary]
        force[1] -= arm**2 * (mounting.stiffness[0] * place[1] + mounting.damping[0] * rate[1])
        return np.concatenate([rate, force / share.mass])

    solution = solve_ivp(
        slope, (0.0, times[-1]), np.zeros(8), "LSODA", times[::every], rtol=1e-6, atol=1e-9, max_step=5e-3
    )
    return solution.y.T[:, :4]


@pytest.mark.parametrize("speed", [25.0, -25.0])
def test_a_sway_is_that_of_a_plain_integration(speed):
    """Through a tight curve, against the flange, and out of it."""
    curves = (Curve(250.0, 0.05, 5.0, 60.0, 15.0, "right"),)
    operation = dataclasses.replace(SMOOTH, curves=curves, speed_profile=((0.0, speed),))
    step = 5e-4
    time = np.arange(7000) * step
    # backwards through the same curve
    plan = course(curves, speed * time + (0.0 if speed > 0 else 70.0), np.full(len(time), speed))
    swayed = lateral_motion(
        lateral_vehicle(operation, Mounting()), np.full(len(time), speed), plan, np.zeros(len(time)), step
    )
    assert np.abs(swayed.motion[:, 0]).max() > operation.vehicle.guidance.flange_clearance
    plain = naive_sway(operation, Mounting(), speed, plan, time, 20)
    for axis in range(4):
        scale = np.abs(plain[:, axis]).max()
        assert np.abs(swayed.motion[::20, axis] - plain[:, axis]).max() < 0.02 * scale
