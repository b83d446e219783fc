"""Sensor readings in a box that bends against a rigid one: rollers as springs between journal and modes.

Small motion about the equilibrium of the typical load, nothing is run. Each loaded roller is a massless
spring with the damping of its contacts, and a gap that changes by the same amount at each of them, one
independent of the other, shakes a journal on one side and the box on the other.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.physics.journal import journal_shapes, modes_of
from beardyn_core.physics.modal_body import ModalBody
from beardyn_core.physics.roller_spring import lever_of_cup, roller_stiffness
from beardyn_core.physics.statics.static import StaticSolution
from beardyn_core.physics.suspension import box_coupling, cross_matrix, spatial_mass
from beardyn_core.scene.scene import Scene
from beardyn_core.structure.mounted_box import seat_of

_BAND_RATIO = 10.0**0.1  # third octaves of IEC 61260-1, base ten
_LOWEST_BAND = 200.0  # below, the suspension counts and a box of some tens of kilograms is rigid [Hz]
_RIGID = 10.0  # slower motion is that of rigid bodies, which nothing holds here [Hz]
_LINES = 24  # in a band, a few within the width of a mode


def band_centres(highest: float) -> Float:
    """Give the centres of third octaves from 200 Hz up to a frequency [Hz]."""
    count = round(10.0 * math.log10(highest / _LOWEST_BAND)) + 1
    centres = 1000.0 * _BAND_RATIO ** (np.arange(count) - 7)
    return np.asarray(centres[centres < 1.001 * highest])


def levels(scene: Scene, static: StaticSolution, body: ModalBody | None, highest: float) -> Float:
    """Work out the levels of the sensors' third octaves for gaps of rollers that change alike, [dB].

    Parameters
    ----------
    scene : Scene
        Box, journal, sensors; its own effect `structure` does not matter.
    static : StaticSolution
        Of the load: which rollers carry.
    body : ModalBody or None
        ``None``: the box is rigid.
    highest : float
        Third octaves up to here, where the last one is cut off, [Hz].

    Returns
    -------
    array, shape [sensor, band]
        Of accelerations per metre, the axes together, so that only differences mean anything.

    Notes
    -----
    Between the contacts i with wrenches n_i the receptances of journal, axle, box and modes add up to H(w);
    with springs k_i (1 + j w T) a gap d moves forces F = (K^-1 + H)^-1 d, which the sensors read through the
    receptance of box and modes. The suspension, the inertia of rollers and the tilt of their contacts are
    left out: below 200 Hz the first counts, towards their bounce at 17 to 22 kHz the second.
    """
    azimuth, sides, loads = _loaded_rollers(scene, static)
    cosine, wrench = math.cos(scene.bearing.cup_slant), _wrenches(scene, azimuth, sides)
    centres = band_centres(highest)
    if not loads.size:
        return np.zeros((len(scene.sensors), centres.size))
    low, high = centres / _BAND_RATIO**0.5, np.minimum(centres * _BAND_RATIO**0.5, highest)
    place = (np.arange(_LINES) + 0.5) / _LINES
    rate = 2.0 * np.pi * (low[:, None] + (high - low)[:, None] * place).ravel()
    damping = scene.effects.contact_damping
    time_constant = 0.0 if damping is None else damping.time_constant
    spring = roller_stiffness(scene.bearing, loads) * (1.0 + 1j * rate[:, None] * time_constant)
    box = _free_box(scene, body)
    between = -(wrench @ (_journal(scene) + box) @ wrench.T) / rate[:, None, None] ** 2
    arms = [np.block([np.eye(3), -cross_matrix(sensor.position)]) for sensor in scene.sensors]
    reading = np.concatenate(arms)
    received = np.broadcast_to(reading @ box @ wrench.T, (rate.size, len(reading), azimuth.size))
    axle = modes_of(scene)
    if axle is not None:
        bent = wrench @ journal_shapes(axle)
        own = np.tile(2.0 * np.pi * axle.frequency, 2)
        yields = _receptance(own, axle.damping_ratio, rate)
        between = between + np.einsum("im,lm,jm->lij", bent, yields, bent, optimize=True)
    if body is not None:
        rows = (sides > 0.0).astype(int)
        shapes = cosine * body.openings(azimuth)[rows, np.arange(azimuth.size)]
        yielding = _receptance(body.rate, body.damping_ratio, rate)
        between = between + np.einsum("im,lm,jm->lij", shapes, yielding, shapes, optimize=True)
        if body.modes is not None:
            seats = [body.modes.seats[seat_of(sensor, body.modes)].T for sensor in scene.sensors]
            ringing = np.einsum("sm,lm,jm->lsj", np.concatenate(seats), yielding, shapes, optimize=True)
            received = received - rate[:, None, None] ** 2 * ringing
    forces = np.linalg.inv(between + np.eye(azimuth.size) / spring[:, :, None])
    power = (np.abs(received @ forces) ** 2).sum(axis=-1)
    mean = power.reshape(centres.size, _LINES, len(scene.sensors), 3).sum(axis=(1, 3)) / _LINES
    return np.asarray(10.0 * np.log10(mean)).T


def _receptance(own: Float, damping_ratio: Float | float, rate: Float) -> NDArray[np.complex128]:
    """Answer of modes of unit mass with rates of their ``own`` to forces, shape [rate, mode], [s^2]."""
    driven = rate[:, None]
    return np.asarray(1.0 / (own**2 - driven**2 + 2j * damping_ratio * own * driven))


def _loaded_rollers(scene: Scene, static: StaticSolution) -> tuple[Float, Float, Float]:
    """Give azimuth [rad], side of the bearing centre and load [N] of the rollers that carry."""
    count = scene.bearing.roller_count
    load = static.cup_load
    around = np.broadcast_to(2.0 * np.pi * np.arange(count) / count, load.shape)
    sides = np.broadcast_to(np.array([-1.0, 1.0])[: len(load), None], load.shape)
    carries = static.cone_load > 0.0
    return around[carries], sides[carries], load[carries]


def _wrenches(scene: Scene, azimuth: Float, sides: Float) -> Float:
    """Give force and moment about the bearing centre of unit forces of rollers on the cup, [roller, 6]."""
    lever = lever_of_cup(scene.bearing)
    cosine, sine = math.cos(scene.bearing.cup_slant), math.sin(scene.bearing.cup_slant)
    return np.stack(
        [
            cosine * np.sin(azimuth),
            -sides * sine,
            cosine * np.cos(azimuth),
            sides * lever * np.cos(azimuth),
            np.zeros_like(azimuth),
            -sides * lever * np.sin(azimuth),
        ],
        axis=1,
    )


class Bounce(NamedTuple):
    """Resonance of axlebox and cup on the stiffness of the bearing."""

    frequency: float  # [Hz]
    contacts: float  # part of the springs' energy that is in the contacts of rollers [-]
    axle: float  # damping by bending of the axle, over the critical one [-]


def bounce(scene: Scene, static: StaticSolution, force: Float) -> Bounce | None:
    """Find the mode in which the box moves most along a force [N], on an axle that bends.

    ``None`` where the wheelset is rigid, or no roller carries.
    """
    axle = modes_of(scene)
    azimuth, sides, loads = _loaded_rollers(scene, static)
    if axle is None or not loads.size:
        return None
    spring = np.sqrt(roller_stiffness(scene.bearing, loads))
    box, journal = np.linalg.cholesky(_free_box(scene, None)), np.sqrt(_journal(scene))
    moved = np.hstack([-box, journal, journal_shapes(axle)])  # by coordinates of unit mass
    pressed = spring[:, None] * _wrenches(scene, azimuth, sides) @ moved
    own = np.zeros(moved.shape[1])
    own[12:] = np.tile(2.0 * np.pi * axle.frequency, 2)
    square, shape = np.linalg.eigh(pressed.T @ pressed + np.diag(own**2))
    along = np.asarray(force)[:3] @ box[:3] @ shape[:6]
    rings = square > (2.0 * np.pi * _RIGID) ** 2
    at = int(np.argmax(np.where(rings, np.abs(along), 0.0)))
    rate = math.sqrt(square[at])
    damping = axle.damping_ratio * float(own @ shape[:, at] ** 2) / rate
    return Bounce(rate / (2.0 * math.pi), float(((pressed @ shape[:, at]) ** 2).sum()) / rate**2, damping)


def _journal(scene: Scene) -> Float:
    mounting = scene.mounting
    give = np.zeros((6, 6))
    give[:3, :3] = np.eye(3) / (mounting.journal_mass + scene.bearing.cone_mass)
    if mounting.journal_tilt == "free":
        give[[3, 5], [3, 5]] = 1.0 / mounting.journal_inertia
    return give


def _free_box(scene: Scene, body: ModalBody | None) -> Float:
    coupling = box_coupling(scene.bearing, scene.mounting, body.modes if body is not None else None)
    if coupling is not None:
        return np.asarray(coupling.inverse_mass)
    inertia = np.add(scene.mounting.box_inertia, scene.bearing.cup_inertia)
    mass = scene.mounting.box_mass + scene.bearing.cup_mass
    return np.asarray(np.linalg.inv(spatial_mass(mass, inertia, np.zeros(3))))
