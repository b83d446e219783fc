"""Waviness as a shift of the generator line, and the force that a sloping gap has along the surface."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import floor
from beardyn_core.kernels.vectors import add, scale

_PER_TURN = 0.15915494309189535


@inline
def wave_gap(lanes: Any, block: Any, azimuth: Any, waves: Any) -> Any:
    """Gap of one surface's waviness [m] and its slope over the azimuth [m/rad].

    Notes
    -----
    Linear between the points of a periodic table, so that the cost does not depend on the orders. Neglects
    changes along the generator line and the width of the contact, which smooths waves shorter than it.
    """
    if waves is None:
        return 0.0, 0.0
    turns = azimuth * _PER_TURN
    position = (turns - floor(turns)) * waves.points
    cell = floor(position)
    index = cell + lanes.load(waves.first, block, 0)
    low = lanes.gather(waves.table, index)
    rise = lanes.gather(waves.table, index + 1.0) - low
    return low + (position - cell) * rise, rise * (waves.points * _PER_TURN)


@inline
def wavy_line(line: Any, gap: Any) -> Any:
    """Generator line with its approach less a gap."""
    arm, arm_slope, normal, around, along, approach, bend = line
    approach = (approach[0] - gap, approach[1], approach[2], approach[3])
    return arm, arm_slope, normal, around, along, approach, bend


@inline
def leaning_wrench(place: Any, axis: Any, ring_lean: Any, roller_lean: Any) -> Any:
    """Force and moment on the roller where the normal leans with a sloping gap.

    The elastic energy depends on the gap and the gap on the azimuths of the roller's orbit and spin: the
    force normal to the sloping surface has a part along the orbit when the slope is the ring's, and a
    moment about the roller axis when it is the roller's. A smooth ring feels no torque from the latter.

    Parameters
    ----------
    place, axis : vector
        Of the roller.
    ring_lean, roller_lean : lane value
        Elastic force times slope of the gap over the azimuth in the ring and in the roller, [N m].
    """
    zero = 0.0 * place[0]
    moment = -roller_lean
    force = (zero, (ring_lean - moment * axis[2]) / place[0], zero)
    return force, scale(moment, axis)


@inline
def add_leaning(force: Any, moment: Any, lean: Any) -> Any:
    """Add the wrench of sloping gaps to that of a contact."""
    return add(force, lean[0]), add(moment, lean[1])
