"""Rollers of the fast tiers that slide along the cup: parameters from the traction law, and what they damp.

The rib keeps a roller with the cone, so that the cup slides along it where the rings move against each other
along the cup's line of contact: mostly axially. Rolling contacts resist in proportion to that slip, as long
as it is small against the slip at which their traction saturates. Resistance over slip is the scene's
traction law at no slip, which depends on load and rolling speed.

Neglected: the limit of traction, slip on the cone, and that a roller which is about to slide
circumferentially resists less.

References
----------
Johnson and Tevaarwerk (1977): traction in proportion to small slip.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.contact_output import store_vector
from beardyn_core.physics.bodies.rigid_bodies import row_totals
from beardyn_core.physics.lamina_table import lamina_table
from beardyn_core.physics.lanes.lane_math import at_least, at_most, exp2, log2
from beardyn_core.physics.roller_spring import place_on_cup
from beardyn_core.physics.tiers.kinematic_rings import SLIDING, row_times, sum_matrix
from beardyn_core.physics.traction import TractionLaws, lamina_friction, rolling_lamina, traction_laws
from beardyn_core.scene.scene import Scene

# Sums of the creep of the rollers, times cosine and sine of the pocket angle.
CREEP_SUM, CREEP_FIRST, CREEP_SECOND, CREEP_CC, CREEP_SS, CREEP_CS = range(
    layout.REACTION + 24, layout.REACTION + 30
)
# Where the law is fitted; beyond, the bounds count.
_LOADS = (200.0, 30e3)  # of a roller [N]
_SPEEDS = (0.5, 8.0)  # of rolling [m/s]
_POINTS = 13
_SLIP = 1e-6  # slip that is none, over rolling speed
_LEAST_CREEP = 1e-3  # over the largest one; where films without friction carry all load it would be 0


class SlideParams(NamedTuple):
    """Creep of a roller along the cup: its binary logarithm over those of load and rolling speed."""

    level: float  # [log2 s/m]
    by_load: float
    by_speed: float
    load_squared: float
    both: float
    speed_squared: float
    lever: float  # arm of the cup's line of contact about the bearing centre [m]


def creep_over_load(scene: Scene, load: float, speed: float) -> float:
    """Evaluate the scene's traction law at next to no slip, as the full tier does, [s/m].

    Parameters
    ----------
    load : float
        Of a roller on the cup, shared evenly by its laminae, [N].
    speed : float
        Of rolling, [m/s].

    Returns
    -------
    float
        Friction over slip speed and load, of the middle lamina.
    """
    laws, laminae = traction_laws(scene), lamina_table(scene)
    return _creep_over_load(laws, laminae, load / scene.numerics.laminae, speed)


def _creep_over_load(laws: TractionLaws, laminae: Float, load: float, speed: float) -> float:
    contact = rolling_lamina(load, speed, _SLIP * speed, layout.CUP, laws, laminae)
    return float(lamina_friction(contact, laws)) / load


def slide_params(scene: Scene) -> SlideParams | None:
    """Fit the creep along the cup of films that shear; ``None`` where nothing resists so little slip."""
    laws, laminae = traction_laws(scene), lamina_table(scene)
    if laws.film is None or scene.effects.traction is None:
        return None
    load, speed = (np.geomspace(*bounds, _POINTS) for bounds in (_LOADS, _SPEEDS))
    share = 1.0 / scene.numerics.laminae
    creep = np.array([[_creep_over_load(laws, laminae, share * q, v) for v in speed] for q in load]).ravel()
    if creep.max() <= 0.0:  # a law may have no friction up to some slip
        return None
    creep = np.maximum(creep, _LEAST_CREEP * creep.max())
    x, y = (axis.ravel() for axis in np.meshgrid(np.log2(load), np.log2(speed), indexing="ij"))
    terms = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=1)
    found = np.linalg.lstsq(terms, np.log2(creep), rcond=None)[0]
    angle = scene.bearing.cup_slant
    radial, axial = place_on_cup(scene.bearing)
    level, by_load, by_speed, load_squared, both, speed_squared = found.tolist()
    lever = axial * math.sin(angle) - radial * math.cos(angle)
    return SlideParams(level, by_load, by_speed, load_squared, both, speed_squared, lever)


def along_both(slide: SlideParams | None) -> SlideParams | None:
    """Halve the creep: a cylinder that floats slides along both raceways, half of what the rings do each."""
    return None if slide is None else slide._replace(level=slide.level - 1.0)


@inline
def rolling_level(speed, slide):
    """Take the binary logarithm of a rolling speed [m/s] within the bounds of the fit; 0 without sliding."""
    if slide is None:
        return 0.0
    return log2(at_most(at_least(abs(speed), _SPEEDS[0]), _SPEEDS[1]))


@inline
def creep_of(load, level, slide):
    """Work out the resistance of rollers to slip along the cup, [N s/m].

    ``load``: on the cup [N]; ``level``: of `rolling_level`.
    """
    if slide is None:
        return load
    x = log2(at_most(at_least(load, _LOADS[0]), _LOADS[1]))
    by_load = x * (slide.by_load + slide.load_squared * x + slide.both * level)
    return load * exp2(slide.level + by_load + level * (slide.by_speed + slide.speed_squared * level))


@inline
def store_creep(lanes, sums, creep, slide):
    """Keep the sums of `kinematic_rings.add_stiffness` with the creep in place of the stiffness."""
    if slide is None:
        return
    store_vector(lanes, sums, 0, CREEP_SUM, creep)
    store_vector(lanes, sums, 0, CREEP_CC, creep[3:])


@inline
def hold_sliding(sums, direction, work, p, slide):
    """Work out what rollers that slide along the cup damp motion of the rings with, and keep it until due.

    Written: the damping against velocity and tilt rate of the cone, world axes, at ``SLIDING`` of the
    ``work``. Where a step could not bear it, it is less.
    """
    if slide is None:
        return
    plain_sum, with_c = row_totals(sums, CREEP_SUM), row_totals(sums, CREEP_FIRST)
    with_s = row_totals(sums, CREEP_SECOND)
    cc, ss, cs = row_totals(sums, CREEP_CC), row_totals(sums, CREEP_SS), row_totals(sums, CREEP_CS)
    along = (p.base.cup.sine, -p.base.cup.cosine, slide.lever)
    sum_matrix(work, SLIDING, (plain_sum, with_c, with_s, cc, ss, cs), along, direction, p.sides)
    quickest = 0.0
    for i in range(5):
        for j in range(5):
            quickest += work[SLIDING, i, j] * p.response.give[j, i]
    borne = 1.0 / (1.0 + 0.5 * p.step * quickest)
    for i in range(5):
        for j in range(5):
            work[SLIDING, i, j] *= borne


@inline
def add_sliding(wrench, motion, work, slide):
    """Add to the wrench on the cup what `hold_sliding` gives at the motion of the cone against it."""
    if slide is None:
        return wrench
    rates = (motion[0][1], motion[1][1], motion[2][1], motion[3][1], motion[4][1])
    return (
        wrench[0] + row_times(work, SLIDING, 0, rates),
        wrench[1] + row_times(work, SLIDING, 1, rates),
        wrench[2] + row_times(work, SLIDING, 2, rates),
        wrench[3] + row_times(work, SLIDING, 3, rates),
        wrench[4],
        wrench[5] + row_times(work, SLIDING, 4, rates),
    )
