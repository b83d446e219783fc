"""Write docs/contacts.md and its pictures from a run of the contact laboratory.

``beardyn contacts -o DIR``, on an idle machine, for the page holds processor times; then
``python -m evidence.contacts.page DIR [--to FOLDER]``. The text between the two marks of the runs of
Santos (2017) on the page stays as it is.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

from beardyn_core.study.contacts_report import TWIN_EVALUATIONS
from beardyn_core.study.table import Table, digits, duration_text
from evidence.pages import DOCS, save_small

PICTURES = ("contacts_nine.png", "contacts_sphere.png", "contacts_rolling.png", "contacts_barrel.png")
COLOURS = 64
BEGIN, END = "<!-- the runs of Santos (2017) -->", "<!-- end of the runs of Santos (2017) -->"
NO_RUNS = "Not yet on this page."

HEAD = """# The contact laboratory

Written by `python -m evidence.contacts.page` from `beardyn contacts -o DIR`; every number on this page is of
that run, on one core of {processor}, Python {python}.

BearDyn (Santos, 2017, *Dynamics of Tapered Roller Bearings: Modelling and Analysis*, Instituto Superior
Tecnico, Lisbon) found its contact points by a general search: both partners are parametric surfaces or
lines, and the conditions of least distance are a small system of nonlinear equations, solved anew for each
contact at each evaluation. The twin has closed forms instead. Here both are run on the same contacts.

## The search

Point P lies on body i, point Q on body j, d = r_P - r_Q; t, b, n are tangent, binormal and normal. Surfaces
are meridians (a straight line or an arc) swept about an axis; lines are circles and straight lines. The gap
is d . n_Q, negative when the bodies overlap.

| contact | conditions | unknowns |
|---|---|--:|
| surface-surface, Eq. (3) | n_Q . t_P = 0, d . b_P = 0, n_P . t_Q = 0, d . b_Q = 0 | 4 |
| surface-surface, parallel normals | n_Q . t_P = 0, n_Q . b_P = 0, d . t_Q = 0, d . b_Q = 0 | 4 |
| surface (Q)-line (P), Eq. (4) | n_Q . t_P = 0, d . t_Q = 0, d . b_Q = 0 | 3 |
| line-line, Eq. (5), least distance | one displacement condition for each line | 2 |
| line-line, Eq. (5), along the normal | d . b_Q = 0, d . t_Q = 0 | 2 |

Solved by SciPy's `fsolve` (MINPACK hybrd, Jacobian by differences), by Newton's method with a Jacobian by
differences, and by Newton's method with the analytic Jacobian, all in plain NumPy and again with compiled
equations. A scalar product counts as zero below 1e-11. Closed forms: in plain NumPy, and the kernels of the
twin (`generator_line` for all discs of a roller at once, `rib_gap` for both ribs).
"""

FORMS = """Read with t along the meridian and b around the axis on both surfaces, Eq. (3) is singular
wherever the two axes lie in one plane, which is where a roller in its place is: both circumferential
conditions say the same, and nothing holds d along the meridian. A small skew leaves it nearly so. The text
does not say which tangent is t; with the two exchanged on one surface the system is regular. Parallel
normals, used on this page, do not depend on that choice."""

SPHERES = """BearDyn's rib contact was lost when the radius of the roller end was large, and its author
changed the radius. Shown here: the rib face is that of the sound bearing, only the roller end changes. Near
the apex (ratio 1) the search runs off along the rib to a point that is open, so no force would act while
the roller is pushed 10 um into the rib; beyond it the point found lies off the roller end. It converges all
the same, and nothing in the equations shows it. Two cures: a bearing with such an end is refused by the
consistency check (it names sphere ratio and the rib's radius of curvature), and where an effect set limits
the rib face and the roller end, the contact stays on both: the rim bears, at the depth it is pushed."""

FAIR = """What this comparison is and is not. The columns *run* and *Santos (2017)* are of different programs:
MATLAB on an unknown machine in 2017 against Python and compiled Python here; its steps, tolerances and
number of evaluations are not stated, so the {evaluations} evaluations are those an adaptive Runge-Kutta
4(5) took for a copy of its model; its 24 h, 8 h and 9.5 h are whole runs, of which it gives some 80 % to
the contact points; ours is detection alone, extrapolated from {searches} searches of one row. The order of
the methods is the finding to check: there the analytic Jacobian was slower than the numeric one,
here it is faster, for the derivatives come with the frame instead of being assembled for each contact. Same
language, same equations, compiled: {compiled} times faster. Closed forms, compiled: another {closed} times.
And a twin with an implicit step does not need those evaluations: {twin} in the same 0.03 s."""

SHAPES = """Conditions of least distance hold at every stationary pair of points, also at the far side of a
cylinder. So a search converges as a rule, but from a poor start often to another pair; in a time step the
start is the last solution. Least distances: closed forms, and for circles a scan refined by Brent's
method."""

ROLLING = """A coin (one circle) and a roller (six circles) are released at rest on the slope of a
cylindrical floor. Each circle is searched at each of the four stages of each step of {step} us;
Kelvin-Voigt normal force, Threlfall friction that reaches its full value at the transition speed v_r. The
centre comes back to the height it started from, less what is lost: creep, for that friction needs some
sliding to act at all. A smaller v_r loses less. `beardyn contacts --rrd FILE.rrd` writes the animation."""

BARREL = """The text announced spherical roller bearings as an extension of the same functions: only the
arcs are new. Rollers are in balance in radial and axial direction and tilt; gaps of both contacts by the
search (surface-surface), forces by Hertz with complete elliptic integrals, no friction. The formula is the
sum Q_j = K (delta cos psi_j cos alpha - c)^1.5 over the rollers, which needs no search and keeps the
contact angle; its difference is the contact angle that changes under load. Both rows carry the same."""

MISSING = """The search is not part of the twin; nothing else imports `beardyn_core/laboratory`. Shapes have
no ends: edges and limits of the parts are the business of the closed forms. Contacts between rollers, and
of the cage with the rings, were not in the text's list. The face of the small rib leans by an assumed
1 deg, and the pocket lines follow the nominal roller."""


def table_of(entry: dict[str, Any]) -> Table:
    """Read a table of the JSON."""
    return Table(
        entry["title"],
        tuple(entry["head"]),
        tuple(tuple(row) for row in entry["rows"]),
        tuple(entry["remarks"]),
    )


def section(title: str, text: str, table: Table | None, picture: str | None = None) -> list[str]:
    """Write a section of the page."""
    lines = [f"## {title}", ""]
    if text:
        lines += [text, ""]
    if table is not None:
        lines += [table.markdown(), ""]
    if picture is not None:
        lines += [f"![{title}](pictures/{picture})", ""]
    return lines


def kept_runs(page: Path) -> str:
    """Read what the page says of the runs of Santos (2017)."""
    if not page.exists():
        return NO_RUNS
    text = page.read_text(encoding="utf-8")
    if BEGIN not in text or END not in text:
        return NO_RUNS
    return text.split(BEGIN, 1)[1].split(END, 1)[0].strip()


def page_text(found: dict[str, Any], runs: str) -> str:
    """Put the whole page together."""
    located, methods, contacts, run, forms, shapes, spheres, rolling, barrel = map(table_of, found["tables"])
    time = {entry["method"]: entry["time_s"] for entry in found["whole_bearing"]}
    analytic = time["analytic Newton, compiled"]
    fair = FAIR.format(
        evaluations=found["evaluations"],
        searches=found["searches_per_evaluation"],
        compiled=digits(time["analytic Newton, plain"] / analytic, 2),
        closed=digits(analytic / time["closed form, compiled"], 2),
        twin=TWIN_EVALUATIONS,
    )
    fastest = duration_text(found["whole_bearing"][-1]["run_s"] / 3600.0)
    lines = [
        HEAD.format(**found["machine"]),
        *section(f"{located.title}", "", located, PICTURES[0]),
        *section("Every method on random rollers", "", methods),
        *section("Contact by contact", "Processor time in us per search, random rollers.", contacts),
        *section("A run of 0.03 s beside Santos (2017), Table 1", "", run),
        fair,
        "",
        f"With the closed forms the contact detection of that run takes {fastest}.",
        "",
        *section("Eq. (3), three readings", FORMS, forms),
        *section(shapes.title, SHAPES, shapes),
        *section("A roller end too large for its rib", SPHERES, spheres, PICTURES[1]),
        *section(rolling.title, ROLLING.format(step=10), rolling, PICTURES[2]),
        *section(barrel.title, BARREL, barrel, PICTURES[3]),
        "## The runs of Santos (2017)",
        "",
        BEGIN,
        "",
        runs,
        "",
        END,
        "",
        "## Not in it",
        "",
        MISSING,
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, help="that `beardyn contacts -o` wrote")
    parser.add_argument("--to", type=Path, default=DOCS, metavar="FOLDER")
    arguments = parser.parse_args()
    source = arguments.folder / "contacts.json"
    if not source.exists():
        sys.exit(f"{source} does not exist: run `beardyn contacts -o {arguments.folder}` first")
    found = json.loads(source.read_text(encoding="utf-8"))
    pictures = arguments.to / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    for name in PICTURES:
        save_small(arguments.folder / name, pictures / name, COLOURS)
    page = arguments.to / "contacts.md"
    page.write_text(page_text(found, kept_runs(page)), encoding="utf-8")


if __name__ == "__main__":
    main()
