"""Patches of raceways and rollers as gaps under the laminae.

Far from every patch a contact costs one distance a patch. Near one, each lamina becomes two springs, its
sound and its damaged part, the damaged one with the gap from the path of the roller over the patch.
"""

from __future__ import annotations

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, at_most, floor, magnitude, where_greater, wrap
from beardyn_core.kernels.lanes import any_positive
from beardyn_core.model import layout

_LAST = layout.PATCH_POINTS - 2.0
_SPRINGS = 0  # the work space has one page


@inline
def patch_arc(azimuth, patch, surface):
    """Work out the arc from the nearest centre of a patch, [m]."""
    turn = surface.places[patch, layout.PLACE_REPEATS] * (
        azimuth - surface.places[patch, layout.PLACE_AZIMUTH]
    )
    return wrap(turn) * surface.places[patch, layout.PLACE_ARC_RADIUS]


@inline
def patch_nearness(lanes, block, azimuth, patch, surface):
    """Tell how far a roller is inside the reach of a patch; not positive where it does not feel it, [m]."""
    inside = surface.places[patch, layout.PLACE_REACH] - magnitude(patch_arc(azimuth, patch, surface))
    return lanes.load(surface.present, block, patch) * inside


@inline
def any_near(lanes, block, azimuth, surface):
    """Tell whether any lane is within the reach of any patch of a surface."""
    if surface is None:
        return False
    nearest = lanes.constant(0.0)
    for patch in range(surface.places.shape[0]):
        nearest = at_least(nearest, patch_nearness(lanes, block, azimuth, patch, surface))
    return any_positive(nearest)


@inline
def find_damage(lanes, block, azimuths, count, surfaces, damage):
    """Tell whether a contact is near a patch, and then work out the gaps of its springs.

    ``count``: of laminae; ``surfaces``: `SurfaceParams` of ring and roller, or ``None``.

    A patch that covers a part of a lamina leaves the rest as a spring of its own, so that forces are
    continuous in the place and length of a patch. Where several patches meet on one lamina their gaps add;
    when they cover different shares of it, one damaged spring stands for all of them, with the mean share
    (by gap) and the mean gap of the lamina kept.
    """
    if damage is None:
        return False
    if not (
        any_near(lanes, block, azimuths[0], surfaces[0]) or any_near(lanes, block, azimuths[1], surfaces[1])
    ):
        return False
    springs = damage.springs
    zero = lanes.constant(0.0)
    for field in range(layout.SPRING_FIELDS * 2 * count):
        lanes.store(springs, _SPRINGS, field, zero)
    add_patches(lanes, block, azimuths[0], count, layout.SPRING_RING_SLOPE, surfaces[0], springs)
    add_patches(lanes, block, azimuths[1], count, layout.SPRING_ROLLER_SLOPE, surfaces[1], springs)
    for k in range(count):
        sound, damaged = layout.SPRING_FIELDS * k, layout.SPRING_FIELDS * (count + k)
        first = lanes.load(springs, _SPRINGS, damaged + layout.SPRING_SHARE)
        second = lanes.load(springs, _SPRINGS, sound + layout.SPRING_SHARE)
        share = first / at_least(second, 1e-30)
        weight = 1.0 / at_least(share, 1e-12)
        lanes.store(springs, _SPRINGS, sound + layout.SPRING_SHARE, 1.0 - share)
        lanes.store(springs, _SPRINGS, damaged + layout.SPRING_SHARE, share)
        for field in (layout.SPRING_GAP, layout.SPRING_RING_SLOPE, layout.SPRING_ROLLER_SLOPE):
            mean = weight * lanes.load(springs, _SPRINGS, damaged + field)
            lanes.store(springs, _SPRINGS, damaged + field, mean)
    return True


@inline
def add_patches(lanes, block, azimuth, count, slope_field, surface, springs):
    """Add the moments of the gaps of one surface's patches to the springs of a contact.

    Into the fields of the damaged spring go the sums of ``c |g|`` (share), ``c g`` (gap) and ``c dg/dtheta``
    (slope), c the cover; into the share of the sound one that of ``|g|``.
    """
    if surface is None:
        return
    for patch in range(surface.places.shape[0]):
        if any_positive(patch_nearness(lanes, block, azimuth, patch, surface)):
            arc = patch_arc(azimuth, patch, surface)
            scale = surface.places[patch, layout.PLACE_SCALE]
            position = at_most(magnitude(arc) * scale, _LAST)
            cell = floor(position)
            part = position - cell
            present = lanes.load(surface.present, block, patch)
            climb = scale * surface.places[patch, layout.PLACE_RADIUS] * present
            climb = where_greater(arc, 0.0, climb, -climb)
            for k in range(count):
                sound, damaged = layout.SPRING_FIELDS * k, layout.SPRING_FIELDS * (count + k)
                begin = layout.PATCH_POINTS * (patch * count + k)
                low = lanes.gather(surface.paths, cell + begin)
                high = lanes.gather(surface.paths, cell + (begin + 1))
                gap = present * (low + part * (high - low))
                cover = surface.cover[patch, k]
                _increase(lanes, springs, damaged + layout.SPRING_SHARE, cover * magnitude(gap))
                _increase(lanes, springs, sound + layout.SPRING_SHARE, magnitude(gap))
                _increase(lanes, springs, damaged + layout.SPRING_GAP, cover * gap)
                _increase(lanes, springs, damaged + slope_field, cover * climb * (high - low))


@inline
def _increase(lanes, springs, field, value):
    lanes.store(springs, _SPRINGS, field, lanes.load(springs, _SPRINGS, field) + value)


@inline
def springs_of(laminae, damage, coupling):
    """Take the lamina table with a column for every spring, and how many springs a contact has.

    Near a patch two of each lamina; coupled laminae are not divided.
    """
    if damage is None:
        return laminae, laminae.shape[1]
    if coupling is None:
        return damage.laminae, 2 * laminae.shape[1]
    return damage.laminae, laminae.shape[1]


@inline
def spring_damage(lanes, spring, damage):
    """Share of its lamina [-] and gap [m] of a spring."""
    if damage is None:
        return 1.0, 0.0
    field = layout.SPRING_FIELDS * spring
    return (
        lanes.load(damage.springs, _SPRINGS, field + layout.SPRING_SHARE),
        lanes.load(damage.springs, _SPRINGS, field + layout.SPRING_GAP),
    )


@inline
def gap_moments(lanes, near, lamina, count, damage):
    """Work out the mean gap [m] and mean squared gap [m^2] along one lamina."""
    zero = lanes.constant(0.0)
    if damage is None:
        return zero, zero
    if near:
        field = layout.SPRING_FIELDS * (count + lamina)
        gap = lanes.load(damage.springs, _SPRINGS, field + layout.SPRING_GAP)
        mean = lanes.load(damage.springs, _SPRINGS, field + layout.SPRING_SHARE) * gap
        return mean, mean * gap
    return zero, zero


@inline
def spring_slopes(lanes, spring, damage):
    """Take the slope of a spring's gap near a patch over the ring's and the roller's azimuth, [m/rad]."""
    field = layout.SPRING_FIELDS * spring
    return (
        lanes.load(damage.springs, _SPRINGS, field + layout.SPRING_RING_SLOPE),
        lanes.load(damage.springs, _SPRINGS, field + layout.SPRING_ROLLER_SLOPE),
    )


@inline
def pocket_wear(lanes, block, pockets):
    """Work out the half of the clearance added to each roller's pocket along the pitch circle, [m]."""
    if pockets is None:
        return 0.0
    return lanes.load(pockets, block, 0)


@inline
def pocket_length(lanes, block, pockets):
    """Work out the half of the clearance added to each roller's pocket at its ends, [m]."""
    if pockets is None:
        return 0.0
    return lanes.load(pockets, block, 1)
