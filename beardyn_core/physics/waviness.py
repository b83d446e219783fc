"""Waviness: its tables, the gap it makes, and the force that a sloping gap has along the surface."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.generator_line import with_approach
from beardyn_core.physics.lanes.lane_math import floor, magnitude
from beardyn_core.physics.lanes.lane_tables import gather_pair
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.lanes.vectors import Wrench, add_wrenches, scale
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.waviness import Waviness

_PER_TURN = 0.15915494309189535


class WaveParams(NamedTuple):
    """Waviness of one surface; a row of the table is one turn and two points more."""

    table: Any  # flat [m]
    first: Any  # [block, 1, lane], where the lane's row of the table begins
    points: float  # of one turn


POINTS_PER_WAVE = 64  # linear interpolation is then good to 0.12 % of the amplitude of the shortest wave
# ... and to 8 % where scatter makes it: there it is a hundredth of the longest or less
POINTS_PER_SCATTERED_WAVE = 8


def wave_params(scene: Scene, on: str, arrangement: Arrangement) -> WaveParams | None:
    """Tabulate the waviness of one surface over a period per row or roller; ``None`` without any."""
    waves = [wave for wave in scene.waves if wave.on == on]
    if not waves:
        return None
    shortest = [
        max(wave.orders) * (POINTS_PER_WAVE if wave in scene.waviness else POINTS_PER_SCATTERED_WAVE)
        for wave in waves
    ]
    points = max(1024, *shortest)
    count = arrangement.roller_count if on == "roller" else 1
    tables = np.zeros((2, count, points + 2))
    for wave in waves:
        for roller in range(count):
            if wave.roller is None or on != "roller" or wave.roller == roller:
                tables[wave.row, roller] += np.resize(_one_turn(wave, roller, points), points + 2)
    first = np.arange(2 * count, dtype=float).reshape(2, count) * (points + 2)
    start = arrangement.to_lanes(np.broadcast_to(first, (2, arrangement.roller_count)))
    return WaveParams(tables.reshape(-1), np.ascontiguousarray(start[:, None, :]), float(points))


def _one_turn(wave: Waviness, roller: int, points: int) -> Float:
    """Compute `Waviness.gap` at points around the body by a Fourier transform, shape [point], [m]."""
    lines = np.zeros(points // 2 + 1, np.complex128)
    np.add.at(lines, list(wave.orders), np.array(wave.amplitudes) * np.exp(1j * wave.phases(roller)))
    return np.fft.irfft(0.5 * points * lines, points)


@inline
def wave_gap(lanes, block, azimuth, waves):
    """Look up the gap of one surface's waviness [m] and its slope over the azimuth [m/rad].

    ``azimuth``: of the contact in the surface's frame [rad].

    Linear between the points of a periodic table, so that the cost does not depend on the orders. Neglects
    changes along the generator line and the width of the contact, which smooths waves shorter than it.
    """
    if waves is None:
        return 0.0, 0.0
    turns = azimuth * _PER_TURN
    position = (turns - floor(turns)) * waves.points
    cell = floor(position)
    index = cell + lanes.load(waves.first, block, 0)
    low, high = gather_pair(lanes, waves.table, index)
    rise = high - low
    return low + (position - cell) * rise, rise * (waves.points * _PER_TURN)


@inline
def shift_line(line, gap):
    """Take a gap off the approach of a contact line."""
    a = line.approach
    approach = (a[0] - gap, a[1], a[2], a[3])
    return with_approach(line, approach)


@inline
def crown_bend(lanes, block, crowns):
    """Work out the factor of x^2 that the error of each roller's profile adds to the approach, [1/m]."""
    if crowns is None:
        return 0.0
    return -lanes.load(crowns, block, 0)


@inline
def bend_line(line, bend, crowns):
    """Add to the approach of a contact line what `crown_bend` found.

    Neglects how far the centre of mass, from where the abscissa counts, is off mid-length.
    """
    if crowns is None:
        return line
    a = line.approach
    approach = (a[0], a[1], a[2] + bend, a[3])
    return with_approach(line, approach)


@inline
def lean_wrench(lanes, body, sums, climbs, damage, waves, roller_waves):
    """Work out the `Wrench` on the roller where the normal leans with a sloping gap.

    The gap depends on the azimuths of the roller's orbit and spin: the force normal to the sloping surface
    has a part along the orbit when the slope is the ring's, and a moment about the roller axis when it is the
    roller's. A smooth ring feels no torque from the latter. Of waviness only the elastic force leans.

    ``climbs`` (2 numbers): slope of the waviness of ring and roller over the azimuth [m/rad]; ``damage``,
    ``waves``, ``roller_waves``: without any of them the normal cannot lean.
    """
    zero = lanes.constant(0.0)
    level = (zero, zero, zero)
    if damage is None and waves is None and roller_waves is None:
        return Wrench(level, level)
    along, moment = level, level
    force, lean = sums.force[0], sums.lean
    ring_lean = lean[0] + force * climbs[0]
    roller_lean = lean[1] + force * climbs[1]
    if any_positive(magnitude(ring_lean) + magnitude(roller_lean)):
        leaning = _leaning(ring_lean, roller_lean, body)
        along, moment = leaning.force, leaning.moment
    return Wrench(along, moment)


@inline
def _leaning(ring_lean, roller_lean, body):
    """Turn force times slope into a `Wrench`; the contact's azimuth in the roller falls with the spin."""
    around = (ring_lean + roller_lean * body.axis[2]) / body.place[0]
    return Wrench((0.0 * around, around, 0.0 * around), scale(-roller_lean, body.axis))


@inline
def add_leaning_change(wrench, gap, d_rate, time, body, damage):
    """Add what the leaning normal of springs near a patch gains over the step with their implicit force.

    ``gap``: `GapSums`; ``d_rate`` (2 numbers): change of the approach rate, affine in the
    abscissa [m/s]; ``time``: over which springs and dampers are implicit [s].
    """
    if damage is None:
        return wrench
    ring = time * (gap.ring[0] * d_rate[0] + gap.ring[1] * d_rate[1])
    roller = time * (gap.roller[0] * d_rate[0] + gap.roller[1] * d_rate[1])
    return add_wrenches(wrench, _leaning(ring, roller, body))


@inline
def add_leaning(wrench, lean):
    """Add the wrench of sloping gaps to that of a contact."""
    return add_wrenches(wrench, lean)
