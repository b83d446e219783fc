"""Manufacturing scatter as numbers of each roller: offsets of its contacts, crown, place of its pocket."""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.scene.scene import Scene


def scattered_oversize(scene: Scene) -> Float:
    """Work out the radius error of each roller from its diameter and its row's clearance.

    A raceway of another diameter is taken as rollers that are thicker or thinner: c more of diametral
    clearance opens the normal gap of a roller by c/2 times the cosine of the cup angle, half of it a contact.
    The mean of both rows is end play, which is set when they are mounted: the scene's stays as it is.

    Returns
    -------
    float64 array, shape [row, roller]
        [m].

    Notes
    -----
    The radius itself changes by 1e-4, and with it rolling speeds by less; exact in tier full.
    """
    made = scene.scattered.deviations(scene.bearing) if scene.scattered else None
    if made is None:
        return np.zeros((2, scene.bearing.roller_count))
    apart = made.row_clearance - made.row_clearance.mean()
    gap = 0.5 * math.cos(scene.bearing.cup_angle) * apart
    return np.asarray(0.5 * made.roller_diameter - 0.5 * gap[:, None])


def crown_errors(scene: Scene) -> Float | None:
    """Work out the parabola that each roller's profile is off by; ``None`` without scatter of profiles.

    Returns
    -------
    float64 array, shape [row, roller]
        Drop over the squared distance from mid-length, [1/m].
    """
    if scene.scattered is None or not scene.scattered.variation("profile"):
        return None
    half = 0.5 * scene.bearing.effective_length
    return np.asarray(scene.scattered.deviations(scene.bearing).profile / half**2)


def mean_crown(scene: Scene) -> Float:
    """Work out the mean error of each roller's profile along its contact, shape [row, roller], [m]."""
    crowns = crown_errors(scene)
    if crowns is None:
        return np.zeros((2, scene.bearing.roller_count))
    return np.asarray(crowns * scene.bearing.effective_length**2 / 12.0)


def pocket_offsets(scene: Scene) -> Float:
    """Work out how far each pocket stands ahead of its place, shape [row, roller], [rad].

    Where a roller orbits by itself (tier full) its pocket decides its spacing all the same: behind the load
    zone nothing but a bar of the pocket drives it, and from that bar it enters the load zone, which all
    rollers pass alike. The fast tiers put it into its pocket's middle.
    """
    if scene.scattered is None:
        return np.zeros((2, scene.bearing.roller_count))
    place = scene.scattered.deviations(scene.bearing).pocket_place
    return np.asarray(place / (0.5 * scene.bearing.pitch_diameter))
