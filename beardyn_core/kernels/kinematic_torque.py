"""Torque on the shaft of rollers in pure rolling: every loss as lost power over shaft speed.

The tiers without roller dynamics know where every contact is and how fast it rolls and slides; the laws are
those of the full tier. Evaluated 400 times a second and held in between: loads of single rollers change
slowly, and the rib's share follows the sum of the rib loads at every step.
"""

from __future__ import annotations

import math

from beardyn_core.jit import inline
from beardyn_core.kernels.drag import churning_rate
from beardyn_core.kernels.kinematic_rollers import TORQUE_RIB, TORQUE_ROLLING, lane_total
from beardyn_core.kernels.lane_math import at_least, exp2, log2
from beardyn_core.kernels.rib import rib_friction, rib_log2_film, spin_reach, with_spin
from beardyn_core.kernels.rolling import rolling_couple
from beardyn_core.model.layout import CONE, CUP

_SMALLEST_LOAD = 1e-3


@inline
def rolling_torque(loads, speeds, k, rolling):
    """Work out the rolling resistance's torque of a block of rollers, along the shaft's rotation, [N m].

    References
    ----------
    Zhao et al. (2026), see `integrate.torque`: T = sum (R_o M_i + R_i M_o) / D.
    """
    if rolling is None:
        return 0.0 * loads[0]
    cup = rolling_couple(loads[0], speeds[1] * k.cup_radius, CUP, rolling)
    cone = rolling_couple(loads[1], (speeds[0] - speeds[1]) * k.cone_radius, CONE, rolling)
    on_cup = smooth_lever(k.rolling_on_cup, speeds[0], rolling.regularisation[CUP])
    return on_cup * cup + smooth_lever(k.rolling_on_cone, speeds[0], rolling.regularisation[CONE]) * cone


@inline
def smooth_lever(lever, speed, floor):
    """Smooth the lever of a couple against a rotation at `lever` times the shaft's speed at standstill."""
    rate = lever * speed
    return lever * rate / math.sqrt(rate * rate + floor * floor)


@inline
def sliding_torque(load, speeds, p, rib):
    """Work out the torque of large ends that slide on their ribs, along the shaft's rotation, [N m].

    The contact is taken in the roller's meridian plane at its nominal height.
    """
    if rib is None:
        return 0.0 * load
    k = p.kinematic
    slip = k.rib_slip * speeds[0]
    radius = k.radius + rib.sphere_place * k.axis_radial + rib.sphere_radius * rib.normal_radial
    entrainment = (speeds[0] - speeds[1]) * radius - 0.5 * slip
    # load = K depth^1.5
    root = exp2((1.0 / 3.0) * log2(at_least(load, _SMALLEST_LOAD) * (1.0 / rib.stiffness)))
    along = p.base.cone.sine * rib.normal_radial + p.base.cone.cosine * rib.normal_axial
    spin = k.rib_spin * along * speeds[0]
    squared = with_spin(slip * slip, spin_reach(root * root, rib.drilling), spin, rib.drilling)
    log2_film = rib_log2_film(load, entrainment, rib.film)
    friction = rib_friction(load, root, squared, log2_film, rib, rib.film)
    return friction * squared_over(squared, speeds[0])


@inline
def squared_over(squared, speed):
    """Divide squared slip by the shaft speed; zero at rest."""
    return squared * (speed / (speed * speed + 1e-12))


@inline
def drag_torque(speeds, k, drag):
    """Work out the torque of the drag on all rollers, along the shaft's rotation, [N m]."""
    if drag is None:
        return 0.0
    flow, spin = speeds[1] * k.radius, speeds[1] * (k.spin_ratio + k.axis_axial)
    power = drag.orbit * math.fabs(flow) * flow * flow + churning_rate(spin, drag) * spin * spin
    return squared_over(k.rolling_count * power, speeds[0])


@inline
def seal_torque(speed, seal):
    """Work out the torque of both seals, along the shaft's rotation, [N m]."""
    if seal is None:
        return 0.0
    dry = seal.torque / math.sqrt(speed * speed + seal.regularisation * seal.regularisation)
    return (dry + seal.speed_coefficient) * speed


@inline
def held_losses(sums, speeds, rib_load, p):
    """Work out the torque of all but the ribs [N m], and that of the ribs over the sum of their loads [m]."""
    effects, k = p.base.effects, p.kinematic
    steady = drag_torque(speeds, k, effects.drag) + seal_torque(speeds[0], effects.seal)
    rib = lane_total(sums, TORQUE_RIB) / max(rib_load, _SMALLEST_LOAD)
    return steady + lane_total(sums, TORQUE_ROLLING), rib
