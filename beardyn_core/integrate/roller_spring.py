"""A roller between its raceways as one spring: load over approach, worked out once by equilibrium."""

from __future__ import annotations

from functools import cache

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.bearing.force_triangle import centrifugal_cup_load, roller_forces
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.integrate.roller_contacts import ConePose, contact_model
from beardyn_core.integrate.roller_equilibrium import solve_rollers
from beardyn_core.model.tier_parameters import SpringParams, lever_of_cup

TERMS = 8
_SAMPLES = 31
# below this share of the largest load the fit is absolute: a crown leaves light contacts none at all
_SMALLEST_SHARE = 1.0e-3
_SMALLEST_APPROACH, _LARGEST_APPROACH = 2.0e-7, 4.0e-4


@cache
def load_of_approach(bearing: Bearing, laminae: int) -> tuple[Float, Float]:
    """Work out the cup load of a roller over the approach of cone and cup along the cup's normal.

    Both cones are pressed axially against one row, so that every roller of it has the same approach.

    Returns ``approach`` [sample], [m], and ``load`` [sample], [N].
    """
    low, high = _SMALLEST_APPROACH ** (1.0 / 9.0), _LARGEST_APPROACH ** (1.0 / 9.0)
    nodes = np.cos(np.pi * (np.arange(_SAMPLES) + 0.5) / _SAMPLES)
    approach = (0.5 * (low + high) + 0.5 * (high - low) * nodes) ** 9
    model = contact_model(bearing, 0.0, laminae, 0.0, 0.0)
    load = np.empty(_SAMPLES)
    for index, depth in enumerate(approach):
        pose = ConePose(np.array([0.0, -depth / np.sin(bearing.cup_angle), 0.0]), np.eye(3))
        load[index] = solve_rollers(model, pose, None).cup.force[1].sum(axis=-1).mean()
    return approach, load


@cache
def spring_params(bearing: Bearing, laminae: int) -> SpringParams:
    """Fit the spring of one roller by least squares in the ninth root of the approach.

    Notes
    -----
    Two line contacts in series with the rib in the force triangle nearly follow Q = K D^(10/9); what is
    left, the profile at small loads and the point contact of the rib, is smooth in D^(1/9): the fit is good
    to 1e-5 with straight rollers and, above a thousandth of the largest load, to 4 % with a profile that
    takes ends of the roller out of contact, 12 % with too few laminae for it.
    """
    approach, load = load_of_approach(bearing, laminae)
    root = approach ** (1.0 / 9.0)
    powers = root[:, None] ** np.arange(TERMS)
    judged = np.maximum(load, _SMALLEST_SHARE * load.max())
    terms = np.linalg.lstsq(powers * (approach * root / judged)[:, None], load / judged, rcond=None)[0]
    angles = bearing.cup_angle, bearing.cone_angle, bearing.rib_angle
    cone_share, rib_share = roller_forces(1.0, *angles)
    return SpringParams(
        series=np.ascontiguousarray(terms),
        lever=lever_of_cup(bearing),
        cone_share=cone_share,
        rib_share=rib_share,
        rib_centrifugal=roller_forces(0.0, *angles, centrifugal=1.0)[1],
        idle=centrifugal_cup_load(1.0, bearing.cup_angle, bearing.rib_angle),
    )
