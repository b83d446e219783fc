"""Waviness under rollers that orbit kinematically: tables as these meet it, one place in them for all."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.arrangement import aligned_zeros
from beardyn_core.physics.bodies.layout import POCKET_ANGLE
from beardyn_core.physics.defect import FaultParams
from beardyn_core.physics.lanes.lane_math import floor, where_greater
from beardyn_core.physics.lanes.lane_tables import prefetch
from beardyn_core.physics.waviness import WaveParams
from beardyn_core.scene.patch import Patch

# A finer table fits no cache. Waves of more than 256 a turn have fewer points each than in the other tiers:
# linear interpolation takes 2 % off those of 1000 a turn, which strike at 8 kHz at 200 km/h.
MOST_POINTS = 16_384
_PER_TURN = 0.15915494309189535


class RollingWaveParams(NamedTuple):
    """Gaps of waviness over the angle that all rollers turn by together, or ``None``.

    Tables [point, block, lane] of one turn and two points more [m]: what a step needs of all rollers stands
    in two rows next to each other, while a table of the surface has it in a place of its own for each roller.
    """

    cup: Any  # over the turn of the cages
    cone: Any  # over that of the cages against the cone, times its share of a gap
    roller: Any  # over that of the rollers backwards: gaps on the cup and, half a turn on, on the cone


def rolling_wave_params(faults: FaultParams, rollers: Float, cone_share: float) -> RollingWaveParams | None:
    """Tabulate the waviness of a bearing for its rollers; ``None`` without any.

    Parameters
    ----------
    rollers : array, shape [block, field, lane]
        Constants of the rollers.
    cone_share : float
        What a gap on the cone takes off the approach over what the same gap on the cup takes.

    Notes
    -----
    The tables are turned by Fourier's theorem, so they have the points of the waves themselves.
    """
    waves = faults.cup_waves, faults.cone_waves, faults.roller_waves
    if all(each is None for each in waves):
        return None
    pockets = rollers[:, POCKET_ANGLE]
    cup, cone, roller = waves
    return RollingWaveParams(
        None if cup is None else _seen_from(cup, pockets, 1.0, 0.0),
        None if cone is None else _seen_from(cone, pockets, cone_share, 0.0),
        None if roller is None else _seen_from(roller, np.zeros_like(pockets), 1.0, cone_share),
    )


def highest_wave(faults: FaultParams) -> float:
    """Bound how much nearer the waves of cone and rollers bring these to each other, [m]."""
    gaps = [
        np.abs(waves.table).max() for waves in (faults.cone_waves, faults.roller_waves) if waves is not None
    ]
    return float(sum(gaps))


def highest_points(faults: FaultParams, patches: Sequence[Patch]) -> float:
    """Bound how much nearer waves and rims bring cup and cone to each other over a roller, [m].

    A roller has its own on both sides. Next to a soft edge on the other ring a rim counts up to twice.
    """
    waves = faults.cup_waves, faults.cone_waves, faults.roller_waves, faults.roller_waves
    rims = sum(2.0 * patch.rim_height * (2.0 if patch.on == "roller" else 1.0) for patch in patches)
    return float(sum(np.abs(each.table).max() for each in waves if each is not None)) + rims


def _seen_from(waves: WaveParams, ahead: Float, here: float, opposite: float) -> Float:
    """Tabulate ``here`` times the gap ``ahead`` [block, lane] and ``opposite`` times that half a turn on."""
    length = int(waves.points) + 2
    lines = np.fft.rfft(waves.table.reshape(-1, length)[:, :-2])
    points = min(length - 2, MOST_POINTS)
    orders = np.arange(points // 2 + 1)
    share = (points / (length - 2)) * (here + opposite * (1.0 - 2.0 * (orders % 2)))
    table = aligned_zeros(points + 2, *ahead.shape)
    surface = (waves.first[:, 0] / length).astype(int)
    for block, lane in np.ndindex(*ahead.shape):
        turned = lines[surface[block, lane], : len(orders)] * share * np.exp(1j * orders * ahead[block, lane])
        table[:, block, lane] = np.resize(np.fft.irfft(turned, points), points + 2)
    return table


@inline
def wave_places(turns, waves):
    """Find where all rollers stand in the tables: on cup, cone and themselves; see `place_in`."""
    if waves is None:
        return (0, 0.0), (0, 0.0), (0, 0.0)
    return (
        place_in(turns[0], waves.cup),
        place_in(turns[0] - turns[1], waves.cone),
        place_in(-turns[2], waves.roller),
    )


@inline
def place_in(angle, table):
    """Find the row of a table that an angle is at or behind, and the part of the way to the next."""
    if table is None:
        return 0, 0.0
    points = table.shape[0] - 2
    turns = angle * _PER_TURN
    position = (turns - floor(turns)) * points
    row = min(
        int(where_greater(position, 0.0, position, 0.0)), points
    )  # within the table, whatever the angle
    return row, position - row


@inline
def fetch_waves(lanes, block, ahead, waves):
    """Prefetch what the tables have of a block some steps `ahead`, at places of `wave_places`.

    No near cache holds them.
    """
    if waves is None:
        return
    _fetch(lanes, block, ahead[0], waves.cup)
    _fetch(lanes, block, ahead[1], waves.cone)
    _fetch(lanes, block, ahead[2], waves.roller)


@inline
def _fetch(lanes, block, place, table):
    if table is None:
        return
    prefetch(lanes, table, place[0], block)
    prefetch(lanes, table, place[0] + 1, block)


@inline
def subtract_waviness(lanes, block, approach, places, waves):
    """Take the gaps of waviness off the approach of a block of rollers, [m]."""
    if waves is None:
        return approach
    approach = _less_gap(lanes, block, approach, places[0], waves.cup)
    approach = _less_gap(lanes, block, approach, places[1], waves.cone)
    return _less_gap(lanes, block, approach, places[2], waves.roller)


@inline
def _less_gap(lanes, block, approach, place, table):
    if table is None:
        return approach
    row, part = place
    low = lanes.load(table, row, block)
    return approach - (low + part * (lanes.load(table, row + 1, block) - low))
