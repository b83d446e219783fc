"""What the contact laboratory found, for the terminal and as JSON."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from beardyn_core.laboratory.findings import EVALUATIONS, SANTOS_HOURS, Findings
from beardyn_core.study.contacts_tables import rolling_summary, tables
from beardyn_core.study.ladder_report import machine


def report(found: Findings) -> str:
    """Write all tables for the terminal."""
    parts = [table.text() for table in tables(found)]
    return "\n\n".join([*parts, f"all of this took {found.seconds:.0f} s on {machine()['processor']}"])


def json_object(found: Findings) -> dict[str, Any]:
    """Give everything as one JSON object; SI units."""
    return {
        "bearing": found.bearing.name,
        "quick": found.quick,
        "machine": machine(),
        "seconds": found.seconds,
        "evaluations": EVALUATIONS,
        "searches_per_evaluation": found.searches_per_evaluation,
        "santos_hours": SANTOS_HOURS,
        "row_difference": found.row_difference,
        "located": [asdict(contact) for contact in found.located],
        "random_rollers": [asdict(result) for result in found.random_rollers],
        "by_contact": {
            name: [asdict(result) for result in results] for name, results in found.by_contact.items()
        },
        "whole_bearing": [
            {**asdict(result), "run_hours": found.run_hours(result)} for result in found.whole_bearing
        ],
        "forms": [asdict(form) for form in found.forms],
        "shapes": [asdict(result) for result in found.shapes],
        "spheres": [asdict(case) for case in found.spheres],
        "rolling": [asdict(rolling_summary(run)) for run in found.rolling],
        "barrel": {
            "name": found.barrel.name,
            "source": found.barrel.source,
            "loads": [
                {key: _listed(value) for key, value in asdict(loads).items()} for loads in found.barrel_loads
            ],
        },
        "tables": [asdict(table) for table in tables(found)],
    }


def _listed(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray) else value
