"""What the contact laboratory found, as tables and as JSON."""

from __future__ import annotations

from dataclasses import asdict, is_dataclass, replace
from typing import Any

import numpy as np

from beardyn_core.laboratory import findings
from beardyn_core.laboratory.barrel import BarrelLoads
from beardyn_core.laboratory.nine_contacts import PAIRINGS, SEARCHES_PER_ROLLER
from beardyn_core.laboratory.rolling import Rolling
from beardyn_core.laboratory.timing import MethodResult
from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
from beardyn_core.study.ladder_report import machine
from beardyn_core.study.table import Column, Table, digits, duration_text, nanometres, percent

TWIN_STEPS_PER_SAMPLE = 4
TWIN_EVALUATIONS = round(findings.RUN_SECONDS * WAVEFORM_RATE * TWIN_STEPS_PER_SAMPLE)
_METRES = (
    *("abscissa", "gap", "plain_difference", "compiled_difference", "p", "q", "largest_error"),
    *("radius", "search_height", "bounded_height", "search_gap", "bounded_depth", "displacement"),
    "formula_displacement",
)
# field of a result -> key of the JSON object; what has no unit keeps its name
_KEYS = {
    **{name: f"{name}_m" for name in _METRES},
    **{name: f"{name}_N" for name in ("force", "load", "formula", "integral_largest")},
    **{name: f"{name}_rad" for name in ("azimuth", "contact_angle")},
}


def _steps(result: Any) -> str:
    return "-" if result.iterations is None else f"{result.iterations:.1f}"


_METHOD_COLUMNS: tuple[Column, ...] = (
    ("method", lambda result: result.method),
    ("CPU us per search", lambda result: digits(result.microseconds)),
    ("iterations", _steps),
    ("failures [%]", lambda result: percent(result.failures)),
    ("gap error [nm]", lambda result: nanometres(result.largest_error)),
)


def _located_table(found: findings.Findings) -> Table:
    def name(contact: findings.LocatedContact) -> str:
        is_disc = contact.name in ("Inner", "Outer")
        return f"{contact.name}, x = {contact.abscissa * 1e3:+.1f} mm" if is_disc else contact.name

    return Table.of(
        f"Nine contacts at the first time step ({found.bearing.name}, {findings.LOAD / 1e3:g} kN, "
        "most loaded roller)",
        found.located,
        (
            ("contact", name),
            ("gap [um]", lambda contact: f"{contact.gap * 1e6:.4f}"),
            ("closed form [nm]", lambda contact: nanometres(contact.plain_difference)),
            ("twin's kernel [nm]", lambda contact: nanometres(contact.compiled_difference)),
            ("place x, y, z [mm]", lambda contact: ", ".join(f"{value * 1e3:.3f}" for value in contact.q)),
        ),
        "gap by the general search; then how far the closed forms are from it; negative: pressed",
        f"largest difference over all {SEARCHES_PER_ROLLER * found.bearing.roller_count} searches of the "
        f"row: {nanometres(found.row_difference)} nm",
    )


def _methods_table(found: findings.Findings) -> Table:
    return Table.of(
        "Random rollers (shifted by 50 um, turned by 2 mrad; start: the nominal roller)",
        found.random_rollers,
        _METHOD_COLUMNS,
        "iterations of fsolve: evaluations of the equations; gap error: largest, against the plain "
        "closed form (nine contacts of the text, 19 searches a roller)",
    )


def _contacts_table(found: findings.Findings) -> Table:
    heads = (
        *("fsolve", "numeric", "analytic", "closed"),
        *("fsolve, compiled eq.", "numeric, compiled", "analytic, compiled"),
    )
    return Table.of(
        "Each contact on random rollers [CPU us per search]",
        found.by_contact.items(),
        (
            ("contact", lambda item: f"{item[0]}: {PAIRINGS[item[0]][0]}"),
            *(
                (head, lambda item, k=place: digits(item[1][k].microseconds))
                for place, head in enumerate(heads)
            ),
            ("Newton steps", lambda item: _steps(item[1][6])),
            ("failures [%]", lambda item: percent(max(result.failures for result in item[1]))),
        ),
    )


def _run_table(found: findings.Findings) -> Table:
    """Compare Santos (2017), Table 1, with our times, extrapolated to its run."""

    def santos(result: MethodResult) -> str:
        name, _, way = result.method.partition(", ")
        hours = findings.SANTOS_HOURS.get(name) if way == "plain" else None
        return "-" if hours is None else f"{findings.CONTACT_SHARE * hours:.1f} h of {hours:g} h"

    closed = found.whole_bearing[-1]
    twin = duration_text(found.run_hours(closed, TWIN_EVALUATIONS))
    table = Table.of(
        f"A whole row, warm starts, and contact detection of a run of {findings.RUN_SECONDS:g} s",
        found.whole_bearing,
        (
            *_METHOD_COLUMNS,
            ("run", lambda result: duration_text(found.run_hours(result))),
            ("Santos (2017)", santos),
        ),
        f"run: {found.searches_per_evaluation} searches x {findings.EVALUATIONS} evaluations "
        f"(Runge-Kutta 4(5), mean step {findings.MEAN_STEP * 1e6:g} us, {findings.EVALUATIONS_PER_STEP} "
        f"evaluations a step), detection alone; the twin's step: {TWIN_EVALUATIONS} evaluations",
        f"Santos (2017): {findings.CONTACT_SHARE:.0%} of its time, which the paper assigns to the contact "
        "points",
    )
    last = ("the same at the twin's step", digits(closed.microseconds), "-", "-", "-", twin, "-")
    return replace(table, rows=(*table.rows, last))


def _forms_table(found: findings.Findings) -> Table:
    """Compare three readings of the surface-surface conditions."""
    return Table.of(
        "Conditions of the surface-surface contact FR (sphere on rib), random rollers",
        found.forms,
        (
            ("conditions", lambda form: form.form),
            ("failures [%]", lambda form: percent(form.failures)),
            ("Newton steps", _steps),
            ("condition number", lambda form: f"{form.condition:.0f}"),
            (
                "unskewed",
                lambda form: f"{form.even_condition:.0f}" if form.even_condition < 1e12 else "singular",
            ),
        ),
        "failures: not converged within 30 steps, or more than 1 nm off; unskewed: the condition number "
        "with the roller in its place",
    )


def _shapes_table(found: findings.Findings) -> Table:
    names = ("fsolve", "numeric", "analytic")
    return Table.of(
        "Random circles, spheres and cylinders",
        found.shapes,
        (
            ("pair", lambda result: f"{result.case}, {result.start} start"),
            *(
                (f"{name} [us]", lambda result, k=place: digits(result.methods[k].microseconds))
                for place, name in enumerate((*names, "compiled"))
            ),
            ("Newton steps", lambda result: _steps(result.methods[-1])),
            *(
                (f"{name} fails [%]", lambda result, k=place: percent(result.methods[k].failures))
                for place, name in enumerate(names)
            ),
            ("elsewhere [%]", lambda result: percent(result.elsewhere)),
            ("gap error [nm]", lambda result: nanometres(result.methods[-1].largest_error)),
        ),
        "a failure did not converge, or found another pair of points than the nearest; elsewhere: "
        "those that converged to such a pair (analytic Newton, compiled)",
        "near start: parameters nearest to the other's centre; random start: anywhere",
    )


def _spheres_table(found: findings.Findings) -> Table:
    bearing = found.bearing
    return Table.of(
        "Roller end on a given rib, pushed in by 10 um, skewed by 0.5 mrad",
        found.spheres,
        (
            ("sphere ratio", lambda case: f"{case.ratio:.2f} ({case.radius * 1e3:.0f} mm)"),
            (
                "search: height [mm]",
                lambda case: f"{case.search_height * 1e3:.2f}" if case.search_converged else "none",
            ),
            ("gap [um]", lambda case: f"{case.search_gap * 1e6:+.1f}" if case.search_converged else "none"),
            ("on the part", lambda case: "yes" if case.on_face and case.in_rim else "no"),
            ("bounded: height [mm]", lambda case: f"{case.bounded_height * 1e3:.2f}"),
            ("gap [um]", lambda case: f"{-case.bounded_depth * 1e6:+.1f}"),
            ("bears on", lambda case: case.carried_by),
            ("check", lambda case: "refused" if case.refused else "accepted"),
        ),
        f"height of the contact over the cone raceway; the rib face reaches from "
        f"{bearing.rib_undercut * 1e3:g} to {bearing.rib_height * 1e3:g} mm, the spherical face of the "
        f"roller ends at {bearing.roller_chamfer * 1e3:g} mm",
    )


def _rolling_summary(run: Rolling) -> dict[str, Any]:
    """List the numbers of a rolling run, those of its energy at the turning point on the other side."""
    k, energies = run.turning_sample, run.energies
    return {
        "name": run.body.name,
        "transition_speed_m_per_s": run.trough.transition_speed,
        "turning_time_s": float(run.time[k]),
        "start_height_m": float(run.height[0]),
        "reached_height_m": float(run.height[k]),
        "friction_J": float(energies["friction"][k]),
        "damping_J": float(energies["damping"][k]),
        "kinetic_left_J": float(energies["kinetic"][k] + energies["elastic"][k]),
        "lost_potential_J": float(energies["potential"][0] - energies["potential"][k]),
        "residual_J": float(np.abs(run.residual).max()),
        "initial_potential_J": float(energies["potential"][0]),
        "failed_searches": run.failed_searches,
        "searches": run.searches,
        "largest_lean_rad": float(np.max(run.lean)),
    }


def _rolling_table(found: findings.Findings) -> Table:
    return Table.of(
        "Rolling down a cylindrical floor and up again",
        [_rolling_summary(run) for run in found.rolling],
        (
            ("body", lambda run: f"{run['name']}, v_r {run['transition_speed_m_per_s'] * 1e3:g} mm/s"),
            ("start [mm]", lambda run: f"{run['start_height_m'] * 1e3:.3f}"),
            ("reached [mm]", lambda run: f"{run['reached_height_m'] * 1e3:.3f}"),
            ("potential lost [J]", lambda run: digits(run["lost_potential_J"])),
            ("friction [J]", lambda run: digits(run["friction_J"])),
            ("damping [J]", lambda run: digits(run["damping_J"])),
            ("still moving [J]", lambda run: digits(run["kinetic_left_J"])),
            ("balance left [J]", lambda run: f"{run['residual_J']:.1e}"),
            ("failed searches", lambda run: f"{run['failed_searches']} of {run['searches']}"),
        ),
        "height of the centre at the turning point on the other side; potential lost = friction + "
        "damping + still moving; balance left: largest of the whole run",
    )


def _barrel_table(found: findings.Findings) -> Table:
    def largest_difference(loads: BarrelLoads) -> str:
        return f"{100.0 * float(np.abs(loads.load - loads.formula).max() / loads.load.max()):.3f}"

    bearing = found.barrel
    return Table.of(
        f"Spherical roller bearing {bearing.name} at rest, radial load",
        found.barrel_loads,
        (
            ("load", lambda loads: f"{loads.force / 1e3:g} kN"),
            ("shift [um]", lambda loads: f"{loads.displacement * 1e6:.3f}"),
            ("formula [um]", lambda loads: f"{loads.formula_displacement * 1e6:.3f}"),
            ("largest roller load [N]", lambda loads: f"{loads.load[0]:.1f}"),
            ("formula [N]", lambda loads: f"{loads.formula[0]:.1f}"),
            ("largest difference [%]", largest_difference),
            ("load-zone integral [N]", lambda loads: f"{loads.integral_largest:.1f}"),
            ("loaded rollers a row", lambda loads: f"{int((loads.load > 0.0).sum())}"),
            ("searches", lambda loads: f"{loads.searches}"),
        ),
        f"{bearing.source}; free travel of the rollers along the contact line "
        f"{bearing.clearance * 1e6:.1f} um",
        "largest difference of any roller load from the formula, over the largest load",
    )


def tables(found: findings.Findings) -> tuple[Table, ...]:
    """Make all tables in the order of the page."""
    return (
        _located_table(found),
        _methods_table(found),
        _contacts_table(found),
        _run_table(found),
        _forms_table(found),
        _shapes_table(found),
        _spheres_table(found),
        _rolling_table(found),
        _barrel_table(found),
    )


def report(found: findings.Findings) -> str:
    """Write all tables for the terminal."""
    parts = [table.text() for table in tables(found)]
    return "\n\n".join([*parts, f"all of this took {found.seconds:.0f} s on {machine()['processor']}"])


def json_object(found: findings.Findings) -> dict[str, Any]:
    """Gather everything for JSON, SI units in the keys."""
    return {
        "bearing": found.bearing.name,
        "quick": found.quick,
        "machine": machine(),
        "wall_time_s": found.seconds,
        "evaluations": findings.EVALUATIONS,
        "searches_per_evaluation": found.searches_per_evaluation,
        "santos_2017_s": {method: 3600.0 * hours for method, hours in findings.SANTOS_HOURS.items()},
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
        "rolling": [_rolling_summary(run) for run in found.rolling],
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
