"""Equilibrium of every roller between cup, cone and rib for a given pose of the cone.

The contact energy of a roller is convex in its position as long as it stays before its rib, so damped Newton
steps that are short and only accept a lower energy (or a smaller residual force) find the one equilibrium. A
roller that the rings leave free is put where a turning bearing would carry it: against cup and rib, just
touching; one with two like ends against the cup.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import LINE_EXPONENT, POINT_EXPONENT
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.rib_face import faces_of_ring
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.physics.roller_spring import SpringParams, lever_of_cup
from beardyn_core.physics.statics import barrel_contacts
from beardyn_core.physics.statics.roller_contacts import (
    ConePose,
    ContactModel,
    ContactSet,
    apply_stiffness,
    cone_contacts,
    contact_model,
    cup_contacts,
    cup_rib_contacts,
    rib_contacts,
)

Contacts = tuple[ContactSet, ...]
"""Of the rollers with cup, cone, ribs of the cone and, where it has any, ribs of the cup."""
TERMS = 8
_SAMPLES = 31
# below this share of the largest load the fit is absolute: a crown leaves light contacts none at all
_SMALLEST_SHARE = 1.0e-3
_SMALLEST_APPROACH, _USUAL_APPROACH, _LARGEST_APPROACH = 2.0e-7, 1.5e-5, 4.0e-4
_SMALLEST_LEANING = 2.0e-6
# of barrels light loads count less, so that the spring begins without a jump: rollers would strike
_SMALLEST_OF_ELLIPSE, _SLICES_OF_ELLIPSE, _SHARE_OF_ELLIPSE = 2.0e-8, 60, 1.0e-2
_FINE = 20  # laminae


def roller_forces(
    cup_load: float, cup_angle: float, cone_angle: float, rib_angle: float, centrifugal: float = 0.0
) -> tuple[float, float]:
    """Compute the cone load Q_i and rib load Q_f that balance a cup load Q_o and centrifugal force F_c, [N].

    Angles are the half-angles of the raceways, alpha_o and alpha_i, and alpha_f, that of the rib normal to
    the radial direction, [rad].

    Notes
    -----
    Radially Q_i cos(ai) + F_c = Q_o cos(ao) + Q_f cos(af), axially Q_o sin(ao) = Q_i sin(ai) + Q_f sin(af).
    Without F_c, Q_i/Q_o = sin(ao + af)/sin(ai + af) and Q_f/Q_o = sin(ao - ai)/sin(ai + af).
    """
    shared = math.sin(cone_angle + rib_angle)
    cone_load = (cup_load * math.sin(cup_angle + rib_angle) - centrifugal * math.sin(rib_angle)) / shared
    rib_load = (cup_load * math.sin(cup_angle - cone_angle) + centrifugal * math.sin(cone_angle)) / shared
    return cone_load, rib_load


def centrifugal_cup_load(centrifugal: float, cup_angle: float, rib_angle: float) -> float:
    """Compute the cup load of a roller that the cone does not press, F_c sin(af)/sin(ao + af), [N]."""
    return centrifugal * math.sin(rib_angle) / math.sin(cup_angle + rib_angle)


@cache
def load_of_approach(bearing: RollerBearing, laminae: int) -> tuple[Float, Float]:
    """Work out the cup load of a roller over the approach of cone and cup along the cup's normal.

    Both cones of tapered rollers are pressed axially against one row, so that every roller of it has the same
    approach; cylinders and barrels are clamped by a cup that is too narrow.

    Returns ``approach`` [sample], [m], and ``load`` [sample], [N].
    """
    smallest, samples = _SMALLEST_APPROACH, _SAMPLES
    if bearing.self_aligning:
        smallest, samples, laminae = _SMALLEST_OF_ELLIPSE, 2 * _SAMPLES, max(laminae, _SLICES_OF_ELLIPSE)
    low, high = smallest ** (1.0 / 9.0), _LARGEST_APPROACH ** (1.0 / 9.0)
    nodes = np.cos(np.pi * (np.arange(samples) + 0.5) / samples)
    approach = (0.5 * (low + high) + 0.5 * (high - low) * nodes) ** 9
    load = np.empty(samples)
    for index, depth in enumerate(approach):
        load[index] = _pressed(bearing, laminae, depth).cup.force[-1].sum(axis=-1).mean()
    return approach, load


def _pressed(bearing: RollerBearing, laminae: int, depth: float) -> RollerState:
    """Press every roller of the last row by an approach of cone and cup along the cup's normal [m]."""
    return solve_rollers(*_pressing(bearing, laminae, depth), None)


def _pressing(bearing: RollerBearing, laminae: int, depth: float) -> tuple[ContactModel, ConePose]:
    if isinstance(bearing, Bearing):
        pose = np.array([0.0, -depth / np.sin(bearing.cup_angle), 0.0])
        return contact_model(bearing, 0.0, laminae, 0.0, 0.0), ConePose(pose, np.eye(3))
    if isinstance(bearing, SphericalBearing):  # its play is a dimension of the sphere
        bearing = replace(bearing, radial_clearance=-2.0 * depth / math.cos(bearing.cup_angle))
    model = contact_model(bearing, 0.0, laminae, 0.0, 0.0, rows=1)
    return replace(model, clearance=-depth), ConePose(np.zeros(3), np.eye(3))


def spring_params(bearing: RollerBearing, laminae: int) -> SpringParams:
    """Fit the spring of one roller, see `_fitted_spring`; bearings that differ in their play share it."""
    return _fitted_spring(bearing.clamped, laminae)


@cache
def _fitted_spring(bearing: RollerBearing, laminae: int) -> SpringParams:
    """Fit the spring of one roller by least squares in the ninth root of the approach.

    Notes
    -----
    Two line contacts in series with the rib in the force triangle nearly follow Q = K D^(10/9); what is
    left, the profile at small loads and the point contact of the rib, is smooth in D^(1/9): the fit is good
    to 1e-5 with straight rollers and, above a thousandth of the largest load, to 4 % with a profile that
    takes ends of the roller out of contact, 12 % with too few laminae for it. Of barrels the ends of the
    roller cut the ellipse off: there it is good to 1.5 %.
    """
    approach, load = load_of_approach(bearing, laminae)
    root = approach ** (1.0 / 9.0)
    powers = root[:, None] ** np.arange(TERMS)
    smallest = _SHARE_OF_ELLIPSE if bearing.self_aligning else _SMALLEST_SHARE
    judged = np.maximum(load, smallest * load.max())
    terms = np.linalg.lstsq(powers * (approach * root / judged)[:, None], load / judged, rcond=None)[0]
    # what leans on a cylinder from the side does not press it
    rib_angle = bearing.rib_angle if isinstance(bearing, Bearing) else 0.5 * math.pi
    angles = bearing.cup_angle, bearing.cone_angle, rib_angle
    cone_share, rib_share = roller_forces(1.0, *angles)
    return SpringParams(
        series=np.ascontiguousarray(terms),
        lever=lever_of_cup(bearing),
        cone_share=cone_share,
        rib_share=rib_share,
        rib_centrifugal=roller_forces(0.0, *angles, centrifugal=1.0)[1],
        idle=_idle_share(bearing, rib_angle),
        give=float((approach[load > 0.0] / load[load > 0.0]).min()),
        reach=reach(bearing),
    )


def _idle_share(bearing: RollerBearing, rib_angle: float) -> float:
    """Compute the cup load of a roller that the cone does not press, over its centrifugal force."""
    if bearing.self_aligning:  # the rest cage and guide ring take
        return math.cos(bearing.cup_angle)
    return centrifugal_cup_load(1.0, bearing.cup_angle, rib_angle)


@cache
def lean_stiffness(bearing: RollerBearing, laminae: int) -> tuple[Float, Float]:
    """Work out how both raceways hold the lean of a roller over its approach, held at its place otherwise.

    Returns ``approach`` of cone and cup along the cup's normal [sample], [m], and ``stiffness`` [sample],
    [N m/rad]; approaches at which nothing touches are left out.
    """
    approach = np.geomspace(_SMALLEST_LEANING, _LARGEST_APPROACH, _SAMPLES)
    stiffness = np.empty(_SAMPLES)
    for index, depth in enumerate(approach):
        model, pose = _pressing(bearing, laminae, depth)
        solver = _Rollers(model, pose)
        matrix = solver.at(solve_rollers(model, pose, None).position).stiffness[-1]
        stiffness[index] = float(matrix[:, 2, 2].mean()) * solver.scale[2] ** 2
    held = stiffness > 0.0
    return approach[held], stiffness[held]


@cache
def reach(bearing: RollerBearing) -> float:
    """Work out half of the length by which a roller holds a tilt of its rings against each other, [m].

    Of a line of springs whose third of the square is the stiffness against tilt over that along the normal:
    for straight rollers half of their length. A profile that takes the ends out of contact leaves less, the
    more the lighter the load: taken at one in the middle of service, and with many laminae, for the spring
    has none. 0 for barrels, which align themselves.
    """
    if bearing.self_aligning:
        return 0.0
    stiffness = _pressed(bearing, _FINE, _USUAL_APPROACH).cone_stiffness
    if stiffness[2, 2] <= 0.0:  # so much crown that nothing touches
        return 0.0
    # about where a displacement across does not tilt
    tilting = stiffness[3, 3] - stiffness[3, 2] ** 2 / stiffness[2, 2]
    return math.sqrt(3.0 * max(tilting, 0.0) / stiffness[2, 2]) * math.cos(bearing.cup_angle)


_ITERATIONS = 80
# Rounding of a gap (1e-17 m) times the stiffness of a raceway contact is about 2e-8 N.
_RELATIVE_TOLERANCE = 3.0e-12
_ABSOLUTE_TOLERANCE = 5.0e-9
_STALL_LIMIT = 2
# Of a roller, tilt as lever times angle, [m]; a longer one jumps over the rib, beyond which centrifugal force
# drives a roller out of the bearing.
_LONGEST_STEP = 1.0e-4
# A roller counts as free when its cone gap, with cup and rib just touching, is above this.
_ROUNDING_GAP = 1.0e-15


@dataclass(frozen=True)
class RollerState:
    """Rollers in equilibrium at one pose of the cone."""

    position: Float  # [row, roller, 3], radial and axial displacement of mid-length and tilt [m, m, rad]
    cup: ContactSet
    cone: ContactSet
    rib: ContactSet
    cup_rib: ContactSet | None  # where the cup has ribs
    residual: float  # largest force that is left on a roller [N]
    # [5 + 2 x mode], force of the rollers on the cone, its moment about x and z, [N, N m], and their force on
    # the amplitudes of the cup's bending [N]
    cone_force: Float
    cone_stiffness: Float  # change of the opposite of `cone_force` with the cone pose, rollers following
    follow: Float  # [row, roller, 3, 5 + 2 x mode], change of roller position with the cone pose
    energy: float  # contact energy less the work of the inertia loads [J]


def solve_rollers(model: ContactModel, pose: ConePose, guess: Float | None) -> RollerState:
    """Find the equilibrium of all rollers.

    Positions of a ``guess`` [row, roller, 3] are where those start that have a lower energy there than free.
    """
    solver = _Rollers(model, pose)
    tapered = isinstance(model.bearing, Bearing)
    touching = _on_cup_and_rib(model, pose) if tapered else _on_cup(solver)
    contacts = solver.contacts(touching, by_cone=False)
    start = solver.at(touching, contacts)
    free = (contacts[1].approach.max(axis=-1) <= _ROUNDING_GAP) & (not np.any(model.inertia_load))
    if not tapered:  # a tapered roller touches its rib by where it has been put
        for ribs in contacts[2:]:
            free &= ribs.approach.max(axis=-1, initial=-np.inf) <= _ROUNDING_GAP
    free |= model.missing  # what is not there touches nothing either
    if guess is not None:
        warm = solver.at(guess)
        start = _choose_trials(warm.energy < start.energy, warm, start)
    trial = _newton(solver, start, free)
    position = np.where(free[..., None], touching, trial.position)
    return solver.state(position, free)


@dataclass(frozen=True)
class _Trial:
    """Position of every roller with the energy, force and stiffness there."""

    position: Float
    energy: Float
    force: Float
    stiffness: Float
    load: Float


class _Rollers:
    """Energy of the rollers at one pose of the cone, as a function of their positions."""

    def __init__(self, model: ContactModel, pose: ConePose) -> None:
        self.model = model
        self.pose = pose
        # With one lamina the raceways hold no tilt: it stays locked.
        self.active = 2 if model.abscissa.size == 1 else 3
        lever = model.bearing.effective_length / math.sqrt(12.0)
        self.scale = np.array([1.0, 1.0, lever])

    def contacts(self, position: Float, by_cone: bool) -> Contacts:
        model, pose = self.model, self.pose
        ribs = rib_contacts(model, position, pose, by_cone)
        if model.bearing.self_aligning:
            return (
                barrel_contacts.cup_contacts(model, position, pose, by_cone),
                barrel_contacts.cone_contacts(model, position, by_cone),
                ribs,
            )
        found = (
            cup_contacts(model, position, pose, by_cone),
            cone_contacts(model, position, pose, by_cone),
            ribs,
        )
        if faces_of_ring(model.bearing, "cup"):
            return (*found, cup_rib_contacts(model, position, pose, by_cone))
        return found

    def at(self, position: Float, contacts: Contacts | None = None) -> _Trial:
        """Work out energy and its derivatives, tilt measured as lever times angle."""
        contacts = contacts or self.contacts(position, by_cone=False)
        energy = -np.sum(self.model.inertia_load * position, axis=-1)
        force = np.broadcast_to(self.model.inertia_load / self.scale, position.shape).copy()
        stiffness = np.zeros((*position.shape, 3))
        load = np.full(energy.shape, float(np.abs(self.model.inertia_load[0])))
        for contact in contacts:
            direction = contact.by_roller / self.scale
            energy += contact.energy.sum(axis=-1)
            load += contact.force.sum(axis=-1)
            force -= np.sum(contact.force[..., None] * direction, axis=-2)
            stiffness += np.swapaxes(direction, -1, -2) @ apply_stiffness(contact.stiffness, direction)
        if self.active == 2:
            force[..., 2] = 0.0
            stiffness[..., 2, :] = 0.0
            stiffness[..., :, 2] = 0.0
            stiffness[..., 2, 2] = 1.0
        return _Trial(position, energy, force, stiffness, load)

    def state(self, position: Float, free: NDArray[np.bool_]) -> RollerState:
        """Work out everything the ring equilibrium needs, rollers that are free left out."""
        found = self.contacts(position, by_cone=True)
        trial = self.at(position, found)
        held = ~free
        contacts = tuple(_without(contact, free) for contact in found)
        size = 5 + self.model.bending.shape[-1]
        cone_force = np.zeros(size)
        stiffness = np.zeros((size, size))
        coupling = np.zeros((*position.shape, size))
        for contact in contacts:
            cone_force -= np.einsum("ijk,ijkm->m", contact.force, contact.by_cone)
            weighted = apply_stiffness(contact.stiffness, contact.by_cone)
            stiffness += np.einsum("ijkm,ijkn->mn", contact.by_cone, weighted)
            coupling += np.swapaxes(contact.by_roller / self.scale, -1, -2) @ weighted
        if self.active == 2:
            coupling[..., 2, :] = 0.0
        follow = np.zeros_like(coupling)
        follow[held] = -np.linalg.solve(_regular(trial.stiffness[held], 1.0e-14), coupling[held])
        stiffness += np.einsum("ijrm,ijrn->mn", coupling, follow)
        left = np.abs(trial.force[held])
        return RollerState(
            position=position,
            cup=contacts[0],
            cone=contacts[1],
            rib=contacts[2],
            cup_rib=contacts[3] if len(contacts) > 3 else None,
            residual=float(left.max()) if left.size else 0.0,
            cone_force=cone_force,
            cone_stiffness=0.5 * (stiffness + stiffness.T),
            follow=follow / self.scale[:, None],
            energy=float(trial.energy[held].sum()),
        )


def _newton(solver: _Rollers, start: _Trial, free: NDArray[np.bool_]) -> _Trial:
    """Take damped Newton steps on all rollers at once; each keeps its own damping."""
    best = start
    damping = np.full(free.shape, 1.0e-9)
    stalled = np.zeros(free.shape, dtype=np.int64)
    for _ in range(_ITERATIONS):
        size = np.abs(best.force).max(axis=-1)
        done = (
            free | (size <= _RELATIVE_TOLERANCE * best.load + _ABSOLUTE_TOLERANCE) | (stalled > _STALL_LIMIT)
        )
        if done.all():
            break
        step = np.linalg.solve(_regular(best.stiffness, damping), best.force[..., None])[..., 0]
        length = np.linalg.norm(step, axis=-1, keepdims=True)
        step *= _LONGEST_STEP / np.maximum(length, _LONGEST_STEP)
        step[done] = 0.0
        trial = solver.at(best.position + step / solver.scale)
        smaller = np.abs(trial.force).max(axis=-1) < size
        lower = trial.energy < best.energy - 1.0e-12 * np.abs(best.energy)
        accepted = (lower | smaller) & ~done
        near = size <= 1.0e-7 * best.load + 1.0e-6
        stalled = np.where(accepted | ~near, 0, stalled + 1)
        damping = np.clip(np.where(accepted, 0.1 * damping, 20.0 * damping), 1.0e-14, 1.0e6)
        best = _choose_trials(accepted, trial, best)
    return best


def _regular(stiffness: Float, damping: Float | float) -> Float:
    """Add `damping` of its own size to a stiffness, invertible also where a direction is slack."""
    size = np.trace(stiffness, axis1=-2, axis2=-1)
    added = np.maximum(np.asarray(damping) * size, 1.0)
    return stiffness + added[..., None, None] * np.eye(stiffness.shape[-1])


def _choose_trials(mask: NDArray[np.bool_], one: _Trial, other: _Trial) -> _Trial:
    """Choose the rollers of `one` where `mask` holds and of `other` elsewhere."""
    return _Trial(
        position=np.where(mask[..., None], one.position, other.position),
        energy=np.where(mask, one.energy, other.energy),
        force=np.where(mask[..., None], one.force, other.force),
        stiffness=np.where(mask[..., None, None], one.stiffness, other.stiffness),
        load=np.where(mask, one.load, other.load),
    )


def _without(contact: ContactSet, free: NDArray[np.bool_]) -> ContactSet:
    """Set force, stiffness and energy of the contacts of free rollers to zero."""
    held = ~free[..., None]
    matrix = held.reshape(held.shape + (1,) * (contact.stiffness.ndim - held.ndim))
    return replace(
        contact,
        force=contact.force * held,
        stiffness=contact.stiffness * matrix,
        energy=contact.energy * held,
    )


def _on_cup(solver: _Rollers) -> Float:
    """Place the rollers along their contact line where the cup alone carries the inertia load, or touches."""
    model = solver.model
    angle = model.bearing.contact_angle
    line = np.array([math.cos(angle), math.sin(angle), 0.0])
    wanted = 0.0
    if np.any(model.inertia_load):
        law = model.lamina_factor * model.abscissa.size
        wanted = float((model.inertia_load @ line / law) ** (1.0 / LINE_EXPONENT))
    position = np.zeros_like(model.centre)
    for _ in range(4):
        cup = solver.contacts(position, by_cone=False)[0]
        position += (wanted - cup.approach.max(axis=-1))[..., None] * line
    return position


def _on_cup_and_rib(model: ContactModel, pose: ConePose) -> Float:
    """Place the rollers without tilt where cup and rib alone carry the inertia load, or just touch."""
    bearing = model.bearing
    assert isinstance(bearing, Bearing)
    centrifugal = float(model.inertia_load[0])
    cup_load = centrifugal_cup_load(centrifugal, bearing.cup_angle, bearing.rib_angle)
    _, rib_load = roller_forces(
        cup_load, bearing.cup_angle, bearing.cone_angle, bearing.rib_angle, centrifugal
    )
    wanted = np.array(
        [
            (cup_load / (model.lamina_factor * model.abscissa.size)) ** (1.0 / LINE_EXPONENT),
            (rib_load / faces_of_ring(bearing, "cone")[0].factor) ** (1.0 / POINT_EXPONENT),
        ]
    )
    position = np.zeros_like(model.centre)
    for _ in range(4):
        cup = cup_contacts(model, position, pose, by_cone=False)
        rib = rib_contacts(model, position, pose, by_cone=False)
        matrix = np.stack([cup.by_roller[:, :, 0, :2], rib.by_roller[:, :, 0, :2]], axis=-2)
        excess = np.stack([cup.approach.max(axis=-1), rib.approach[..., 0]], axis=-1) - wanted
        position[..., :2] -= np.linalg.solve(matrix, excess[..., None])[..., 0]
    return position
