"""Kernel parameters of patches and waviness."""

from __future__ import annotations

from typing import Any, NamedTuple

# fields of a patch, and of a spring (a lamina, or the sound or damaged part of one)
PLACE_AZIMUTH, PLACE_REPEATS, PLACE_RADIUS, PLACE_ARC_RADIUS, PLACE_REACH, PLACE_SCALE = range(6)


PATCH_FIELDS = 6


PATCH_POINTS = 258  # of a path: 256 cells and one point beyond


SPRING_SHARE, SPRING_GAP, SPRING_RING_SLOPE, SPRING_ROLLER_SLOPE = range(4)


SPRING_FIELDS = 4


class SurfaceParams(NamedTuple):
    """Patches of one surface."""

    places: Any  # [patch, PATCH_FIELDS]: centre [rad], repeats a turn, radius [m], radius by repeats, reach
    present: Any  # [block, patch, lane], 1 where the lane's roller meets the patch
    cover: Any  # [patch, lamina], share of the lamina's length
    paths: Any  # [patch x lamina x PATCH_POINTS], gap over even arcs from the centre to the reach [m]


class DamageParams(NamedTuple):
    """Springs of a contact near a patch: sound parts of all laminae, then their damaged parts."""

    laminae: Any  # the lamina table twice over [row of the table, 2 x lamina]
    springs: Any  # work space [1, spring x SPRING_FIELDS, lane]


class WaveParams(NamedTuple):
    """Waviness of one surface; a row of the table is one turn and two points more."""

    table: Any  # flat [m]
    first: Any  # [block, 1, lane], where the lane's row of the table begins
    points: float  # of one turn


class FaultParams(NamedTuple):
    """Faults; ``None`` is absent."""

    cup: SurfaceParams | None
    cone: SurfaceParams | None
    roller: SurfaceParams | None
    cup_damage: DamageParams | None  # present with any patch of cup or rollers
    cone_damage: DamageParams | None
    cup_waves: WaveParams | None
    cone_waves: WaveParams | None
    roller_waves: WaveParams | None
    pockets: Any  # half of the added clearance [block, 1, lane], [m]
