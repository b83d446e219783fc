"""Pockets of the cheaper cages: two touches instead of five, along the pitch circle only."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import cos_sin, magnitude, where_greater
from beardyn_core.kernels.pocket import add_touch, touch_wall, wall_slip
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, scale, subtract


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
    small_arm = add_scaled(scale(small_place, axis), small_radius, small_normal)
    small = touch_wall(
        _untouched(offset), centre, small_arm, small_normal, magnitude(small_offset) - clearance, motion,
        cage, (axis, small_radius), None,
    )  # fmt: skip
    large_arm = add_scaled(scale(large_place, axis), large_radius, large_normal)
    both = touch_wall(
        small, centre, large_arm, large_normal, magnitude(large_offset) - clearance, motion, cage,
        (axis, large_radius), None,
    )  # fmt: skip
    slip_squared = _pair_slip_squared(centre, small_arm, large_arm, motion, small[0], both[0])
    bar = scale(
        where_greater(offset, 0.0, roller.radius + 0.0 * offset, -roller.radius + 0.0 * offset), ahead
    )
    return both, slip_squared, bar


@inline
def kinematic_pocket(
    centre: Any, axis: Any, motion: Any, advance: Any, tilt: Any, cage: Any, kinematic: Any
) -> Any:
    """Two weak springs with dampers that hold the roller's axis at its pocket's place, without play.

    They hold the skew too; arguments and results as `pocket_contact`.
    """
    ahead, offset, skew = _along_pitch_circle(centre, axis, advance, tilt)
    small_arm, large_arm = scale(-cage.bar_place, axis), scale(cage.bar_place, axis)
    small = _hold(
        _untouched(offset), centre, small_arm, ahead, offset - cage.bar_place * skew, motion, kinematic
    )
    both = _hold(small, centre, large_arm, ahead, offset + cage.bar_place * skew, motion, kinematic)
    slip_squared = _pair_slip_squared(centre, small_arm, large_arm, motion, small[0], both[0])
    return both, slip_squared, scale(0.0, ahead)


@inline
def _untouched(offset: Any) -> Any:
    """Sums over no walls; a NaN stays one."""
    zero = 0.0 * offset
    nothing = (zero, zero, zero)
    return nothing, nothing, zero, zero, nothing, nothing


@inline
def _pair_slip_squared(
    centre: Any, small_arm: Any, large_arm: Any, motion: Any, small_force: Any, both_force: Any
) -> Any:
    """Slip at the large end where more than half of the force is there, else at the small end, squared."""
    large_force = subtract(both_force, small_force)
    small_slip, large_slip = wall_slip(centre, small_arm, motion), wall_slip(centre, large_arm, motion)
    return where_greater(
        4.0 * dot(large_force, large_force),
        dot(both_force, both_force),
        dot(large_slip, large_slip),
        dot(small_slip, small_slip),
    )


@inline
def _along_pitch_circle(centre: Any, axis: Any, advance: Any, tilt: Any) -> Any:
    """Direction of growing azimuth at the pocket; offset of the roller along it, [m], and its skew."""
    cosine, sine = cos_sin(advance)
    ahead = (sine, cosine, 0.0 * sine)
    ahead = add(ahead, cross(tilt, ahead))
    return ahead, dot(ahead, centre), dot(ahead, axis)


@inline
def _hold(
    touches: Any, centre: Any, arm: Any, direction: Any, offset: Any, motion: Any, kinematic: Any
) -> Any:
    """Add one spring-damper that pulls as well as it pushes; results as `touch_wall`."""
    slip = wall_slip(centre, arm, motion)
    damper = kinematic.damping * dot(slip, direction)
    spring = kinematic.stiffness * offset
    force, lost = scale(-spring - damper, direction), scale(damper, direction)
    return add_touch(touches, arm, slip, force, lost, 0.5 * spring * offset)
