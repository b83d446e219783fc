"""What the contact laboratory found, as tables."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from beardyn_core.laboratory.barrel import BarrelLoads
from beardyn_core.laboratory.findings import (
    CONTACT_SHARE,
    EVALUATIONS,
    EVALUATIONS_PER_STEP,
    LOAD,
    MEAN_STEP,
    RUN_SECONDS,
    Findings,
    largest_lean,
    santos_hours,
)
from beardyn_core.laboratory.nine_contacts import PAIRINGS, SEARCHES_PER_ROLLER
from beardyn_core.laboratory.rolling import Rolling
from beardyn_core.laboratory.timing import METHODS, MethodResult
from beardyn_core.model.build import WAVEFORM_RATE
from beardyn_core.study.table import Table, digits, duration_text, nanometres, percent

TWIN_STEPS_PER_SAMPLE = 4
TWIN_EVALUATIONS = round(RUN_SECONDS * WAVEFORM_RATE * TWIN_STEPS_PER_SAMPLE)


def located_table(found: Findings) -> Table:
    """List the nine contacts at the first time step."""
    rows = []
    for contact in found.located:
        name = contact.name
        if name in ("Inner", "Outer"):
            name += f", x = {contact.abscissa * 1e3:+.1f} mm"
        rows.append(
            (
                name,
                f"{contact.gap * 1e6:.4f}",
                nanometres(contact.plain_difference),
                nanometres(contact.compiled_difference),
                ", ".join(f"{value * 1e3:.3f}" for value in contact.q),
            )
        )
    return Table(
        f"Nine contacts at the first time step ({found.bearing.name}, {LOAD / 1e3:g} kN, most loaded roller)",
        ("contact", "gap [um]", "closed form [nm]", "twin's kernel [nm]", "place x, y, z [mm]"),
        tuple(rows),
        (
            "gap by the general search; then how far the closed forms are from it; negative: pressed",
            f"largest difference over all {SEARCHES_PER_ROLLER * found.bearing.roller_count} searches of the "
            f"row: {nanometres(found.row_difference)} nm",
        ),
    )


def _cells(result: MethodResult) -> tuple[str, ...]:
    return (
        digits(result.microseconds),
        "-" if result.iterations is None else f"{result.iterations:.1f}",
        percent(result.failures),
        nanometres(result.largest_error),
    )


def ways_table(found: Findings) -> Table:
    """Set all methods side by side on random rollers."""
    return Table(
        "Random rollers (shifted by 50 um, turned by 2 mrad; start: the nominal roller)",
        ("method", "CPU us per search", "iterations", "failures [%]", "gap error [nm]"),
        tuple((result.method, *_cells(result)) for result in found.random_rollers),
        (
            "iterations of fsolve: evaluations of the equations; gap error: largest, against the plain "
            "closed form (nine contacts of the text, 19 searches a roller)",
        ),
    )


def contacts_table(found: Findings) -> Table:
    """List time and iterations of each contact."""
    rows = []
    for name, results in found.by_contact.items():
        by_method = {result.method: result for result in results}
        analytic = by_method[METHODS[6]]
        rows.append(
            (
                f"{name}: {PAIRINGS[name][0]}",
                *(digits(by_method[method].microseconds) for method in (*METHODS[:7],)),
                f"{analytic.iterations:.1f}" if analytic.iterations is not None else "-",
                percent(max(result.failures for result in results)),
            )
        )
    return Table(
        "Each contact on random rollers [CPU us per search]",
        (
            "contact",
            "fsolve",
            "numeric",
            "analytic",
            "closed",
            "fsolve, compiled eq.",
            "numeric, compiled",
            "analytic, compiled",
            "Newton steps",
            "failures [%]",
        ),
        tuple(rows),
    )


def run_table(found: Findings) -> Table:
    """Compare Santos (2017), Table 1, with our times, extrapolated to its run."""
    rows = []
    for result in found.whole_bearing:
        hours = santos_hours(result.method)
        rows.append(
            (
                result.method,
                digits(result.microseconds),
                "-" if result.iterations is None else f"{result.iterations:.1f}",
                percent(result.failures),
                nanometres(result.largest_error),
                duration_text(found.run_hours(result)),
                f"{CONTACT_SHARE * hours:.1f} h of {hours:g} h"
                if hours is not None and result.method.endswith("plain")
                else "-",
            )
        )
    closed = found.whole_bearing[-1]
    rows.append(
        (
            "the same at the twin's step",
            digits(closed.microseconds),
            "-",
            "-",
            "-",
            duration_text(found.run_hours(closed, TWIN_EVALUATIONS)),
            "-",
        )
    )
    return Table(
        f"A whole row, warm starts, and contact detection of a run of {RUN_SECONDS:g} s",
        (
            "method",
            "CPU us per search",
            "iterations",
            "failures [%]",
            "gap error [nm]",
            "run",
            "Santos (2017)",
        ),
        tuple(rows),
        (
            f"run: {found.searches_per_evaluation} searches x {EVALUATIONS} evaluations "
            f"(Runge-Kutta 4(5), mean step {MEAN_STEP * 1e6:g} us, {EVALUATIONS_PER_STEP} evaluations a "
            f"step), detection alone; the twin's step: {TWIN_EVALUATIONS} evaluations",
            f"Santos (2017): {CONTACT_SHARE:.0%} of its time, which the paper assigns to the contact points",
        ),
    )


def forms_table(found: Findings) -> Table:
    """Compare three readings of the surface-surface conditions."""
    return Table(
        "Conditions of the surface-surface contact FR (sphere on rib), random rollers",
        ("conditions", "failures [%]", "Newton steps", "condition number", "unskewed"),
        tuple(
            (
                form.form,
                percent(form.failures),
                "-" if form.iterations is None else f"{form.iterations:.1f}",
                f"{form.condition:.0f}",
                f"{form.even_condition:.0f}" if form.even_condition < 1e12 else "singular",
            )
            for form in found.forms
        ),
        (
            "failures: not converged within 30 steps, or more than 1 nm off; unskewed: the condition number "
            "with the roller in its place",
        ),
    )


def shapes_table(found: Findings) -> Table:
    """List random circles, spheres, cylinders."""
    rows = []
    for result in found.shapes:
        methods = {method.method: method for method in result.methods}
        analytic = methods[METHODS[6]]
        rows.append(
            (
                f"{result.case}, {result.start} start",
                *(digits(methods[method].microseconds) for method in (*METHODS[:3], METHODS[6])),
                "-" if analytic.iterations is None else f"{analytic.iterations:.1f}",
                *(percent(methods[method].failures) for method in METHODS[:3]),
                percent(result.elsewhere),
                nanometres(analytic.largest_error),
            )
        )
    return Table(
        "Random circles, spheres and cylinders",
        (
            "pair",
            "fsolve [us]",
            "numeric [us]",
            "analytic [us]",
            "compiled [us]",
            "Newton steps",
            "fsolve fails [%]",
            "numeric fails [%]",
            "analytic fails [%]",
            "elsewhere [%]",
            "gap error [nm]",
        ),
        tuple(rows),
        (
            "a failure did not converge, or found another pair of points than the nearest; elsewhere: "
            "those that converged to such a pair (analytic Newton, compiled)",
            "near start: parameters nearest to the other's centre; random start: anywhere",
        ),
    )


def spheres_table(found: Findings) -> Table:
    """List roller ends of growing radius."""
    bearing = found.bearing
    rows = tuple(
        (
            f"{case.ratio:.2f} ({case.radius * 1e3:.0f} mm)",
            f"{case.search_height * 1e3:.2f}" if case.search_converged else "none",
            f"{case.search_gap * 1e6:+.1f}" if case.search_converged else "none",
            "yes" if case.on_face and case.in_rim else "no",
            f"{case.bounded_height * 1e3:.2f}",
            f"{-case.bounded_depth * 1e6:+.1f}",
            case.carried_by,
            "refused" if case.refused else "accepted",
        )
        for case in found.spheres
    )
    return Table(
        "Roller end on a given rib, pushed in by 10 um, skewed by 0.5 mrad",
        (
            "sphere ratio",
            "search: height [mm]",
            "gap [um]",
            "on the part",
            "bounded: height [mm]",
            "gap [um]",
            "bears on",
            "check",
        ),
        rows,
        (
            f"height of the contact over the cone raceway; the rib face reaches from "
            f"{bearing.rib_undercut * 1e3:g} to {bearing.rib_height * 1e3:g} mm, the spherical face of the "
            f"roller ends at {bearing.roller_chamfer * 1e3:g} mm",
        ),
    )


@dataclass(frozen=True)
class RollingSummary:
    """A rolling run in numbers: heights [m], energies [J] at the turning point on the other side."""

    name: str
    transition_speed: float
    turning_time: float
    start_height: float
    reached_height: float
    friction: float
    damping: float
    kinetic_left: float
    lost_potential: float
    residual: float
    initial_potential: float
    failed_searches: int
    searches: int
    largest_lean: float


def rolling_summary(run: Rolling) -> RollingSummary:
    """List the numbers of a run."""
    k, energies = run.turning_sample, run.energies
    return RollingSummary(
        name=run.body.name,
        transition_speed=run.trough.transition_speed,
        turning_time=float(run.time[k]),
        start_height=float(run.height[0]),
        reached_height=float(run.height[k]),
        friction=float(energies["friction"][k]),
        damping=float(energies["damping"][k]),
        kinetic_left=float(energies["kinetic"][k] + energies["elastic"][k]),
        lost_potential=float(energies["potential"][0] - energies["potential"][k]),
        residual=float(np.abs(run.residual).max()),
        initial_potential=float(energies["potential"][0]),
        failed_searches=run.failed_searches,
        searches=run.searches,
        largest_lean=largest_lean(run),
    )


def rolling_table(found: Findings) -> Table:
    """List coin and roller in the trough."""
    rows = []
    for run in found.rolling:
        s = rolling_summary(run)
        rows.append(
            (
                f"{s.name}, v_r {s.transition_speed * 1e3:g} mm/s",
                f"{s.start_height * 1e3:.3f}",
                f"{s.reached_height * 1e3:.3f}",
                digits(s.lost_potential),
                digits(s.friction),
                digits(s.damping),
                digits(s.kinetic_left),
                f"{s.residual:.1e}",
                f"{s.failed_searches} of {s.searches}",
            )
        )
    return Table(
        "Rolling down a cylindrical floor and up again",
        (
            "body",
            "start [mm]",
            "reached [mm]",
            "potential lost [J]",
            "friction [J]",
            "damping [J]",
            "still moving [J]",
            "balance left [J]",
            "failed searches",
        ),
        tuple(rows),
        (
            "height of the centre at the turning point on the other side; potential lost = friction + "
            "damping + still moving; balance left: largest of the whole run",
        ),
    )


def barrel_table(found: Findings) -> Table:
    """Load distribution of the barrel roller bearing."""
    rows = tuple(
        (
            f"{loads.force / 1e3:g} kN",
            f"{loads.displacement * 1e6:.3f}",
            f"{loads.formula_displacement * 1e6:.3f}",
            f"{loads.load[0]:.1f}",
            f"{loads.formula[0]:.1f}",
            f"{100.0 * _largest_difference(loads):.3f}",
            f"{loads.integral_largest:.1f}",
            f"{int((loads.load > 0.0).sum())}",
            f"{loads.searches}",
        )
        for loads in found.barrel_loads
    )
    bearing = found.barrel
    return Table(
        f"Spherical roller bearing {bearing.name} at rest, radial load",
        (
            "load",
            "shift [um]",
            "formula [um]",
            "largest roller load [N]",
            "formula [N]",
            "largest difference [%]",
            "load-zone integral [N]",
            "loaded rollers a row",
            "searches",
        ),
        rows,
        (
            f"{bearing.source}; free travel of the rollers along the contact line "
            f"{bearing.clearance * 1e6:.1f} um",
            "largest difference of any roller load from the formula, over the largest load",
        ),
    )


def _largest_difference(loads: BarrelLoads) -> float:
    return float(np.abs(loads.load - loads.formula).max() / loads.load.max())


def tables(found: Findings) -> tuple[Table, ...]:
    """Make all tables in the order of the page."""
    return (
        located_table(found),
        ways_table(found),
        contacts_table(found),
        run_table(found),
        forms_table(found),
        shapes_table(found),
        spheres_table(found),
        rolling_table(found),
        barrel_table(found),
    )
