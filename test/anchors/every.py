"""All anchors and trends, in the order of the validation page."""

from __future__ import annotations

from test.anchors import catalogue_values, dynamics, life, rail, statics, trends
from test.anchors.anchor import Anchor, Trend

ANCHORS: tuple[Anchor, ...] = (
    *statics.ANCHORS,
    *catalogue_values.ANCHORS,
    *life.ANCHORS,
    *dynamics.ANCHORS,
    *rail.ANCHORS,
)

TRENDS: tuple[Trend, ...] = (*trends.TRENDS,)

UNREACHED: tuple[tuple[str, str], ...] = ()
