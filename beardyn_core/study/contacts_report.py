"""What the contact laboratory found, for the terminal and as JSON."""

from __future__ import annotations

from dataclasses import asdict, is_dataclass
from typing import Any

from beardyn_core.laboratory.findings import EVALUATIONS, SANTOS_HOURS, Findings
from beardyn_core.laboratory.timing import MethodResult
from beardyn_core.study.contacts_tables import rolling_summary, tables
from beardyn_core.study.ladder_report import machine

# field of a result -> key of the JSON object; what has no unit keeps its name
_KEYS = {
    "way": "method",
    "ways": "methods",
    **{
        name: f"{name}_m"
        for name in (
            *("abscissa", "gap", "plain_difference", "compiled_difference", "p", "q", "largest_error"),
            *("radius", "search_height", "bounded_height", "search_gap", "bounded_depth", "displacement"),
            *("formula_displacement", "start_height", "reached_height"),
        )
    },
    **{name: f"{name}_N" for name in ("force", "load", "formula", "integral_largest")},
    **{name: f"{name}_rad" for name in ("azimuth", "contact_angle", "largest_lean")},
    **{
        name: f"{name}_J"
        for name in (
            *("friction", "damping", "kinetic_left", "lost_potential", "residual", "initial_potential"),
        )
    },
    "transition_speed": "transition_speed_m_per_s",
    "turning_time": "turning_time_s",
}


def report(found: Findings) -> str:
    """Write all tables for the terminal."""
    parts = [table.text() for table in tables(found)]
    return "\n\n".join([*parts, f"all of this took {found.seconds:.0f} s on {machine()['processor']}"])


def json_object(found: Findings) -> dict[str, Any]:
    """Gather everything for JSON, SI units in the keys."""
    return {
        "bearing": found.bearing.name,
        "quick": found.quick,
        "machine": machine(),
        "wall_time_s": found.seconds,
        "evaluations": EVALUATIONS,
        "searches_per_evaluation": found.searches_per_evaluation,
        "santos_2017_s": {method: 3600.0 * hours for method, hours in SANTOS_HOURS.items()},
        "row_difference_m": found.row_difference,
        "located": _in_si(found.located),
        "random_rollers": _in_si(found.random_rollers),
        "by_contact": {name: _in_si(results) for name, results in found.by_contact.items()},
        "whole_bearing": [
            {**_in_si(result), "run_s": 3600.0 * found.run_hours(result)} for result in found.whole_bearing
        ],
        "forms": _in_si(found.forms),
        "shapes": _in_si(found.shapes),
        "spheres": _in_si(found.spheres),
        "rolling": _in_si([rolling_summary(run) for run in found.rolling]),
        "barrel": {
            "name": found.barrel.name,
            "source": found.barrel.source,
            "loads": _in_si(found.barrel_loads),
        },
        "tables": [asdict(table) for table in tables(found)],
    }


def _in_si(value: Any) -> Any:
    """Turn results into mappings whose keys end in the SI unit, those inside of them included."""
    if isinstance(value, (list, tuple)):
        return [_in_si(each) for each in value]
    if isinstance(value, MethodResult):
        values = {**vars(value), "time_s": 1e-6 * value.microseconds}
        del values["microseconds"]
    elif is_dataclass(value):
        values = vars(value)
    else:
        return value
    return {_KEYS.get(key, key): _in_si(each) for key, each in values.items()}
