"""The springs of a raceway contact: one for each lamina, two for a damaged one.

What a spring presses with, alone or with its neighbours, and how its gap slopes; the sums over the springs
are in `kernels.raceway`.
"""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.defect import spring_damage, spring_slopes
from beardyn_core.kernels.joint_lamina import joint_depth, joint_share, joint_slopes
from beardyn_core.kernels.lamina_coupling import DEPTH, FORCE, SURFACE, couple_laminae
from beardyn_core.kernels.lane_math import at_least, ninth_root, where_greater
from beardyn_core.model.contact_parameters import LAMINA_DROP, LAMINA_PLACE, LAMINA_STIFFNESS

SMALLEST_APPROACH = 1e-15
# A spring of less of its lamina is rounding of one that is not there.
SMALLEST_SHARE = 1e-6


@inline
def spring_push(approach: Any, rate: Any, damping: Any) -> Any:
    """What the tangent stiffness turns into force: 9/10 of the approach (10/9 law) plus damping, [m]."""
    if damping is None:
        return 0.9 * approach
    return 0.9 * approach + damping.time_constant * rate


@inline
def let_go(power: Any, whole: Any, elastic: Any, rate: Any, damping: Any, audit: Any) -> Any:
    """Add what the damper of one spring takes where the contact opens faster than the spring follows, [W].

    Parameters
    ----------
    power : lane value
        Sum so far, [W].
    whole, elastic : lane value
        Elastic force that belongs to the stored energy, and the part of it that is pressed with: all, or
        nothing where spring and damper together would pull, [N].
    rate : lane value
        Of the approach, [m/s].

    Notes
    -----
    A contact does not pull: the spring then expands against its own damper, and its energy ends there.
    """
    if damping is None:
        return power
    if audit is None:
        return power
    return power - (whole - elastic) * rate


@inline
def deepest_so_far(deepest: Any, share: Any, depth: Any, damage: Any) -> Any:
    """Largest penetration of the springs near a patch; a sound contact is measured at its middle, [m]."""
    if damage is None:
        return deepest
    return at_least(deepest, where_greater(share + 0.0 * depth, SMALLEST_SHARE, depth, 0.0 * depth))


@inline
def geometric_depth(approach: Any, gap: Any, k: Any, laminae: Any) -> Any:
    """Penetration of one lamina or spring, negative when apart, [m]."""
    x = laminae[LAMINA_PLACE, k]
    return (
        approach[0] + x * (approach[1] + x * (approach[2] + x * approach[3])) - laminae[LAMINA_DROP, k] - gap
    )


@inline
def prepare_coupling(lanes: Any, approach: Any, laminae: Any, damage: Any, coupling: Any) -> None:
    """Springs of all laminae at once, when they are coupled; one over the edge of a patch joins as one."""
    if coupling is None:
        return
    for k in range(laminae.shape[1]):
        depth = geometric_depth(approach, 0.0, k, laminae)
        depth = joint_depth(lanes, depth, k, laminae.shape[1], damage, coupling.part_exponent)
        lanes.store(coupling.work, DEPTH, k, depth)
    couple_laminae(lanes, laminae, coupling)


@inline
def contact_spring(lanes: Any, approach: Any, k: Any, laminae: Any, damage: Any, coupling: Any) -> Any:
    """Share of its lamina [-], penetration [m], tangent stiffness [N/m] and energy [J] of one spring.

    Force, stiffness and damping of the contact are those of the spring times its share.
    """
    if coupling is None:
        share, gap = spring_damage(lanes, k, damage)
        depth = geometric_depth(approach, gap, k, laminae)
        touching = at_least(depth, SMALLEST_APPROACH)
        tangent = (10.0 / 9.0) * laminae[LAMINA_STIFFNESS, k] * ninth_root(touching)
        tangent = where_greater(depth, 0.0, tangent, 0.0 * depth)
        return share, depth, tangent, share * tangent * touching * touching * (0.9 * 9.0 / 19.0)
    work = coupling.work
    share, energy = joint_share(lanes, k, damage), lanes.load(work, FORCE, k)
    return share, lanes.load(work, DEPTH, k) / share, lanes.load(work, SURFACE, k) * share, energy


@inline
def share_of(lanes: Any, k: Any, damage: Any, coupling: Any) -> Any:
    """Share of its lamina of a spring, [-]."""
    if coupling is None:
        return spring_damage(lanes, k, damage)[0]
    return joint_share(lanes, k, damage)


@inline
def add_lean(lanes: Any, lean: Any, elastic: Any, k: Any, count: Any, damage: Any, coupling: Any) -> Any:
    """Add elastic force times slope of a spring's gap over the azimuth in ring and roller, [N m]."""
    if damage is None:
        return lean
    ring_slope, roller_slope = slope_of(lanes, k, count, damage, coupling)
    return lean[0] + elastic * ring_slope, lean[1] + elastic * roller_slope


@inline
def slope_of(lanes: Any, k: Any, count: Any, damage: Any, coupling: Any) -> Any:
    """By how much a spring gives way with the azimuth in ring and in roller, [m/rad]."""
    if coupling is None:
        return spring_slopes(lanes, k, damage)
    return joint_slopes(lanes, k, count, damage)
