"""Raceway and rib contacts of cones and cylinders for a given pose of cone and rollers.

Every roller moves in its own meridian plane: radially, axially (outwards, along its row) and in tilt.
The cup is at rest. The gaps are exact signed distances: to the cup cone in the meridian plane, to the
displaced and tilted cone in space, of the end spheres to the conical ribs. A cylinder is a cone of angle 0.
Barrels: see `barrel_contacts`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import (
    LINE_EXPONENT,
    POINT_EXPONENT,
    line_contact_factor,
    power_law,
)
from beardyn_core.bearing.kinematics import cage_speed, centrifugal_force, roller_spin
from beardyn_core.bearing.lamina_coupling import LaminaRoot, coupled_law
from beardyn_core.bearing.rib_face import RibFace, faces_of_ring
from beardyn_core.bearing.roller_bearing import ROW_COUNT, RollerBearing
from beardyn_core.effects import LaminaCoupling
from beardyn_core.effects.lamina_coupling import bearing_lamina_root
from beardyn_core.physics.modal_body import ModalBody

# The end sphere of a forced bearing that is centred this close to the bearing axis, where its direction from
# there counts for nothing, is pushed along its roller's meridian [m].
_ON_AXIS = 1.0e-3
_NOT_ASKED = np.empty(0)


@dataclass(frozen=True)
class ContactModel:
    """Constants of the contacts of both rows."""

    bearing: RollerBearing
    radial: Float  # [row, roller, 3], unit vectors of each meridian plane: radially outwards,
    axial: Float  # axially outwards along the row,
    tilt_axis: Float  # and the axis about which a positive tilt turns the large end radially outwards
    centre: Float  # [row, roller, 3], nominal mid-length points of the rollers [m]
    abscissa: Float  # [lamina], from mid-length [m]
    radius: Float  # [row, roller, lamina], roller radius at the laminae with the roller's error [m]
    oversize: Float  # [row, roller, 1], radius error [m]
    drop: Float  # [lamina], or with errors of the profiles [row, roller, lamina]: of the profile [m]
    clearance: float  # normal gap at the cup raceway with the cone centred [m]
    lamina_factor: float  # stiffness factor of one lamina contact [N/m^(10/9)]
    inertia_load: Float  # [3], radial, axial and tilting, of the orbiting roller at mid-length [N, N, N m]
    bending: Float  # [row, roller, mode], how far the raceway opens per amplitude of a mode [1/sqrt(kg)]
    missing: NDArray[np.bool_]  # [row, roller], rollers that are not there
    coupling: LaminaRoot | None = None  # matrices of coupled laminae


@dataclass(frozen=True)
class ConePose:
    """Pose of the cone relative to the cup."""

    displacement: Float  # [3], of the bearing centre fixed to the cone [m]
    rotation: Float  # [3, 3], from cone axes to cup axes
    bending: Float = field(default_factory=lambda: np.zeros(0))  # [mode], amplitudes [m sqrt(kg)]


@dataclass(frozen=True)
class ContactSet:
    """One kind of contact of every roller; arrays [row, roller, lamina, ...]."""

    approach: Float  # positive when in contact [m]
    force: Float  # [N]
    stiffness: Float  # [N/m]; of coupled laminae a matrix [..., lamina, lamina]
    energy: Float  # [J]; of coupled laminae that of the line, [row, roller, 1]
    by_roller: Float  # [..., 3], change of approach with its radial, axial and tilt motion [-, -, m/rad]
    # [..., 5 + mode], with displacement, tilt about x and z, modes [-, m/rad, 1/sqrt(kg)]; empty where it
    # is not asked for
    by_cone: Float


def contact_model(
    bearing: RollerBearing,
    end_play: float,
    laminae: int,
    speed: float,
    roller_phase: float,
    coupling: LaminaCoupling | None = None,
    oversize: Float | None = None,
    body: ModalBody | None = None,
    rows: int = ROW_COUNT,
    missing: Sequence[tuple[int, int]] = (),
    crown: ArrayLike | None = None,
) -> ContactModel:
    """Gather the constants of the contacts; arguments as of `static.solve`."""
    error = np.zeros((rows, bearing.roller_count)) if oversize is None else oversize[:rows]
    azimuth = roller_phase + 2.0 * math.pi * np.arange(bearing.roller_count) / bearing.roller_count
    radial = np.zeros((rows, bearing.roller_count, 3))
    radial[..., 0], radial[..., 2] = np.sin(azimuth), np.cos(azimuth)
    axial = np.zeros_like(radial)
    axial[0, :, 1], axial[1:, :, 1] = -1.0, 1.0
    not_there = np.zeros(radial.shape[:2], dtype=bool)
    for row, roller in missing:
        not_there[row, roller] = True
    abscissa = ((np.arange(laminae) + 0.5) / laminae - 0.5) * bearing.effective_length
    drop = bearing.lamina_drop(laminae)
    if crown is not None:
        drop = drop + np.asarray(crown)[:rows, :, None] * abscissa**2
    return ContactModel(
        bearing=bearing,
        radial=radial,
        axial=axial,
        tilt_axis=np.cross(axial, radial),
        centre=0.5 * bearing.row_spacing * axial + 0.5 * bearing.pitch_diameter * radial,
        abscissa=abscissa,
        radius=bearing.radius_at(abscissa) + error[:, :, None],
        oversize=error[:, :, None],
        drop=drop,
        clearance=bearing.normal_gap(end_play),
        lamina_factor=line_contact_factor(bearing.material, bearing.effective_length) / laminae,
        inertia_load=_inertia_load(bearing, speed),
        coupling=None if coupling is None else bearing_lamina_root(bearing, coupling, laminae),
        bending=np.zeros((*radial.shape[:2], 0)) if body is None else body.openings(azimuth),
        missing=not_there,
    )


def _inertia_load(bearing: RollerBearing, speed: float) -> Float:
    """Work out centrifugal force and gyroscopic moment of a roller at epicyclic speed, about mid-length.

    With the cage at w_c and the roller spinning w_r against it, the rate of change of the angular momentum
    needs the moment w_c sin(am) [Jx w_r - (Jx - Jy) w_c cos(am)] that pushes the large end inwards; the
    roller answers with the opposite one. What drives a barrel along its raceways and turns it, cage and guide
    ring take; what is left of its centrifugal force presses it on the sphere.
    """
    if bearing.self_aligning:
        sine, cosine = math.sin(bearing.cup_angle), math.cos(bearing.cup_angle)
        pressed = centrifugal_force(bearing, speed) * cosine
        return np.array([pressed * cosine, pressed * sine, 0.0])
    cage, spin = cage_speed(bearing, speed), roller_spin(bearing, speed)
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    centrifugal = centrifugal_force(bearing, speed)
    axial, transverse = bearing.roller_axial_inertia, bearing.roller_transverse_inertia
    gyroscopic = cage * sine * (axial * spin - (axial - transverse) * cage * cosine)
    return np.array([centrifugal, 0.0, gyroscopic + centrifugal * bearing.roller_mass_offset * cosine])


def line_law(model: ContactModel, approach: Float) -> tuple[Float, Float, Float]:
    """Work out force, tangent stiffness and energy of the laminae of raceway contacts, see `ContactSet`."""
    if model.coupling is None:
        return power_law(approach, model.lamina_factor, LINE_EXPONENT)
    force, stiffness, energy = coupled_law(approach, model.lamina_factor, model.coupling)
    return force, stiffness, energy[..., None]


def apply_stiffness(stiffness: Float, direction: Float) -> Float:
    """Multiply the stiffness of a `ContactSet` by changes of the approaches, [row, roller, lamina, n]."""
    if stiffness.ndim == direction.ndim:
        product: Float = stiffness @ direction
        return product
    return stiffness[..., None] * direction


def cup_contacts(
    model: ContactModel, roller: Float, pose: ConePose | None = None, by_cone: bool = True
) -> ContactSet:
    """Work out the lamina contacts with the cup; `roller` is radial, axial, tilt, shape [row, roller, 3].

    The pose matters for the bending of the cup only.
    """
    bearing = model.bearing
    sine, cosine = math.sin(bearing.cup_angle), math.cos(bearing.cup_angle)
    phi = bearing.half_angle
    tilt = roller[..., 2:3]
    half_sine = 2.0 * np.sin(0.5 * tilt)
    along = model.abscissa * np.cos(phi - 0.5 * tilt) * half_sine
    across = model.radius * np.sin(phi - 0.5 * tilt) * half_sine
    inward = cosine * roller[..., 0:1] - sine * roller[..., 1:2]
    approach = inward + along + across - model.clearance - model.drop + model.oversize * math.cos(phi)
    if pose is not None and pose.bending.size:
        approach = approach - cosine * (model.bending @ pose.bending)[..., None]
    by_roller = np.empty((*approach.shape, 3))
    by_roller[..., 0], by_roller[..., 1] = cosine, -sine
    by_roller[..., 2] = model.abscissa * np.cos(phi - tilt) + model.radius * np.sin(phi - tilt)
    force, stiffness, energy = line_law(model, approach)
    following = _NOT_ASKED
    if by_cone:
        following = np.zeros((*approach.shape, 5 + model.bending.shape[-1]))
        if pose is not None and pose.bending.size:
            following[..., 5:] = -cosine * model.bending[:, :, None, :]
    return ContactSet(approach, force, stiffness, energy, by_roller, following)


def cone_contacts(model: ContactModel, roller: Float, pose: ConePose, by_cone: bool = True) -> ContactSet:
    """Work out the lamina contacts with the cone; `roller` is radial, axial, tilt, shape [row, roller, 3].

    Notes
    -----
    The point of the lamina's rim that faces the cone is found from the cone normal at the lamina centre;
    the error of that one pass is below 0.1 nm at 1 degree of skew.
    """
    bearing = model.bearing
    sine, cosine = math.sin(bearing.cone_angle), math.cos(bearing.cone_angle)
    outwards = model.axial[:, :, None, 1]
    centre, axis = _roller_line(model, roller, pose)
    lamina_centre = centre[:, :, None, :] + model.abscissa[:, None] * axis[:, :, None, :]
    normal = _cone_normal(lamina_centre, outwards, sine, cosine)
    along = np.sum(normal * axis[:, :, None, :], axis=-1, keepdims=True)
    facing = (normal - along * axis[:, :, None, :]) / np.sqrt(1.0 - along**2)
    point = lamina_centre + model.radius[..., None] * facing
    distance = np.hypot(point[..., 0], point[..., 2])
    radius, place = bearing.cone_line
    gap = cosine * (distance - radius) - sine * (outwards * point[..., 1] - place) + model.drop
    normal = _cone_normal(point, outwards, sine, cosine)
    force, stiffness, energy = line_law(model, -gap)
    return _assemble_contacts(model, pose, -gap, force, stiffness, energy, centre, point, normal, by_cone)


def rib_contacts(model: ContactModel, roller: Float, pose: ConePose, by_cone: bool = True) -> ContactSet:
    """Work out contacts of the spherical roller ends with the ribs of the cone; one "lamina" a rib.

    The nearest point of a rib lies on its face between undercut and corner; the edges are sharp.
    """
    return _faces_of("cone", model, roller, pose, by_cone)


def cup_rib_contacts(model: ContactModel, roller: Float, pose: ConePose, by_cone: bool = True) -> ContactSet:
    """Work out contacts of the roller ends with the ribs of the cup, which is at rest, as `rib_contacts`."""
    at_rest = ConePose(np.zeros(3), np.eye(3), pose.bending)
    found = _faces_of("cup", model, roller, at_rest, by_cone)
    return replace(found, by_cone=np.zeros_like(found.by_cone)) if by_cone else found


def _faces_of(ring: str, model: ContactModel, roller: Float, pose: ConePose, by_cone: bool) -> ContactSet:
    """Work out the contacts with every rib of a ring, one behind the other; none is a set without laminae."""
    sets = [_face_contacts(model, roller, pose, face, by_cone) for face in faces_of_ring(model.bearing, ring)]
    if len(sets) == 1:
        return sets[0]
    if not sets:
        nothing = np.zeros((*roller.shape[:2], 0))
        following = np.zeros((*nothing.shape, 5 + model.bending.shape[-1])) if by_cone else _NOT_ASKED
        return ContactSet(nothing, nothing, nothing, nothing, np.zeros((*nothing.shape, 3)), following)
    alone = {"by_cone"} if not by_cone else set()
    joined = {
        name: getattr(sets[0], name)
        if name in alone
        else np.concatenate([getattr(each, name) for each in sets], axis=2)
        for name in vars(sets[0])
    }
    return ContactSet(**joined)


def _face_contacts(
    model: ContactModel, roller: Float, pose: ConePose, face: RibFace, by_cone: bool
) -> ContactSet:
    """Work out contacts of the roller ends with one rib of every row."""
    sine, cosine = math.sin(face.lean), math.cos(face.lean)
    outwards = face.side * model.axial[:, :, 1]
    centre, axis = _roller_line(model, roller, pose)
    sphere = centre + face.sphere_centre * axis
    # a sphere that a forced bearing makes too large is centred on the bearing axis or beyond it
    size = np.hypot(sphere[..., 0], sphere[..., 2])
    outside = np.sum(sphere * model.radial, axis=-1)
    centred = size < _ON_AXIS
    distance = np.where(centred, outside, np.where(outside < 0.0, -size, size))
    inverse = 1.0 / np.where(centred, 1.0, distance)
    nominal_distance, nominal_axial = face.sphere_place
    outward = outwards * sphere[..., 1] - face.side * nominal_axial
    approach = cosine * outward + sine * (distance - nominal_distance) - face.gap
    height = cosine * (distance - nominal_distance) - sine * outward
    beyond = height - np.clip(height, *face.edges)
    ahead = face.sphere_radius - approach
    reach = np.hypot(ahead, beyond)
    approach = approach - beyond**2 / (reach + ahead)
    normal_axial = (ahead * cosine + beyond * sine) / reach
    normal_radial = (ahead * sine - beyond * cosine) / reach
    normal = np.empty_like(sphere)
    for k in (0, 2):
        direction = np.where(centred, model.radial[..., k], sphere[..., k] * inverse)
        normal[..., k] = normal_radial * direction
    normal[..., 1] = normal_axial * outwards
    point = sphere + face.sphere_radius * normal
    force, stiffness, energy = power_law(approach, face.factor, POINT_EXPONENT)
    return _assemble_contacts(
        model,
        pose,
        approach[..., None],
        force[..., None],
        stiffness[..., None],
        energy[..., None],
        centre,
        point[:, :, None, :],
        normal[:, :, None, :],
        by_cone,
    )


def _roller_line(model: ContactModel, roller: Float, pose: ConePose) -> tuple[Float, Float]:
    """Work out the mid-length point and axis of the rollers in cone axes, shape [row, roller, 3]."""
    centre = model.centre + roller[..., 0:1] * model.radial + roller[..., 1:2] * model.axial
    angle = model.bearing.contact_angle + roller[..., 2:3]
    axis = np.cos(angle) * model.axial + np.sin(angle) * model.radial
    return (centre - pose.displacement) @ pose.rotation, axis @ pose.rotation


def _cone_normal(point: Float, outwards: Float, sine: float, cosine: float) -> Float:
    """Work out the unit normal of the cone raceway at `point`, into the cone, in cone axes."""
    distance = np.hypot(point[..., 0], point[..., 2])
    normal = np.empty_like(point)
    normal[..., 0] = -cosine * point[..., 0] / distance
    normal[..., 1] = sine * outwards
    normal[..., 2] = -cosine * point[..., 2] / distance
    return normal


def _assemble_contacts(
    model: ContactModel,
    pose: ConePose,
    approach: Float,
    force: Float,
    stiffness: Float,
    energy: Float,
    centre: Float,
    point: Float,
    normal: Float,
    by_cone: bool,
) -> ContactSet:
    """Assemble a contact set with its derivatives; `centre`, `point`, `normal` are in cone axes."""
    lever = (point - centre[:, :, None, :]) @ pose.rotation.T
    about_centre = _cross(point, normal) @ pose.rotation.T if by_cone else _NOT_ASKED
    normal = normal @ pose.rotation.T
    by_roller = np.empty((*approach.shape, 3))
    by_roller[..., 0] = np.sum(normal * model.radial[:, :, None, :], axis=-1)
    by_roller[..., 1] = np.sum(normal * model.axial[:, :, None, :], axis=-1)
    by_roller[..., 2] = np.sum(_cross(lever, normal) * model.tilt_axis[:, :, None, :], axis=-1)
    following = _NOT_ASKED
    if by_cone:
        following = np.zeros((*approach.shape, 5 + model.bending.shape[-1]))
        following[..., :3] = -normal
        following[..., 3], following[..., 4] = -about_centre[..., 0], -about_centre[..., 2]
    return ContactSet(approach, force, stiffness, energy, by_roller, following)


def _cross(first: Float, second: Float) -> Float:
    """Multiply vectors along the last axis; several times faster than numpy's product on small arrays."""
    product = np.empty_like(first)
    product[..., 0] = first[..., 1] * second[..., 2] - first[..., 2] * second[..., 1]
    product[..., 1] = first[..., 2] * second[..., 0] - first[..., 0] * second[..., 2]
    product[..., 2] = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    return product
