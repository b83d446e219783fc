"""Waviness under rollers that orbit kinematically: one place in a table for all of them."""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.physics.lanes.lane_math import floor, where_greater
from beardyn_core.physics.lanes.lane_tables import prefetch

_PER_TURN = 0.15915494309189535


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
def fetch_waves(lanes, blocks, ahead, waves):
    """Ask for what the tables have some steps `ahead`, at places of `wave_places`: no near cache holds it."""
    if waves is None:
        return
    _fetch(lanes, blocks, ahead[0], waves.cup)
    _fetch(lanes, blocks, ahead[1], waves.cone)


@inline
def _fetch(lanes, blocks, place, table):
    if table is None:
        return
    for block in range(blocks):
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
