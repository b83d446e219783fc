"""Closed forms of the raceway contact against a search of the rim."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from evidence.validation.anchor import Anchor
from test.kernels import naive
from test.kernels.naive_traction import SIDES
from test.kernels.states import only
from test.kernels.test_raceway import brute_force_gap, contacts, motions, parameters

DERIVED = "derived: 0.07 nm in one pass, 0.002 nm in two"


def closed_form_error(side: str, passes: int) -> float:
    """Return the largest error of a disc's depth at 1 deg of skew and 0.5 deg of tilt, 120 discs, nm."""
    p = parameters()
    raceway = getattr(p, side)
    worst = 0.0
    for motion in motions(side, 40, 1, skew=math.radians(1.0), tilt=math.radians(0.5), moving=False):
        for x in (-0.025, 0.0, 0.025):
            disc = motion.centre + x * motion.axis
            radius = p.roller.radius + x * p.roller.taper
            where = (disc, motion.axis, radius, motion.ring_axis, p.roller.apex, raceway)
            point = naive.closed_form_point(*where, passes=passes)
            found = naive.cone_field(point, motion.ring_axis, p.roller.apex, raceway)
            worst = max(worst, abs(found - naive.deepest_rim_point(*where)[0]))
    return 1e9 * worst


def kernel_error(side: str) -> float:
    """Return the same of the kernel's approach at the roller's centre of mass, nm."""
    p = only(parameters())
    cases = motions(side, 40, 2, skew=math.radians(1.0), tilt=math.radians(0.5), moving=False)
    found = contacts(side, cases, p)[:, 7]
    exact = [brute_force_gap(motion, 0.0, side, p) for motion in cases]
    return 1e9 * float(np.abs(found - exact).max())


ANCHORS = (
    *(
        Anchor(
            "contact point",
            f"disc on the {side} at 1 deg of skew, closed form in {passes} {times}, against a search",
            0.0,
            "nm",
            DERIVED,
            partial(closed_form_error, side, passes),
            absolute=limit,
        )
        for side in SIDES
        for passes, times, limit in ((1, "pass", 0.07), (2, "passes", 0.002))
    ),
    *(
        Anchor(
            "contact point",
            f"the kernel's approach on the {side} at 1 deg of skew, against a search",
            0.0,
            "nm",
            "derived, one pass",
            partial(kernel_error, side),
            absolute=0.07,
        )
        for side in SIDES
    ),
)
