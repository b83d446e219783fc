"""Faces of rings that guide roller ends: cones, against which the spheres of the ends rest."""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

from beardyn_core.bearing.contact_law import ExactPointContact, PointContact, rib_contact
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.roller_bearing import RollerBearing


class RibFace(NamedTuple):
    """One rib of a row, the roller in its nominal place.

    Axial is outwards, away from the bearing centre; the generator of the face runs radially outwards.
    """

    ring: str  # ``cup`` or ``cone``
    side: float  # 1.0: outer end of the rollers (large end of tapered ones), -1.0: inner end
    lean: float  # of the normal into the rib against the bearing axis, + radially outwards [rad]
    sphere_radius: float  # of the roller end [m]
    sphere_centre: float  # on the roller axis from mid-length, + outwards [m]
    sphere_place: tuple[float, float]  # radius and axial place of that centre [m]
    edges: tuple[float, float]  # of the face along its generator from the nominal contact [m]
    gap: float  # between end and face along the normal [m]
    contact: PointContact

    @property
    def factor(self) -> float:
        """Stiffness factor K of its contact, Q = K delta^1.5, [N/m^1.5]."""
        return self.contact.factor


@cache
def rib_faces(bearing: RollerBearing) -> tuple[RibFace, ...]:
    """List the faces that guide the roller ends of a row, those of the cone first; barrels have none.

    A barrel is held by cage and guide ring, which carry nothing in statics.
    """
    if isinstance(bearing, Bearing):
        return (_large_rib(bearing),)
    if not isinstance(bearing, CylindricalBearing):
        return ()
    backlash = 0.5 * (bearing.end_play - bearing.roller_play)
    cone = [_flat_rib(bearing, "cone", side, backlash) for side in bearing.cone_rib_sides]
    cup = [_flat_rib(bearing, "cup", side, 0.5 * bearing.roller_play) for side in bearing.cup_rib_sides]
    return (*cone, *cup)


@cache
def faces_of_ring(bearing: RollerBearing, ring: str) -> tuple[RibFace, ...]:
    """List the faces of ``cup`` or ``cone``."""
    return tuple(face for face in rib_faces(bearing) if face.ring == ring)


def _large_rib(bearing: Bearing) -> RibFace:
    """Work out the rib against which the large ends of tapered rollers rest."""
    return RibFace(
        "cone",
        1.0,
        bearing.rib_lean,
        bearing.sphere_radius,
        bearing.sphere_centre,
        bearing.end_sphere,
        bearing.rib_face,
        0.0,
        rib_contact(bearing),
    )


def flat_rib_truncation(bearing: CylindricalBearing, load: float) -> list[str]:
    """State where the contact of a roller end under a load [N] reaches beyond the face of its rib.

    The Hertz contact leaves these borders out: pressure and stiffness are off where they are passed.
    """
    found = []
    for ring, words in (("cone", "inner ring"), ("cup", "outer ring")):
        if not faces_of_ring(bearing, ring):
            continue
        below, above = faces_of_ring(bearing, ring)[0].edges
        reach, room = flat_rib_contact(bearing, ring).semi_axes(load)[1], min(-below, above)
        if reach > room:
            found.append(
                f"under {load:.0f} N the contact of a roller end reaches {reach * 1e3:.2f} mm along the rib "
                f"of the {words}, whose face ends {room * 1e3:.2f} mm from its middle."
            )
    return found


def flat_rib_contact(bearing: CylindricalBearing, ring: str) -> ExactPointContact:
    """Work out the contact of a roller end: along the face the rib is straight, around the ring a cone."""
    radius, height = bearing.end_radius, bearing.rib_contact_height
    if ring == "cone":
        lean, place = -bearing.rib_opening, bearing.cone_radius + height
    else:
        lean, place = bearing.rib_opening, bearing.cup_radius - height
    around = 1.0 / (1.0 / radius - math.sin(lean) / place)
    return ExactPointContact(radius, around, bearing.material.contact_modulus)


def _flat_rib(bearing: CylindricalBearing, ring: str, side: float, play: float) -> RibFace:
    """Work out a rib of a cylindrical roller bearing, an axial play [m] away from the roller end."""
    height, undercut, radius = bearing.rib_contact_height, bearing.rib_undercut, bearing.end_radius
    on_axis = side * (0.5 * bearing.roller_length - radius)
    if ring == "cone":
        lean = -bearing.rib_opening
        edges = undercut - height, bearing.cone_rib_height - height
    else:
        lean = bearing.rib_opening
        edges = height - bearing.cup_rib_height, height - undercut
    return RibFace(
        ring,
        side,
        lean,
        radius,
        on_axis,
        (0.5 * bearing.pitch_diameter, 0.5 * bearing.row_spacing + on_axis),
        edges,
        play * math.cos(lean),
        flat_rib_contact(bearing, ring),
    )
