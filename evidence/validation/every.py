"""All anchors and trends, in the order of the validation page."""

from __future__ import annotations

from evidence.validation import (
    catalogue_values,
    contact,
    dynamics,
    films,
    heat,
    life,
    losses,
    rail,
    rigs,
    roller_kinds,
    roller_loads,
    runs_of_kinds,
    skid,
    spalls,
    statics,
    trends,
    wheel_waves,
    wheelset,
    whirl,
)
from evidence.validation.anchor import Anchor, Trend

ANCHORS: tuple[Anchor, ...] = (
    *statics.ANCHORS,
    *roller_loads.ANCHORS,
    *contact.ANCHORS,
    *films.ANCHORS,
    *losses.ANCHORS,
    *rigs.ANCHORS,
    *heat.ANCHORS,
    *catalogue_values.ANCHORS,
    *life.ANCHORS,
    *roller_kinds.ANCHORS,
    *runs_of_kinds.ANCHORS,
    *dynamics.ANCHORS,
    *rail.ANCHORS,
    *wheelset.ANCHORS,
    *spalls.ANCHORS,
)

TRENDS: tuple[Trend, ...] = (
    *dynamics.TRENDS,
    *trends.TRENDS,
    *whirl.TRENDS,
    *skid.TRENDS,
    *heat.TRENDS,
    *wheel_waves.TRENDS,
    *wheelset.TRENDS,
    *spalls.TRENDS,
)

UNREACHED: tuple[tuple[str, str], ...] = (
    (
        "Zhao et al. 2026, the full loss of 1880.5 W",
        "it holds the share of skew, tilt and ribs as a formula of measured attitudes; the rows above "
        "compare the part that rolling alone makes",
    ),
    (
        "Zhao et al. 2026, skew and tilt make 11 to 21 % of the loss, tilt 2.5 times as much as skew",
        "the source splits its loss formula by attitude; a run has one slip field, whose work cannot be "
        "divided by its cause",
    ),
    (
        "coefficients of restitution",
        "contacts lose energy in proportion to their stiffness and approach speed, as lubricated contacts "
        "that stay closed do; there is no law of impact with a given restitution",
    ),
    (
        "guiding land of ADORE-like codes",
        "the published friction torque lacks a radius (its unit is newton); ours follows Petroff",
    ),
    (
        "published vibration data sets (CWRU, BJTU-RAO, SWJTU)",
        "their bearings' internals are not published; kinematic frequencies are compared, amplitudes are not",
    ),
    (
        "Hou et al. 2024, Rail. Eng. Sci. 32, 444, roller loads of an axlebox bearing in service",
        "its figures and tables were not at hand; the relations of its abstract are among the trends, and "
        "from the same method the number of loaded rollers is compared, Zhao et al. 2026",
    ),
    (
        "cage slip measured on rigs in per cent (Smith 1962, Harris 1966, Guo and Keller 2020, Dawoud 2022)",
        "no source found gives slip, load, speed, oil and the inside of a bearing together; "
        "statements of their abstracts are among the trends",
    ),
    (
        "levels of impacts measured on axleboxes and rigs (Tarawneh and others, Pueblo 1999)",
        "no source found gives level, sensor, bearing and spall together; relations: docs/evidence/impact.md",
    ),
    (
        "torque of a LM12700 (Zhou and Hoeprich 1991), HM801349 (Cruz et al. 2021), 32208 (Machines 13:910)",
        "measured, but the viscosity, the load (worked back from a starting torque) and the oil are not "
        "stated",
    ),
    (
        "torque and stiffness of the bearings of a disc cutter (Lubricants 2025, 13, 160, Tables 5 and 6)",
        "measured from 5 to 60 kN, but the torque is that of breaking loose, the number of rollers "
        "not stated",
    ),
    (
        "heat of bearings of class K and F on rigs (Tarawneh and others 2008 to 2012), service temperatures "
        "of FRA/ORD-80/43 and of double-stack cars (McCown and Moser 1988)",
        "only their abstracts were at hand, without watts or degrees",
    ),
    (
        "ranking of steady temperatures",
        "known from an abstract alone, without load, speed or lubricant",
    ),
)
