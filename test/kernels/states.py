"""Places and motions of one roller near a working contact, with everything a twin may meet."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.physics.tiers.parameters import Parameters
from beardyn_core.scene.scene import Scene
from test.kernels.naive import Motion

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
