"""Consistency of a bearing: every contradiction, with the numbers that contradict."""

from __future__ import annotations

import math
from collections.abc import Iterator

from beardyn_core.base.edge import outside
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.contact_law import rib_curvature_radius
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.radial_bearing import RadialBearing
from beardyn_core.bearing.roller_bearing import RollerBearing


def check(bearing: RollerBearing) -> list[str]:
    """List the contradictions of `bearing`, one sentence each; empty when there is none.

    Each names the quantity, its value, what it contradicts and what is allowed.
    """
    problems = _check_numbers(bearing)
    if problems:
        # The closure cannot be computed from numbers that are not numbers or have the wrong sign.
        return problems
    if isinstance(bearing, RadialBearing):
        return [*_check_roller(bearing), *_check_radial_envelope(bearing), *_check_radial_ribs(bearing)]
    assert isinstance(bearing, Bearing)
    checks = (_check_roller, _check_ribs, _check_envelope, _check_angles)
    return [*_check_closure(bearing)] or [problem for found in checks for problem in found(bearing)]


def require_sound(bearing: RollerBearing) -> None:
    """Raise `InputError` with every contradiction of `bearing`, unless the bearing is forced."""
    problems = [] if bearing.forced else check(bearing)
    if problems:
        raise InputError([f"bearing {bearing.name}: {problem}" for problem in problems])


def _mm(length: float) -> str:
    return f"{length * 1e3:.4g} mm"


def _deg(angle: float) -> str:
    return f"{math.degrees(angle):.4g} deg"


def _check_numbers(bearing: RollerBearing) -> list[str]:
    """Find numbers beyond the limits of the fields of the bearing and its parts."""
    problems = [f"{' '.join(map(str, found.place))} {found.text}.".lstrip() for found in outside(bearing)]
    if isinstance(bearing, Bearing) and not bearing.sphere_ratio < 1.0:
        problems.append(
            f"sphere_ratio is {bearing.sphere_ratio:g}; it must lie between 0 and 1, for at 1 the sphere is "
            "centred on the apex and its contact runs off a conical rib."
        )
    return problems


def _check_closure(bearing: Bearing) -> Iterator[str]:
    """Find dimensions for which no cone angle or rib angle exists."""
    if bearing.cone_angle <= 0.0:
        yield (
            f"contact_angle {_deg(bearing.contact_angle)} does not exceed the roller half-angle "
            f"{_deg(bearing.half_angle)} that follows from roller_diameter {_mm(bearing.roller_diameter)} "
            f"and apex distance {_mm(bearing.apex_distance)}; the cone raceway would not be a cone."
        )
    if bearing.roller_length >= 2.0 * bearing.apex_distance:
        yield (
            f"roller_length {_mm(bearing.roller_length)} reaches beyond the apex, which is "
            f"{_mm(bearing.apex_distance)} from mid-length; a smaller length or contact angle is needed."
        )
    elif bearing.rib_contact_height >= bearing.large_end_radius:
        yield (
            f"rib_contact_height {_mm(bearing.rib_contact_height)} is not below the large-end radius "
            f"{_mm(bearing.large_end_radius)}; the rib contact would lie outside the lower half of the "
            "roller end."
        )
    elif bearing.sphere_radius <= bearing.large_end_radius:
        yield (
            f"sphere_ratio {bearing.sphere_ratio:g} gives a sphere radius of {_mm(bearing.sphere_radius)}, "
            f"not above the large-end radius {_mm(bearing.large_end_radius)}; usual ratios are 0.8 to 0.95."
        )
    elif bearing.rib_polar_angle >= bearing.contact_angle:
        yield (
            f"the rib normal leans {_deg(bearing.rib_polar_angle)} from the roller axis, not less than "
            f"contact_angle {_deg(bearing.contact_angle)}; "
            f"rib_contact_height {_mm(bearing.rib_contact_height)} and "
            f"sphere radius {_mm(bearing.sphere_radius)} leave no conical rib."
        )


def _check_roller(bearing: RollerBearing) -> Iterator[str]:
    if bearing.effective_length > bearing.roller_length:
        yield (
            f"effective_length {_mm(bearing.effective_length)} exceeds "
            f"roller_length {_mm(bearing.roller_length)}."
        )
    chord = bearing.roller_diameter + bearing.roller_web
    if bearing.roller_web <= 0.0:
        yield (
            f"{bearing.roller_count} rollers of roller_diameter {_mm(bearing.roller_diameter)} overlap on "
            f"pitch_diameter {_mm(bearing.pitch_diameter)}, where their axes are only {_mm(chord)} apart."
        )
    elif bearing.cage.circumferential_clearance >= bearing.roller_web:
        yield (
            f"cage circumferential_clearance {_mm(bearing.cage.circumferential_clearance)} is not below the "
            f"free distance {_mm(bearing.roller_web)} between rollers; no bar would be left."
        )


def _check_ribs(bearing: Bearing) -> Iterator[str]:
    """Check that the roller end touches the rib between undercut and corner, inside the roller's rim."""
    height, undercut = bearing.rib_contact_height, bearing.rib_undercut
    if not height < bearing.rib_height:
        yield (
            f"rib_contact_height {_mm(height)} is not below rib_height {_mm(bearing.rib_height)}; the sphere "
            "would bear on the outer corner of the rib."
        )
    if not height > undercut:
        yield (
            f"rib_contact_height {_mm(height)} is not above rib_undercut {_mm(undercut)}; the sphere would "
            "bear on the edge of the undercut."
        )
    if not height > bearing.roller_chamfer:
        yield (
            f"rib_contact_height {_mm(height)} is not above roller_chamfer {_mm(bearing.roller_chamfer)}; "
            "the rib would meet the corner of the roller."
        )
    if bearing.rib_height >= 2.0 * bearing.large_end_radius:
        yield (
            f"rib_height {_mm(bearing.rib_height)} is not below the diameter of the large end, "
            f"{_mm(2.0 * bearing.large_end_radius)}."
        )
    if bearing.small_rib_height >= bearing.small_end_radius:
        yield (
            f"small_rib_height {_mm(bearing.small_rib_height)} is not below the small-end radius "
            f"{_mm(bearing.small_end_radius)}."
        )
    radius = rib_curvature_radius(bearing)
    if bearing.sphere_radius >= radius:
        yield (
            f"sphere_ratio {bearing.sphere_ratio:g} gives a sphere radius of {_mm(bearing.sphere_radius)}, "
            f"not below the rib's radius of curvature {_mm(radius)} at the contact; the roller end would "
            "bear on its rim."
        )


def _check_envelope(bearing: Bearing) -> Iterator[str]:
    pitch_radius = 0.5 * bearing.pitch_diameter
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    half_length = 0.5 * bearing.roller_length
    innermost = pitch_radius - half_length * sine - bearing.small_end_radius * cosine
    outermost = pitch_radius + half_length * sine + bearing.large_end_radius * cosine
    if innermost <= 0.5 * bearing.bore:
        yield (
            f"the cone raceway's smallest radius {_mm(innermost)}, from pitch_diameter "
            f"{_mm(bearing.pitch_diameter)}, is not above half the bore, {_mm(0.5 * bearing.bore)}."
        )
    if outermost >= 0.5 * bearing.outer_diameter:
        yield (
            f"the cup raceway's largest radius {_mm(outermost)}, from pitch_diameter "
            f"{_mm(bearing.pitch_diameter)}, is not below half the outer_diameter, "
            f"{_mm(0.5 * bearing.outer_diameter)}."
        )
    extent = bearing.roller_length * cosine + 2.0 * bearing.small_end_radius * sine
    if bearing.row_spacing <= extent:
        yield (
            f"row_spacing {_mm(bearing.row_spacing)} is not above the axial extent of a roller, "
            f"{_mm(extent)}; the rows would run into each other."
        )
    span = bearing.row_spacing + bearing.roller_length * cosine + 2.0 * bearing.large_end_radius * sine
    if span >= bearing.width:
        yield (
            f"both rows span {_mm(span)} along the axle, not less than the width {_mm(bearing.width)}; "
            f"row_spacing is {_mm(bearing.row_spacing)}."
        )


def _check_angles(bearing: Bearing) -> Iterator[str]:
    for key, stated, closed in (
        ("nominal_cup_angle", bearing.nominal_cup_angle, bearing.cup_angle),
        ("nominal_cone_angle", bearing.nominal_cone_angle, bearing.cone_angle),
    ):
        if stated is not None and not abs(stated - closed) <= bearing.angle_tolerance:
            yield (
                f"{key} {_deg(stated)} contradicts the {_deg(closed)} that close on a common apex with "
                f"pitch_diameter {_mm(bearing.pitch_diameter)}, "
                f"roller_diameter {_mm(bearing.roller_diameter)} and "
                f"contact_angle {_deg(bearing.contact_angle)}; "
                f"angle_tolerance is {_deg(bearing.angle_tolerance)}."
            )


def _check_radial_envelope(bearing: RadialBearing) -> Iterator[str]:
    """Check that rings are left inside and outside of the rollers, and that there is room for both rows."""
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    half, radius = 0.5 * bearing.roller_length, 0.5 * bearing.roller_diameter
    lowest = 0.5 * bearing.pitch_diameter - radius * cosine - half * sine
    if lowest <= 0.5 * bearing.bore:
        yield (
            f"the inner raceway's smallest radius {_mm(lowest)}, from pitch_diameter "
            f"{_mm(bearing.pitch_diameter)}, is not above half the bore, {_mm(0.5 * bearing.bore)}."
        )
    highest = bearing.centre_distance + radius
    if highest >= 0.5 * bearing.outer_diameter:
        yield (
            f"the outer raceway's radius {_mm(highest)}, from pitch_diameter "
            f"{_mm(bearing.pitch_diameter)} and roller_diameter {_mm(bearing.roller_diameter)}, is not below "
            f"half the outer_diameter, {_mm(0.5 * bearing.outer_diameter)}."
        )
    # inner ends of barrels lie farther from the axis and nearer to each other above their middle
    inner = 0.5 * bearing.row_spacing - half * cosine
    if inner <= 0.0:
        yield (
            f"rows of rollers of roller_length {_mm(bearing.roller_length)} run into each other at a row "
            f"spacing of {_mm(bearing.row_spacing)}."
        )
    span = bearing.row_spacing + bearing.roller_length * cosine
    if span >= bearing.width:
        yield (
            f"both rows span {_mm(span)} along the axle, not less than the width {_mm(bearing.width)}; "
            f"the row spacing is {_mm(bearing.row_spacing)}."
        )


def _check_radial_ribs(bearing: RadialBearing) -> Iterator[str]:
    """Check that cylinders touch their ribs between undercut and corner, and have room between them."""
    if not isinstance(bearing, CylindricalBearing):
        return
    height, radius = bearing.rib_contact_height, 0.5 * bearing.roller_diameter
    if not height < radius:
        yield (
            f"rib_contact_height {_mm(height)} is not below the radius of the rollers, {_mm(radius)}; the "
            "roller end would touch on its other half."
        )
    if not height > bearing.rib_undercut:
        yield (
            f"rib_contact_height {_mm(height)} is not above rib_undercut {_mm(bearing.rib_undercut)}; the "
            "roller end would bear on the edge of the undercut."
        )
    for key, ribs in (("cup_rib_height", bearing.cup_ribs), ("cone_rib_height", bearing.cone_ribs)):
        if ribs != "none" and not height < getattr(bearing, key):
            yield (
                f"rib_contact_height {_mm(height)} is not below {key} {_mm(getattr(bearing, key))}; the "
                "roller end would bear on the corner of the rib."
            )
    if bearing.end_play < bearing.roller_play:
        yield (
            f"end_play {_mm(bearing.end_play)} is less than roller_play {_mm(bearing.roller_play)}: ribs of "
            "both rings would press the rollers together before the axle has used its travel."
        )
