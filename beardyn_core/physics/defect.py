"""Patches, wear and size errors: their tables, the gaps they make, their growth between blocks.

Far from every patch a contact costs one distance a patch. Near one, each lamina becomes two springs, its
intact and its damaged part, the damaged one with the gap from the path of the roller over the patch. Near a
sharp edge it is softer than an intact one; what it presses with is the slope of its energy over the depth,
and what it leans with that over the arc.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.cage.pocket_wear import pocket_wear_of
from beardyn_core.physics.lamina_table import contact_radii, for_springs, surface_radius
from beardyn_core.physics.lanes.lane_math import at_least, at_most, floor, magnitude, where_greater, wrap
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.patch_path import PATH_CELLS, edge_softness, reach_of, roller_path
from beardyn_core.physics.scatter import crown_errors, scattered_oversize
from beardyn_core.physics.spall_cover import counted_cover, lamina_cover, shared_cover
from beardyn_core.physics.waviness import WaveParams, wave_params
from beardyn_core.scene.defect import RollerError, every_patch
from beardyn_core.scene.patch import Patch
from beardyn_core.scene.scene import Scene


class SurfaceParams(NamedTuple):
    """Patches of one surface."""

    places: Any  # [patch, PATCH_FIELDS]: centre [rad], repeats a turn, radius [m], radius by repeats, reach
    present: Any  # [block, patch, lane], 1 where the lane's roller meets the patch
    cover: Any  # [patch, lamina], share of the lamina's length
    counted: Any  # there, share that counts as lost over a deep hole
    shared: Any  # [patch, patch, lamina], share that two patches have in common; empty where none have
    paths: Any  # [patch x lamina x PATCH_POINTS], gap over even arcs from the centre to the reach [m]
    softness: Any  # there, what sharp edges add to the compliance of the contact [-]


class DamageParams(NamedTuple):
    """Springs of a contact near a patch: intact parts of all laminae, then their damaged parts."""

    laminae: Any  # the lamina table twice over [row of the table, 2 x lamina]
    springs: Any  # work space [1, spring x SPRING_FIELDS, lane]


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
    pockets: Any  # half of the clearance added along the pitch circle, and at the ends [block, 2, lane], [m]
    crowns: Any = None  # drop of the profile's error over the squared abscissa [block, 1, lane], [1/m]


SURFACES = ("cup", "cone", "roller")


def fault_params(scene: Scene, arrangement: Arrangement, laminae: Float) -> FaultParams:
    """Collect all faults at t = 0; what the scene does not have is ``None``."""
    cup, cone, roller = (surface_params(scene, on, arrangement) for on in SURFACES)
    cup_waves, cone_waves, roller_waves = (wave_params(scene, on, arrangement) for on in SURFACES)
    cup_damage, cone_damage = (
        None if ring is None and roller is None else damage_params(laminae, arrangement.width)
        for ring in (cup, cone)
    )
    return FaultParams(
        cup, cone, roller, cup_damage, cone_damage, cup_waves, cone_waves, roller_waves,
        pocket_wear_of(scene, arrangement), crown_params(scene, arrangement),
    )  # fmt: skip


def patches_of(scene: Scene, on: str) -> list[Patch]:
    """List the patches of one surface, in the order of the scene."""
    return [patch for patch in every_patch(scene.defects, scene.bearing) if patch.on == on]


def surface_params(scene: Scene, on: str, arrangement: Arrangement) -> SurfaceParams | None:
    """Collect the patches of one surface; ``None`` without any."""
    patches = patches_of(scene, on)
    if not patches:
        return None
    count = scene.numerics.laminae
    coupling = None if "lamina_coupling" in scene.missing_effects else scene.effects.lamina_coupling
    places = np.zeros((len(patches), layout.PATCH_FIELDS))
    present = np.zeros((arrangement.block_count, len(patches), arrangement.width))
    paths = np.zeros((len(patches), count, layout.PATCH_POINTS))
    for index, patch in enumerate(patches):
        there = arrangement.row == patch.row
        if on == "roller":
            there = there & (arrangement.roller == patch.roller)
        present[:, index] = there
    surface = SurfaceParams(
        places,
        present,
        np.array([lamina_cover(scene.bearing, patch, count) for patch in patches]),
        counted_cover(scene.bearing, patches, count, coupling),
        shared_cover(scene.bearing, patches, count),
        paths.reshape(-1),
        np.zeros(paths.size),
    )
    for index, patch in enumerate(patches):
        _write_patch(surface, index, patch, scene, 0.0)
    return surface


def grow(faults: FaultParams, scene: Scene, time: float) -> None:
    """Give growing patches their size at a time [s]; a function of the time alone."""
    for on, surface in zip(SURFACES, (faults.cup, faults.cone, faults.roller), strict=True):
        for index, patch in enumerate(patches_of(scene, on)):
            if surface is not None and patch.growth is not None:
                _write_patch(surface, index, patch, scene, time)


def _write_patch(surface: SurfaceParams, index: int, patch: Patch, scene: Scene, time: float) -> None:
    bearing, count = scene.bearing, scene.numerics.laminae
    size = patch.size_at(time)
    radii = contact_radii(bearing, patch.on, count)
    reach = max(reach_of(patch, size, radius, bearing) for radius in radii)
    repeats = bearing.roller_count if patch.kind == "brinelling" else 1
    radius = surface_radius(bearing, patch.on)
    place = surface.places[index]
    place[layout.PLACE_AZIMUTH] = patch.azimuth
    place[layout.PLACE_REPEATS] = repeats
    place[layout.PLACE_RADIUS] = radius
    place[layout.PLACE_ARC_RADIUS] = radius / repeats
    place[layout.PLACE_REACH] = reach
    place[layout.PLACE_SCALE] = PATH_CELLS / reach
    paths = surface.paths.reshape(-1, count, layout.PATCH_POINTS)
    softness = surface.softness.reshape(paths.shape)
    for lamina, contact_radius in enumerate(radii):
        path = roller_path(patch, size, contact_radius, reach)
        paths[index, lamina, : PATH_CELLS + 1] = path
        softness[index, lamina, : PATH_CELLS + 1] = edge_softness(
            patch, size, contact_radius, reach, path, bearing
        )


def damage_params(laminae: Float, width: int) -> DamageParams:
    """Double the lamina table (intact and damaged springs) and make work space for the springs."""
    springs = np.zeros((1, layout.SPRING_FIELDS * 2 * laminae.shape[1], width))
    return DamageParams(for_springs(laminae), springs)


def crown_params(scene: Scene, arrangement: Arrangement) -> Float | None:
    """Spread the errors of the rollers' profiles over the lanes, [block, 1, lane], [1/m]; or ``None``."""
    crowns = crown_errors(scene)
    return None if crowns is None else np.ascontiguousarray(arrangement.to_lanes(crowns)[:, None, :])


def roller_oversize(scene: Scene) -> Float:
    """Work out the radius error of each roller from scatter and defects, shape [row, roller], [m]."""
    error = scattered_oversize(scene)
    for defect in scene.defects:
        if isinstance(defect, RollerError):
            error[defect.row, defect.roller] += 0.5 * defect.diameter
    return error


_LAST = layout.PATCH_POINTS - 2.0
_SPRINGS = 0  # the work space has one page
# of a contact, by which softness counts next to a gap where several patches meet [m]
_USUAL_DEPTH = 5e-6
# of a patch that counts as a whole where several meet [m]
_FULL_SINK = 1e-6
# Fields of the intact spring of a lamina that hold the sums of a surface until its share is known: sinks,
# their squares, and what counts of them
_OF_RING = (layout.SPRING_GAP, layout.SPRING_SHARE, layout.SPRING_FIRMNESS)
_OF_ROLLER = (layout.SPRING_RING_SLOPE, layout.SPRING_RING_SOFTENING, layout.SPRING_ROLLER_SLOPE)
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
    """Measure how far a roller is inside the reach of a patch; not positive beyond it, [m]."""
    inside = surface.places[patch, layout.PLACE_REACH] - magnitude(patch_arc(azimuth, patch, surface))
    return lanes.load(surface.present, block, patch) * inside


@inline
def any_near(lanes, block, azimuth, surface):
    """Check whether any lane is within the reach of any patch of a surface."""
    if surface is None:
        return False
    nearest = lanes.constant(0.0)
    for patch in range(surface.places.shape[0]):
        nearest = at_least(nearest, patch_nearness(lanes, block, azimuth, patch, surface))
    return any_positive(nearest)


@inline
def find_damage(lanes, block, azimuths, count, surfaces, damage):
    """Check whether a contact is near a patch, and then work out the gaps of its springs.

    ``count``: of laminae; ``surfaces``: `SurfaceParams` of ring and roller, or ``None``.

    A patch that covers a part of a lamina leaves the rest as a spring of its own, so that forces are
    continuous in the place and length of a patch. Where several patches meet on one lamina a damaged spring
    stands for all of them. Its share is that of even sink: (sum of w)^2 over the sum of w^2 along the lamina,
    w the sink, so that strips side by side have the sum of their shares and patches over each other their
    mean, weighted by sink, as those of ring and roller have. It keeps the mean gap and softness of the
    lamina. Of a share counts what `spall_cover` finds.
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
    add_patches(lanes, block, azimuths[0], count, layout.SPRING_RING_SLOPE, _OF_RING, surfaces[0], springs)
    add_patches(
        lanes, block, azimuths[1], count, layout.SPRING_ROLLER_SLOPE, _OF_ROLLER, surfaces[1], springs
    )
    one = lanes.constant(1.0)
    for k in range(count):
        intact, damaged = layout.SPRING_FIELDS * k, layout.SPRING_FIELDS * (count + k)
        on_ring, of_ring = _share_of_surface(lanes, springs, intact, _OF_RING)
        on_roller, of_roller = _share_of_surface(lanes, springs, intact, _OF_ROLLER)
        share = (on_ring * of_ring + on_roller * of_roller) / at_least(on_ring + on_roller, 1e-30)
        weight = 1.0 / at_least(share, 1e-12)
        for field in range(intact, intact + layout.SPRING_FIELDS):
            lanes.store(springs, _SPRINGS, field, zero)
        lanes.store(springs, _SPRINGS, intact + layout.SPRING_SHARE, 1.0 - share)
        lanes.store(springs, _SPRINGS, damaged + layout.SPRING_SHARE, share)
        for field in (layout.SPRING_GAP, layout.SPRING_RING_SLOPE, layout.SPRING_ROLLER_SLOPE):
            _scale(lanes, springs, damaged + field, weight)
        firmness = 1.0 / (1.0 + weight * lanes.load(springs, _SPRINGS, damaged + layout.SPRING_FIRMNESS))
        lanes.store(springs, _SPRINGS, damaged + layout.SPRING_FIRMNESS, firmness)
        lanes.store(springs, _SPRINGS, intact + layout.SPRING_FIRMNESS, one)
        for field in (layout.SPRING_RING_SOFTENING, layout.SPRING_ROLLER_SOFTENING):
            _scale(lanes, springs, damaged + field, _ENERGY * weight * firmness)
    return True


@inline
def _share_of_surface(lanes, springs, intact, fields):
    """Take the sum of the sinks of a surface [m], and the share of the lamina that its patches take [-]."""
    first = lanes.load(springs, _SPRINGS, intact + fields[0])
    second = lanes.load(springs, _SPRINGS, intact + fields[1])
    counted = lanes.load(springs, _SPRINGS, intact + fields[2])
    return first, at_most(counted * (first / at_least(second, 1e-30)), 1.0)


@inline
def add_patches(lanes, block, azimuth, count, slope_field, fields, surface, springs):
    """Add the moments of the gaps of one surface's patches to the springs of a contact.

    With the cover c, the part of it that counts k, the gap g, the softness s and the sink w of
    `saturated_sink`, the fields of the damaged spring take in the sums of ``c g`` (gap), ``k s`` (firmness),
    ``c dg/dtheta`` (slope) and ``k ds/dtheta`` (softening); the ``fields`` of the intact one those of
    ``c w``, ``c w^2`` and ``k w``.
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
                intact, damaged = layout.SPRING_FIELDS * k, layout.SPRING_FIELDS * (count + k)
                begin = layout.PATCH_POINTS * (patch * count + k)
                low = lanes.gather(surface.paths, cell + begin)
                high = lanes.gather(surface.paths, cell + (begin + 1))
                gap = present * (low + part * (high - low))
                firm = lanes.gather(surface.softness, cell + begin)
                soft = lanes.gather(surface.softness, cell + (begin + 1))
                softness = present * (firm + part * (soft - firm))
                cover = surface.cover[patch, k]
                # what stands higher presses with all that is of it
                zero = 0.0 * gap
                counted = where_greater(zero, gap, cover + zero, surface.counted[patch, k] + zero)
                sink = saturated_sink(gap, softness)
                square = sink * sink * cover
                square = square + _shared_squares(lanes, block, azimuth, patch, k, count, sink, surface)
                _increase(lanes, springs, intact + fields[0], cover * sink)
                _increase(lanes, springs, intact + fields[1], square)
                _increase(lanes, springs, intact + fields[2], counted * sink)
                _increase(lanes, springs, damaged + layout.SPRING_GAP, cover * gap)
                _increase(lanes, springs, damaged + layout.SPRING_FIRMNESS, counted * softness)
                _increase(lanes, springs, damaged + slope_field, cover * climb * (high - low))
                _increase(lanes, springs, damaged + slope_field + 1, counted * climb * (soft - firm))


@inline
def saturated_sink(gap, softness):
    """Work out by how much a gap and soft edges count where several patches meet, [m].

    Deep gaps count alike: nothing presses over them, however deep they are.
    """
    depth = magnitude(gap) + _USUAL_DEPTH * softness
    return depth * _FULL_SINK / (_FULL_SINK + depth)


@inline
def _shared_squares(lanes, block, azimuth, patch, k, count, sink, surface):
    """Sum twice the product of sinks over what a patch has in common with those before it, [m^2]."""
    total = lanes.constant(0.0)
    for other in range(min(patch, surface.shared.shape[0])):
        shared = surface.shared[patch, other, k]
        if shared > 0.0:
            arc = patch_arc(azimuth, other, surface)
            position = at_most(magnitude(arc) * surface.places[other, layout.PLACE_SCALE], _LAST)
            cell = floor(position)
            part = position - cell
            cell = cell + layout.PATCH_POINTS * (other * count + k)
            gap, gap_after = lanes.gather(surface.paths, cell), lanes.gather(surface.paths, cell + 1.0)
            soft, soft_after = (
                lanes.gather(surface.softness, cell),
                lanes.gather(surface.softness, cell + 1.0),
            )
            beside = saturated_sink(gap + part * (gap_after - gap), soft + part * (soft_after - soft))
            total = total + 2.0 * shared * lanes.load(surface.present, block, other) * beside * sink
    return total


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
def soften_by_edges(lanes, tangent, spring, damage):
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
