"""All hard cases, in the order of the table."""

from __future__ import annotations

from evidence.hard import (
    cases_endurance,
    cases_faults,
    cases_geometry,
    cases_load,
    cases_lubricant,
    cases_numerics,
    cases_speed,
)
from evidence.hard.case import HardCase

CASES: tuple[HardCase, ...] = (
    *cases_load.CASES,
    *cases_speed.CASES,
    *cases_lubricant.CASES,
    *cases_geometry.CASES,
    *cases_faults.CASES,
    *cases_numerics.CASES,
    *cases_endurance.CASES,
)
