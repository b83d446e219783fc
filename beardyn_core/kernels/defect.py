"""Patches of raceways and rollers as gaps under the laminae, soft at sharp edges.

Far from every patch a contact costs one distance a patch. Near one, each lamina becomes two springs, its
sound and its damaged part, the damaged one with the gap from the path of the roller over the patch. Near a
sharp edge it is softer than a sound one; what it presses with is the slope of its energy over the depth, and
what it leans with that over the arc.
"""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.kernels.lane_math import at_least, at_most, floor, magnitude, where_greater, wrap
from beardyn_core.kernels.lanes import any_positive
from beardyn_core.model import layout

_LAST = layout.PATCH_POINTS - 2.0
_SPRINGS = 0  # the work space has one page
# of a contact, by which softness counts beside a gap where several patches meet [m]
_USUAL_DEPTH = 5e-6
# an energy goes with the 19/9th power of the depth, its force with the 10/9th
_ENERGY = 9.0 / 19.0


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
    (by sink) and the mean gap and softness of the lamina kept.
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
    one = lanes.constant(1.0)
    for k in range(count):
        sound, damaged = layout.SPRING_FIELDS * k, layout.SPRING_FIELDS * (count + k)
        first = lanes.load(springs, _SPRINGS, damaged + layout.SPRING_SHARE)
        second = lanes.load(springs, _SPRINGS, sound + layout.SPRING_SHARE)
        share = first / at_least(second, 1e-30)
        weight = 1.0 / at_least(share, 1e-12)
        lanes.store(springs, _SPRINGS, sound + layout.SPRING_SHARE, 1.0 - share)
        lanes.store(springs, _SPRINGS, damaged + layout.SPRING_SHARE, share)
        for field in (layout.SPRING_GAP, layout.SPRING_RING_SLOPE, layout.SPRING_ROLLER_SLOPE):
            _scale(lanes, springs, damaged + field, weight)
        firmness = 1.0 / (1.0 + weight * lanes.load(springs, _SPRINGS, damaged + layout.SPRING_FIRMNESS))
        lanes.store(springs, _SPRINGS, damaged + layout.SPRING_FIRMNESS, firmness)
        lanes.store(springs, _SPRINGS, sound + layout.SPRING_FIRMNESS, one)
        for field in (layout.SPRING_RING_SOFTENING, layout.SPRING_ROLLER_SOFTENING):
            _scale(lanes, springs, damaged + field, _ENERGY * weight * firmness)
    return True


@inline
def add_patches(lanes, block, azimuth, count, slope_field, surface, springs):
    """Add the moments of the gaps of one surface's patches to the springs of a contact.

    Into the fields of the damaged spring go the sums of ``c w`` (share), ``c g`` (gap), ``c s`` (firmness),
    ``c dg/dtheta`` (slope) and ``c ds/dtheta`` (softening), c the cover, s the softness and w the sink
    ``|g|`` and s times a usual depth; into the share of the sound one that of w.
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
                firm = lanes.gather(surface.softness, cell + begin)
                soft = lanes.gather(surface.softness, cell + (begin + 1))
                softness = present * (firm + part * (soft - firm))
                cover = surface.cover[patch, k]
                sink = magnitude(gap) + _USUAL_DEPTH * softness
                _increase(lanes, springs, damaged + layout.SPRING_SHARE, cover * sink)
                _increase(lanes, springs, sound + layout.SPRING_SHARE, sink)
                _increase(lanes, springs, damaged + layout.SPRING_GAP, cover * gap)
                _increase(lanes, springs, damaged + layout.SPRING_FIRMNESS, cover * softness)
                _increase(lanes, springs, damaged + slope_field, cover * climb * (high - low))
                _increase(lanes, springs, damaged + slope_field + 1, cover * climb * (soft - firm))


@inline
def _increase(lanes, springs, field, value):
    lanes.store(springs, _SPRINGS, field, lanes.load(springs, _SPRINGS, field) + value)


@inline
def _scale(lanes, springs, field, factor):
    lanes.store(springs, _SPRINGS, field, factor * lanes.load(springs, _SPRINGS, field))


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
def soften(lanes, tangent, spring, damage):
    """Take off a stiffness what the edges of patches give way under a spring."""
    if damage is None:
        return tangent
    return tangent * lanes.load(
        damage.springs, _SPRINGS, layout.SPRING_FIELDS * spring + layout.SPRING_FIRMNESS
    )


@inline
def gap_moments(lanes, near, lamina, count, damage):
    """Work out the share of a lamina under a patch, the share of its stiffness lost, and the gap that counts.

    Shares of the lamina [-]; the gap times the share and its firmness [m].
    """
    zero = lanes.constant(0.0)
    if damage is None:
        return zero, zero, zero
    if near:
        field = layout.SPRING_FIELDS * (count + lamina)
        gap = lanes.load(damage.springs, _SPRINGS, field + layout.SPRING_GAP)
        share = lanes.load(damage.springs, _SPRINGS, field + layout.SPRING_SHARE)
        firm = share * lanes.load(damage.springs, _SPRINGS, field + layout.SPRING_FIRMNESS)
        return share, share - firm, firm * gap
    return zero, zero, zero


@inline
def spring_slopes(lanes, spring, depth, damage):
    """Work out how far a spring near a patch gives way with the ring's and the roller's azimuth, [m/rad].

    That is the slope of its gap, and where its firmness changes what its force wants for the energy at a
    ``depth`` [m], not negative, to go with it.
    """
    springs, field = damage.springs, layout.SPRING_FIELDS * spring
    ring = lanes.load(springs, _SPRINGS, field + layout.SPRING_RING_SLOPE)
    roller = lanes.load(springs, _SPRINGS, field + layout.SPRING_ROLLER_SLOPE)
    ring = ring + depth * lanes.load(springs, _SPRINGS, field + layout.SPRING_RING_SOFTENING)
    return ring, roller + depth * lanes.load(springs, _SPRINGS, field + layout.SPRING_ROLLER_SOFTENING)


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
