"""Pockets of the cheaper cages: two touches instead of five, along the pitch circle only."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import cos_sin, magnitude, where_greater
from beardyn_core.kernels.pocket import touch_loss, touch_wall, wall_slip
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, scale


@inline
def rotating_pocket(
    centre: Any, axis: Any, motion: Any, advance: Any, tilt: Any, wear: Any, roller: Any, cage: Any
) -> Any:
    """Contact with the nearer bar at both ends of the roller; arguments and results as `pocket_contact`.

    Without play there is no nearer bar; the side a roller is on then pushes it back, as both bars would.
    Neglects the lean of the bars, the lubricant, and the pocket ends.
    """
    ahead, offset, skew = _along_pitch_circle(centre, axis, advance, tilt)
    clearance = cage.half_clearance + wear
    small_place, large_place = -cage.bar_place, cage.bar_place
    small_offset = offset + small_place * skew
    large_offset = offset + large_place * skew
    small_side = where_greater(small_offset, 0.0, 1.0 + 0.0 * offset, -1.0 + 0.0 * offset)
    large_side = where_greater(large_offset, 0.0, 1.0 + 0.0 * offset, -1.0 + 0.0 * offset)
    small_radius = roller.radius + small_place * roller.taper
    large_radius = roller.radius + large_place * roller.taper
    small_normal, large_normal = scale(small_side, ahead), scale(large_side, ahead)
    small = touch_wall(
        centre, add_scaled(scale(small_place, axis), small_radius, small_normal), small_normal,
        magnitude(small_offset) - clearance, motion, cage, (axis, small_radius), None,
    )  # fmt: skip
    large = touch_wall(
        centre, add_scaled(scale(large_place, axis), large_radius, large_normal), large_normal,
        magnitude(large_offset) - clearance, motion, cage, (axis, large_radius), None,
    )  # fmt: skip
    bar = scale(
        where_greater(offset, 0.0, roller.radius + 0.0 * offset, -roller.radius + 0.0 * offset), ahead
    )
    return _as_five(small, large), bar


@inline
def kinematic_pocket(
    centre: Any, axis: Any, motion: Any, advance: Any, tilt: Any, cage: Any, kinematic: Any
) -> Any:
    """Two weak springs with dampers that hold the roller's axis at its pocket's place, without play.

    They hold the skew too; arguments and results as `pocket_contact`.
    """
    ahead, offset, skew = _along_pitch_circle(centre, axis, advance, tilt)
    small = _hold(
        centre, scale(-cage.bar_place, axis), ahead, offset - cage.bar_place * skew, motion, kinematic
    )
    large = _hold(
        centre, scale(cage.bar_place, axis), ahead, offset + cage.bar_place * skew, motion, kinematic
    )
    return _as_five(small, large), scale(0.0, ahead)


@inline
def _as_five(small: Any, large: Any) -> Any:
    """Both touches in the shape that `pocket_contact` gives; nobody looks at the other three."""
    return small, large, large, large, large


@inline
def _along_pitch_circle(centre: Any, axis: Any, advance: Any, tilt: Any) -> Any:
    """Direction of growing azimuth at the pocket; offset of the roller along it, [m], and its skew."""
    cosine, sine = cos_sin(advance)
    ahead = (sine, cosine, 0.0 * sine)
    ahead = add(ahead, cross(tilt, ahead))
    return ahead, dot(ahead, centre), dot(ahead, axis)


@inline
def _hold(centre: Any, arm: Any, direction: Any, offset: Any, motion: Any, kinematic: Any) -> Any:
    """One spring-damper that pulls as well as it pushes; results as `touch_wall`."""
    slip = wall_slip(centre, arm, motion)
    damper = kinematic.damping * dot(slip, direction)
    spring = kinematic.stiffness * offset
    return scale(-spring - damper, direction), arm, scale(damper, direction), slip, 0.5 * spring * offset


@inline
def pair_sum(touches: Any) -> Any:
    """Force, moment about the roller's centre of mass and elastic energy of both touches."""
    a, b, _, _, _ = touches
    return add(a[0], b[0]), add(cross(a[1], a[0]), cross(b[1], b[0])), a[4] + b[4]


@inline
def pair_loss(touches: Any, change: Any) -> Any:
    """Power lost at the middle of a step that changes the roller's velocities, [W]."""
    a, b, _, _, _ = touches
    return touch_loss(a, change) + touch_loss(b, change)
