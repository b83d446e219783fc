"""Contact laws, load zones and static load distributions."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache, partial

from beardyn_core.bearing.contact_law import (
    PointContact,
    line_contact_factor,
)
from beardyn_core.config import load_bearing
from beardyn_core.physics.statics.roller_equilibrium import roller_forces
from beardyn_core.physics.statics.static import StaticSolution, solve
from evidence.validation.anchor import Anchor
from evidence.validation.ball_contact import curvature_difference, curvature_sum
from evidence.validation.load_zone import axial_integral, radial_integral
from evidence.validation.zhang import published_model, solved_model

ZHANG = "Zhang, Lv, Han, Li 2023, Sensors 23:4967, Table 3"
KUMAR = "Kumar 2005 REBM as quoted by TRB_StiffnessSolver.m; K = 7.86e4 l^(8/9) taken for the whole roller"
HARRIS = "Harris, Rolling Bearing Analysis"
ISO_ROLLER = 35948.0  # c_L of a roller between both raceways, N/mm^(10/9)/mm^(8/9)
D_BRAIN = "D-BRAIN unit tests (NSK core technology)"
DERIVED = "derived, rigid rings, no clearance"
SOFTER = "derived with the ISO constant, 3.7 % softer per contact than Palmgren's"


@lru_cache
def static(load: tuple[float, float, float], tilt: str = "locked") -> StaticSolution:
    """Solve the static equilibrium of HS130x230 without clearance."""
    return solve(load_bearing("HS130x230"), load, end_play=0.0, tilt=tilt)


def kumar_stiffness(axial: float, direction: str = "z", in_series: bool = False) -> float:
    """Return the stiffness of a single row under pure thrust, MN/mm, closed form.

    Across the axis (``x``) the same roller stiffness counts with cos^2/2 where it has sin^2 along it.
    ``in_series``: 7.86e4 is that of each of the two contacts of a roller, as ISO/TS 16281 has it.
    """
    count, length, angle = 20, 18.251, math.radians(31.128)
    factor = 7.86e4 * length ** (8.0 / 9.0)
    if in_series:
        factor *= ISO_ROLLER / 7.86e4
    load = axial / (count * math.sin(angle))
    approach = (load / factor) ** 0.9
    along = 10.0 / 9.0 * axial / (approach / math.sin(angle)) / 1e6
    return along if direction == "z" else 0.5 * along / math.tan(angle) ** 2


def ball_curvature(outer: bool) -> tuple[float, float, float, float]:
    """Return the four curvatures of the contact of a 209 ball bearing, [1/mm]."""
    ball, pitch, groove = 12.7, 65.0, 0.52 * 12.7
    gamma = ball / pitch
    ring = -2 * gamma / (ball * (1 + gamma)) if outer else 2 * gamma / (ball * (1 - gamma))
    return (2 / ball, 2 / ball, ring, -1 / groove)


def zhang_triangle(which: int) -> float:
    """Return one of the cup, cone and rib loads from the force triangle, [N]."""
    cup, cone, rib = (math.radians(angle) for angle in (22.54, 16.24, 70.20))
    centrifugal = 0.126 * (1200.0 * math.pi / 30.0) ** 2 * 0.19893 / 2.0
    return float(roller_forces(1304.8, cup, cone, rib, centrifugal)[which])


def bounce_frequency(load: float, mass: float | None = None) -> float:
    """Return the natural frequency of a roller, or of one of another mass [kg], between both raceways, Hz."""
    bearing = load_bearing("HS130x230")
    factor = line_contact_factor(bearing.material, bearing.effective_length)
    tangent = 10.0 / 9.0 * factor**0.9 * load**0.1
    return math.sqrt(2.0 * tangent / (bearing.roller_mass if mass is None else mass)) / (2.0 * math.pi)


HERTZ = PointContact(5.5289e-3, 189.645e-3, 228.571e9)
TEXTBOOK = PointContact(10.7e-3, 20.0e-3, 231e9)

RADIAL_LOAD, BOTH_LOADS, LIGHT_LOAD = (0.0, 0.0, 80e3), (0.0, 15e3, 80e3), (0.0, 0.0, 5e3)
# Quantity, unit, source, tolerance, and how it is read from the equilibrium of a load and a cup tilt.
STATIC_QUANTITIES: tuple[tuple[str, str, str, float, Callable[..., float]], ...] = (
    ("loaded rollers in the fuller row", "", DERIVED, 0.0, lambda *at: max(static(*at).loaded_roller_count)),
    ("loaded rollers in the other row", "", DERIVED, 0.0, lambda *at: min(static(*at).loaded_roller_count)),
    ("largest roller load", "N", DERIVED, 5e-3, lambda *at: static(*at).largest_roller_load),
    (
        "the same in the other row",
        "N",
        DERIVED,
        5e-3,
        lambda *at: float(static(*at).cup_load.max(axis=1).min()),
    ),
    ("radial displacement", "um", SOFTER, 0.035, lambda *at: static(*at).displacement[2] * 1e6),
    ("axial displacement", "um", SOFTER, 0.035, lambda *at: static(*at).displacement[1] * 1e6),
    (
        "radial stiffness, tilt held",
        "GN/m",
        SOFTER,
        0.035,
        lambda *at: static(*at).stiffness_tilt_held[2, 2] / 1e9,
    ),
    (
        "axial stiffness, tilt held",
        "GN/m",
        SOFTER,
        0.035,
        lambda *at: static(*at).stiffness_tilt_held[1, 1] / 1e9,
    ),
)
STATIC_TABLE = (
    ("80 kN radial", RADIAL_LOAD, "locked", (9, 9, 9835.0, 9835.0, 13.9, 0.0, 6.38, 0.58)),
    (
        "80 kN radial, 15 kN axial, tilt free",
        BOTH_LOADS,
        "free",
        (17, 7, 11875.0, 11652.0, 16.4, 47.5, 9.35, 0.79),
    ),
    ("5 kN radial", LIGHT_LOAD, "locked", (9, 9, 615.0, 615.0, 1.1, 0.0, 4.84, 0.44)),
)

ANCHORS = (
    Anchor(
        "roller bounce",
        "roller bounce at 615 N",
        16.4,
        "kHz",
        SOFTER,
        lambda: bounce_frequency(615.0) / 1e3,
        tolerance=0.02,
    ),
    Anchor(
        "roller bounce",
        "band of the published spectrum, taken for roller bounce",
        30.0,
        "kHz",
        "Santos 2017, spectrum; no tolerance given",
        lambda: bounce_frequency(615.0) / 1e3,
        tolerance=0.1,
        misses="a roller of 228 g bounces at 17 kHz; 30 kHz would be one of 71 g, or come from its numerics",
    ),
    *(
        Anchor(
            "load zone",
            f"load-zone integral {name}({extent:g}), exponent 10/9",
            value,
            "",
            "derived, numerical",
            partial(integral, extent),
            absolute=1e-3,
            beside=True,
        )
        for name, integral, values in (
            ("J_r", radial_integral, (0.2050, 0.2448, 0.2525)),
            ("J_a", axial_integral, (0.2327, 0.3080, 0.4798)),
        )
        for extent, value in zip((0.3, 0.5, 1.0), values, strict=True)
    ),
    Anchor(
        "load zone",
        "load-zone integral J_r(0.5), exponent 1.1",
        0.2453,
        "",
        HARRIS,
        lambda: radial_integral(0.5, 1.1),
        absolute=1e-3,
        beside=True,
    ),
    Anchor(
        "load zone",
        "load-zone integral J_a(0.5), exponent 1.1",
        0.3090,
        "",
        HARRIS,
        lambda: axial_integral(0.5, 1.1),
        absolute=1e-3,
        beside=True,
    ),
    Anchor(
        "largest roller load",
        "largest roller load, 80 kN radial, no clearance",
        9835.0,
        "N",
        "derived, 34 rollers one by one",
        lambda: static((0, 0, 80e3)).largest_roller_load,
        tolerance=5e-3,
    ),
    Anchor(
        "largest roller load",
        "the same after Stribeck, 4.08 F/(i Z cos a)",
        9810.0,
        "N",
        "Stribeck's number for line contact",
        lambda: static((0, 0, 80e3)).largest_roller_load,
        tolerance=5e-3,
    ),
    Anchor(
        "Zhang 2023",
        "HH926700, 1.5 kN radial, 5 kN axial: the published model",
        1304.8,
        "N",
        ZHANG,
        lambda: published_model(1500.0, 5000.0),
        tolerance=1e-3,
        beside=True,
    ),
    Anchor(
        "Zhang 2023",
        "the same with rollers between cup, cone and rib",
        1304.8,
        "N",
        ZHANG,
        lambda: solved_model(1500.0, 5000.0).largest_roller_load,
        tolerance=5e-3,
        beside=True,
    ),
    Anchor("Zhang 2023", "its cone load", 1119.3, "N", ZHANG, lambda: zhang_triangle(0), tolerance=1e-3),
    Anchor("Zhang 2023", "its rib load", 198.9, "N", ZHANG, lambda: zhang_triangle(1), tolerance=1e-3),
    *(
        Anchor(
            "Kumar 2005",
            f"REBM {name} stiffness at {load:g} kN, published convention",
            value,
            "MN/mm",
            KUMAR,
            partial(kumar_stiffness, 1e3 * load, direction),
            tolerance=tolerance,
        )
        for name, direction, tolerance, values in (
            ("axial", "z", 5e-3, (2.80, 3.53)),
            ("radial", "x", 0.04, (3.84, 4.83)),
        )
        for load, value in zip((4.0, 40.0), values, strict=True)
    ),
    Anchor(
        "Kumar 2005",
        "axial stiffness with two contacts in series over the published convention",
        0.495,
        "",
        "derived after ISO/TS 16281; Kumar 2005 measured about half of the REBM stiffness",
        lambda: kumar_stiffness(4e3, in_series=True) / kumar_stiffness(4e3),
        tolerance=5e-3,
    ),
    Anchor(
        "Hertz contact",
        "Hertz point contact, force at 9.164 um",
        972.39,
        "N",
        D_BRAIN,
        lambda: HERTZ.factor * 9.164e-6**1.5,
        tolerance=1e-4,
    ),
    Anchor(
        "Hertz contact",
        "its larger semi-axis",
        1.6211,
        "mm",
        D_BRAIN,
        lambda: HERTZ.semi_axes(HERTZ.factor * 9.164e-6**1.5)[0] * 1e3,
        tolerance=1e-4,
    ),
    Anchor(
        "Hertz contact",
        "its smaller semi-axis",
        0.16553,
        "mm",
        D_BRAIN,
        lambda: HERTZ.semi_axes(HERTZ.factor * 9.164e-6**1.5)[1] * 1e3,
        tolerance=1e-4,
    ),
    Anchor(
        "Hertz contact",
        "textbook point contact, force at 1.89 um",
        50.0,
        "N",
        D_BRAIN,
        lambda: TEXTBOOK.factor * 1.89e-6**1.5,
        tolerance=0.025,
    ),
    Anchor(
        "curvature",
        "209 ball bearing, curvature sum of the inner ring",
        0.202,
        "1/mm",
        HARRIS,
        lambda: curvature_sum(ball_curvature(False)),
        absolute=5e-4,
        beside=True,
    ),
    Anchor(
        "curvature",
        "its curvature difference, inner ring",
        0.9399,
        "",
        HARRIS,
        lambda: curvature_difference(ball_curvature(False)),
        tolerance=1e-3,
        beside=True,
    ),
    Anchor(
        "curvature",
        "its curvature difference, outer ring",
        0.9120,
        "",
        HARRIS,
        lambda: curvature_difference(ball_curvature(True)),
        tolerance=1e-3,
        beside=True,
    ),
    *(
        Anchor(
            "static equilibrium",
            f"{case}: {quantity}",
            value,
            unit,
            source,
            partial(read, load, tilt),
            tolerance,
        )
        for case, load, tilt, values in STATIC_TABLE
        for (quantity, unit, source, tolerance, read), value in zip(STATIC_QUANTITIES, values, strict=True)
        if value
    ),
)
