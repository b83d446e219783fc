"""The yardstick: the standard model written plainly in NumPy, integrated by scipy's `solve_ivp`.

First-order equations of motion of all 34 rollers in Cartesian coordinates, of the cone and of both cages in
six degrees of freedom, with the slow and obvious force laws that the kernels are tested against: every lamina
at its own contact point, Dowson-Higginson film, mixed traction, rib, pocket, contact damping, weight. Same
bearing, load, laminae and initial state as the kernel; forces are compared before the clock starts.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from beardyn_core.physics.bodies.layout import (
    ANGULAR,
    BODY_STATES,
    CAGE_BODY,
    CONE_BODY,
    CUP_BODY,
    LINEAR,
    POSITION,
    RATE,
    ROLLER_STATES,
    SIGNAL_FORCE,
    SIGNAL_TORQUE,
    TILT,
    TURN,
)
from benchmarks.runs import Table
from test.kernels import naive, naive_step
from test.kernels.naive_traction import lamina_friction
from test.kernels.rig import Rig
from test.kernels.states import cartesian, ring_of
from test.scenes import standard_scene

Float = NDArray[np.float64]
_BODY_VALUES = 4 * BODY_STATES
_X, _Y, _Z = 0, 1, 2


@dataclass
class NaiveModel:
    """Right-hand side of the equations of motion.

    Parameters
    ----------
    rig : Rig
        The scene with its kernel parameters and its static equilibrium.
    """

    rig: Rig
    calls: int = 0

    def initial_state(self) -> Float:
        """Stack bodies, then centre, axis, velocity and momentum of each roller."""
        fields = self.rig.fields()[:ROLLER_STATES]
        count = self.rig.scene.bearing.roller_count
        rollers = [cartesian(fields[:, row, k]) for row in (0, 1) for k in range(count)]
        parts = [np.concatenate([r.centre, r.axis, r.velocity, r.momentum]) for r in rollers]
        return np.concatenate([self.rig.state.bodies.ravel(), *parts])

    def rates(self, _time: float, state: Float) -> Float:
        """Compute the time derivative of the state."""
        self.calls += 1
        bodies = state[:_BODY_VALUES].reshape(4, BODY_STATES)
        rollers = state[_BODY_VALUES:].reshape(2, -1, 4, 3)
        roller_rates, wrenches = np.zeros_like(rollers), np.zeros((4, 6))
        for row in (0, 1):
            for k in range(rollers.shape[1]):
                self._roller(bodies, row, k, rollers[row, k], roller_rates[row, k], wrenches)
        return np.concatenate([self._body_rates(bodies, wrenches).ravel(), roller_rates.ravel()])

    def wrenches(self, state: Float) -> Float:
        """Compute the world wrenches of the rollers on cup, cone and cages, shape [4, 6]."""
        bodies = state[:_BODY_VALUES].reshape(4, BODY_STATES)
        rollers = state[_BODY_VALUES:].reshape(2, -1, 4, 3)
        found = np.zeros((4, 6))
        for row in (0, 1):
            for k in range(rollers.shape[1]):
                self._roller(bodies, row, k, rollers[row, k], np.zeros((4, 3)), found)
        return found

    def _roller(self, bodies: Float, row: int, k: int, roller: Float, rates: Float, wrenches: Float) -> None:
        """Compute the rates of one roller; adds its reactions."""
        p, scene = self.rig.parameters, self.rig.scene
        effects: Any = p.effects  # the standard ones, all present
        constants = p.roller
        centre, axis, velocity, momentum = roller
        axis = axis / np.linalg.norm(axis)
        spin = float(momentum @ axis)
        omega = momentum / constants.transverse_inertia
        omega = omega + (spin / constants.axial_inertia - spin / constants.transverse_inertia) * axis
        azimuth = math.atan2(centre[1], centre[0])
        orbit_rate = float(centre[0] * velocity[1] - centre[1] * velocity[0]) / float(centre[:2] @ centre[:2])
        cup, cone = ring_of(bodies, CUP_BODY, row, 0.0), ring_of(bodies, CONE_BODY, row, 0.0)
        cage = ring_of(bodies, CAGE_BODY + row, row, effects.cage.place)

        def against(ring: naive_step.Ring, ring_axis: Float) -> naive.Motion:
            return naive.Motion(
                centre - ring.origin, axis, velocity, omega, ring_axis, ring.velocity, ring.omega
            )

        damping = effects.damping.time_constant
        contacts = []
        for side, (ring, raceway) in enumerate(((cup, p.cup), (cone, p.cone))):
            motion = against(ring, ring.axis)
            speed = naive_step.entrainment(motion, raceway, constants, orbit_rate)

            def law(lamina: int, load: float, slip: float, side: int = side, speed: float = speed) -> float:
                return lamina_friction(scene, p, side, lamina, load, slip, speed)

            contacts.append(
                naive.raceway_wrench(
                    motion, raceway, constants, p.laminae, friction=law, damping_time=damping
                )
            )
        contacts.append(naive.rib_wrench(against(cone, cone.axis), effects.rib, damping_time=damping))
        pocket = 2.0 * math.pi * k / scene.bearing.roller_count
        advance = (azimuth - cage.turn - pocket + math.pi) % (2.0 * math.pi) - math.pi
        third = np.array([0.0, 0.0, 1.0])
        contacts.append(
            naive.pocket_wrench(against(cage, third), cage.axis, advance, azimuth, constants, effects.cage)
        )
        force = np.array([-constants.mass * effects.gravity.acceleration, 0.0, 0.0])
        moment = np.zeros(3)
        side = 2 * row - 1
        for contact, ring, body in zip(
            contacts, (cup, cone, cone, cage), (CUP_BODY, CONE_BODY, CONE_BODY, CAGE_BODY + row), strict=True
        ):
            force, moment = force + contact.force, moment + contact.moment
            back = -contact.force
            turn = -contact.moment + np.cross(centre - ring.origin, back)
            wrenches[body] += [back[1], side * back[2], back[0], side * turn[1], turn[2], side * turn[0]]
        rates[:] = velocity - cup.velocity, np.cross(omega, axis), force / constants.mass, moment

    def _body_rates(self, bodies: Float, wrenches: Float) -> Float:
        mounting = self.rig.parameters.mounting
        effects: Any = self.rig.parameters.effects
        cage = effects.cage
        rates = np.zeros_like(bodies)
        rates[:, POSITION : POSITION + 3] = bodies[:, LINEAR : LINEAR + 3]
        rates[:, TILT : TILT + 3] = bodies[:, ANGULAR : ANGULAR + 3]
        rates[:, TURN] = bodies[:, RATE]
        pushed = wrenches[CONE_BODY, :3] + self.rig.load[:3]
        rates[CONE_BODY, LINEAR : LINEAR + 3] = pushed / mounting.journal_mass
        for body in (CAGE_BODY, CAGE_BODY + 1):
            tilt = bodies[body, TILT : TILT + 3]
            axis = naive_step.rotated(tilt, np.array([0.0, 1.0, 0.0]))
            about_axis = float(wrenches[body, 3:] @ axis)
            across = wrenches[body, 3:] - about_axis * axis
            spinning = cage.polar_inertia * bodies[body, RATE]
            rates[body, LINEAR : LINEAR + 3] = wrenches[body, :3] / cage.mass
            rates[body, LINEAR + _Z] -= effects.gravity.acceleration
            rates[body, ANGULAR + _X] = (
                across[_X] + spinning * bodies[body, ANGULAR + _Z]
            ) / cage.transverse_inertia
            rates[body, ANGULAR + _Z] = (
                across[_Z] - spinning * bodies[body, ANGULAR + _X]
            ) / cage.transverse_inertia
            rates[body, RATE] = about_axis / cage.polar_inertia
        return rates


def forces_against_kernel(rig: Rig) -> tuple[float, float]:
    """Compute the largest difference of the cup's force and of the shaft's torque at the start, relative.

    The kernel makes one step so short that nothing moves.
    """
    naive_wrenches = NaiveModel(rig).wrenches(NaiveModel(rig).initial_state())
    still = Rig.at_equilibrium(rig.scene)
    still.parameters = still.parameters._replace(step=1e-12)
    signals = still.run(1)[0][0]
    force = signals[SIGNAL_FORCE : SIGNAL_FORCE + 3]
    off = np.abs(naive_wrenches[CUP_BODY, :3] - force).max() / np.linalg.norm(force)
    axis = naive_step.rotated(rig.state.bodies[CONE_BODY, TILT : TILT + 3], np.array([0.0, 1.0, 0.0]))
    torque, expected = float(naive_wrenches[CONE_BODY, 3:] @ axis), float(signals[SIGNAL_TORQUE])
    return float(off), abs(torque - expected) / max(abs(expected), 0.1)


def yardstick(simulated: float, kernel_rtf: float) -> Table:
    """Time the plain model over some microseconds, against the kernel's real-time factor."""
    rig = Rig.at_equilibrium(standard_scene())
    force_off, torque_off = forces_against_kernel(rig)
    rows = []
    for method, tolerance in (("RK45", 1e-6),):
        model = NaiveModel(rig)
        state = model.initial_state()
        began = time.perf_counter()
        done = solve_ivp(model.rates, (0.0, simulated), state, method=method, rtol=tolerance, atol=1e-9)
        took = time.perf_counter() - began
        if not done.success:
            raise RuntimeError(f"solve_ivp with {method}: {done.message}")
        rtf = simulated / took
        rows.append((method, 1e6 * simulated, len(done.t) - 1, model.calls, took, rtf, kernel_rtf / rtf))
    return Table(
        "yardstick",
        "The same model written plainly: NumPy and scipy's solve_ivp",
        ("method", "simulated us", "steps", "evaluations", "wall s", "RTF", "beardyn is faster by"),
        rows,
        f"Forces of both at the start: cup {force_off:.1e}, shaft torque {torque_off:.1e} apart (relative). "
        "Extrapolated from the time simulated.",
    )
