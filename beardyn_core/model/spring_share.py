"""How much of the change of a contact's spring force over a step the step takes in."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.contact_law import LINE_EXPONENT
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.model.layout import LAMINA_STIFFNESS

LEAST_SHARE, MOST_SHARE = 1.0 / 12.0, 0.25
_PRESSURE = 4e9  # the static rating's limit of roller bearings, ISO 76 [Pa]
_MARGIN = 1.1  # on the frequency, for ribs and moving rings


def highest_bounce(bearing: Bearing, stiffness: float) -> float:
    """Work out the rate at which a roller bounces between its raceways under the highest pressure, [rad/s].

    ``stiffness``: factor of one raceway contact, all laminae together [N/m^(10/9)].

    References
    ----------
    Johnson, K. L. (1985), Contact Mechanics, eq. 4.45: p^2 = Q E' / (2 pi L R), here with the roller's own
    radius as R, and with 4 GPa, at which ISO 76 rates roller bearings statically.
    """
    radius, length = 0.5 * bearing.roller_diameter, bearing.effective_length
    load = 2.0 * math.pi * length * radius * _PRESSURE**2 / bearing.material.contact_modulus
    one = LINE_EXPONENT * stiffness ** (1.0 / LINE_EXPONENT) * load ** (1.0 - 1.0 / LINE_EXPONENT)
    return math.sqrt(2.0 * one / bearing.roller_mass)


def spring_time(bearing: Bearing, laminae: NDArray[np.float64], step: float, damped: bool) -> float:
    """Share of the step over which contact springs are implicit, from the lamina table, [s].

    ``laminae`` [LAMINA_ROWS, lamina]; ``step``: [s]; ``damped``: whether contacts are damped. A share between
    1/12 and 1/4 is stable for a linear mode; contacts that lift off without a damper make energy with it, and
    much less with 1/4.
    """
    bounce = highest_bounce(bearing, float(laminae[LAMINA_STIFFNESS].sum()))
    share = implicit_spring_share(bounce, step)
    return step * (share if damped or share == LEAST_SHARE else MOST_SHARE)


def implicit_spring_share(bounce: float, step: float) -> float:
    """Choose Newmark's beta: the least that is stable, and 1/12 where the step resolves the bounce.

    ``bounce``: highest rate of a mode of rollers on their contacts [rad/s]; ``step``: [s]. From 1/12
    to 1/4.

    With velocities half a step after positions the frequency w of an undamped mode comes out as w' with
    4 sin^2(w' h / 2) = (w h)^2 (1 - 4 beta sin^2(w' h / 2)): stable up to (w h)^2 (1 - 4 beta) = 4, and for
    beta = 1/12 right to the fourth order in the step, for anything else to the second.

    References
    ----------
    Newmark, N. M. (1959), A method of computation for structural dynamics, J. Eng. Mech. Div. ASCE 85(3);
    Hairer, E., Lubich, C. and Wanner, G. (2003), Acta Numerica 12, 399-450, for the staggered form.
    """
    return max(LEAST_SHARE, MOST_SHARE - 1.0 / (_MARGIN * bounce * step) ** 2)
