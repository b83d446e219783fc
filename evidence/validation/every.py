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
    skid,
    spalls,
    statics,
    trends,
    wheelset,
    whirl,
)
from evidence.validation.anchor import Anchor, Trend

ANCHORS: tuple[Anchor, ...] = (
    *statics.ANCHORS,
    *contact.ANCHORS,
    *films.ANCHORS,
    *losses.ANCHORS,
    *heat.ANCHORS,
    *catalogue_values.ANCHORS,
    *life.ANCHORS,
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
        "the source splits its loss formula by attitude; a run has one slip field, whose work cannot be told "
        "apart by its cause",
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
        "ranking of steady temperatures",
        "known from an abstract alone, without load, speed or lubricant",
    ),
)
