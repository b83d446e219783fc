"""Places and motions of one roller near a working contact, with everything a twin may meet."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.physics.bodies.layout import (
    ANGLE,
    ANGULAR,
    AXIAL,
    AXIS,
    CAGE_BODY,
    CHANGE,
    CONE_BODY,
    CUP_BODY,
    LINEAR,
    MOMENTUM,
    POSITION,
    RADIUS,
    RATE,
    ROLLER_STATES,
    TILT,
    TURN,
    VELOCITY,
)
from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.scene.scene import Scene
from test.kernels import naive_step
from test.kernels.naive import Motion
from test.kernels.rig import Rig
from test.scenes import standard_scene

Float = NDArray[np.float64]


def random_motion(
    scene: Scene,
    rng: np.random.Generator,
    *,
    skew: float = 2e-3,
    tilt: float = 1e-4,
    lift: float = 0.0,
    moving: bool = True,
) -> Motion:
    """Nominal roller moved ``lift`` outwards (+-10 um scatter), skewed and tilted at random."""
    bearing = scene.bearing
    azimuth = rng.uniform(-np.pi, np.pi)
    angle = bearing.contact_angle + rng.uniform(-tilt, tilt)
    turn = rng.uniform(-skew, skew)
    axis = np.array(
        [math.sin(angle) * math.cos(turn), math.cos(angle) * math.sin(turn), math.cos(angle) * math.cos(turn)]
    )
    axis /= np.linalg.norm(axis)
    offset = bearing.roller_mass_offset
    radial = 0.5 * bearing.pitch_diameter + offset * math.sin(bearing.contact_angle)
    centre = np.array(
        [
            radial + lift + rng.uniform(-1e-5, 1e-5),
            rng.uniform(-1e-4, 1e-4),
            0.5 * bearing.row_spacing + offset * math.cos(bearing.contact_angle) + rng.uniform(-2e-5, 2e-5),
        ]
    )
    ring_axis = np.array([rng.uniform(-3e-4, 3e-4), rng.uniform(-3e-4, 3e-4), 1.0])
    ring_axis /= np.linalg.norm(ring_axis)
    spin = np.array([0.0, 0.0, 0.0])
    zero = np.zeros(3)
    velocity, omega, ring_velocity, ring_omega = zero, zero, zero, zero
    if moving:
        orbit = 52.0
        velocity = np.array([0.0, orbit * radial, 0.0]) + rng.normal(0.0, 0.02, 3)
        spin = -orbit * math.sin(bearing.cup_angle) / math.sin(bearing.half_angle) * axis
        omega = spin + np.array([0.0, 0.0, orbit]) + rng.normal(0.0, 2.0, 3)
        ring_velocity = rng.normal(0.0, 0.01, 3)
        ring_omega = 122.0 * rng.integers(0, 2) * ring_axis + rng.normal(0.0, 0.01, 3)
    c, s = math.cos(azimuth), math.sin(azimuth)
    frame = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return Motion(
        frame @ centre, frame @ axis, frame @ velocity, frame @ omega, ring_axis, ring_velocity, ring_omega
    )


def packed(motion: Motion, last: float = 0.0) -> Float:
    """Motion as the inputs of the kernel entries."""
    m = motion
    return np.concatenate(
        [m.centre, m.axis, m.ring_axis, m.velocity, m.omega, m.ring_velocity, m.ring_omega, [last]]
    )


def only(p: Parameters, **members: Any) -> Parameters:
    """Parameters with no effect but the given ones."""
    none = {name: None for name in p.effects._fields if name != "faults"}
    return p._replace(effects=p.effects._replace(**{**none, **members}))


def in_row(vector: Float, row: int, *, axial: bool = False) -> Float:
    """World x, y, z in the row's frame z, x, outward; row 0 is a mirror image, where axial vectors flip."""
    side = 2 * row - 1
    x, y, z = vector
    return np.array([side * z, side * x, y]) if axial else np.array([z, x, side * y])


def ring_of(bodies: Float, body: int, row: int, place: float) -> naive_step.Ring:
    """Ring as a row sees it, from the cup's origin."""
    state = bodies[body]
    third = np.array([0.0, 1.0, 0.0])
    axis = naive_step.rotated(state[TILT : TILT + 3], third)
    origin = state[POSITION : POSITION + 3] - bodies[CUP_BODY, POSITION : POSITION + 3]
    origin = in_row(origin, row) + np.array([0.0, 0.0, place])
    is_cage = body >= CAGE_BODY
    # cup and cone show where their velocities are going
    motion = state[LINEAR : LINEAR + 6] + (0.0 if is_cage else state[CHANGE : CHANGE + 6])
    omega = motion[3:] + state[RATE] * axis
    shown = state[TILT : TILT + 3] if is_cage else axis
    return naive_step.Ring(
        origin, in_row(shown, row, axial=True), in_row(motion[:3], row),
        in_row(omega, row, axial=True), in_row(state[LINEAR : LINEAR + 3], row), state[TURN],
    )  # fmt: skip


def cartesian(fields: Float) -> naive_step.RollerState:
    angle = fields[ANGLE]
    c, s = math.cos(angle), math.sin(angle)

    def out(first: int) -> Float:
        return naive_step.turned(angle, fields[first : first + 3])

    centre = np.array([fields[RADIUS] * c, fields[RADIUS] * s, fields[AXIAL]])
    return naive_step.RollerState(centre, out(AXIS), out(VELOCITY), out(MOMENTUM))


def shaken(seed: int, width: int = 8, scene: Scene | None = None) -> Rig:
    """The standard bearing under 80 kN with every place and velocity disturbed; all four contacts work."""
    rig = Rig.at_equilibrium(scene or standard_scene(), width=width)
    rng = np.random.default_rng(seed)
    fields = rig.fields()[:ROLLER_STATES]
    shape = fields.shape[1:]
    fields[RADIUS] += rng.normal(0.0, 2e-6, shape)
    fields[AXIAL] += rng.normal(0.0, 1e-5, shape)
    fields[ANGLE] += rng.normal(0.0, 1.2e-3, shape)
    fields[VELOCITY : VELOCITY + 3] += rng.normal(0.0, 0.02, (3, *shape))
    fields[AXIS : AXIS + 2] += rng.normal(0.0, 2e-4, (2, *shape))
    fields[AXIS : AXIS + 3] /= np.linalg.norm(fields[AXIS : AXIS + 3], axis=0)
    fields[MOMENTUM : MOMENTUM + 3] += rng.normal(0.0, 1e-5, (3, *shape))
    rig.set_fields(fields)
    bodies = rig.state.bodies
    bodies[CONE_BODY, LINEAR : LINEAR + 3] = rng.normal(0.0, 0.01, 3)
    bodies[:CAGE_BODY, CHANGE : CHANGE + 6] = rng.normal(0.0, 1e-3, (CAGE_BODY, 6))
    cages = (len(bodies) - CAGE_BODY, 3)
    bodies[CAGE_BODY:, POSITION : POSITION + 3] = rng.normal(0.0, 3e-5, cages)
    bodies[CAGE_BODY:, TILT : TILT + 3] = rng.normal(0.0, 2e-4, cages) * [1.0, 0.0, 1.0]
    bodies[CAGE_BODY:, LINEAR : LINEAR + 3] = rng.normal(0.0, 0.02, cages)
    bodies[CAGE_BODY:, ANGULAR : ANGULAR + 3] = rng.normal(0.0, 0.2, cages) * [1.0, 0.0, 1.0]
    return rig
