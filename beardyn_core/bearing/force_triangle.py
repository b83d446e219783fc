"""One roller between cup, cone and rib: frictionless force triangle with centrifugal force."""

from __future__ import annotations

import math


def roller_forces(
    cup_load: float, cup_angle: float, cone_angle: float, rib_angle: float, centrifugal: float = 0.0
) -> tuple[float, float]:
    """Compute the cone load Q_i and rib load Q_f that balance a cup load Q_o and centrifugal force F_c, [N].

    Angles are the half-angles of the raceways, alpha_o and alpha_i, and alpha_f, that of the rib normal to
    the radial direction, [rad].

    Notes
    -----
    Radially Q_i cos(ai) + F_c = Q_o cos(ao) + Q_f cos(af), axially Q_o sin(ao) = Q_i sin(ai) + Q_f sin(af).
    Without F_c, Q_i/Q_o = sin(ao + af)/sin(ai + af) and Q_f/Q_o = sin(ao - ai)/sin(ai + af).
    """
    shared = math.sin(cone_angle + rib_angle)
    cone_load = (cup_load * math.sin(cup_angle + rib_angle) - centrifugal * math.sin(rib_angle)) / shared
    rib_load = (cup_load * math.sin(cup_angle - cone_angle) + centrifugal * math.sin(cone_angle)) / shared
    return cone_load, rib_load


def centrifugal_cup_load(centrifugal: float, cup_angle: float, rib_angle: float) -> float:
    """Compute the cup load of a roller that the cone does not press, F_c sin(af)/sin(ao + af), [N]."""
    return centrifugal * math.sin(rib_angle) / math.sin(cup_angle + rib_angle)
