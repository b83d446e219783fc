"""Everything the contact laboratory finds, in one run."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Annotated as A

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.laboratory import closed_forms
from beardyn_core.laboratory.barrel import BARREL_22317, BarrelBearing, BarrelLoads, solve_barrel
from beardyn_core.laboratory.closed_forms import ClosedForms
from beardyn_core.laboratory.nine_contacts import NAMES, SEARCHES_PER_ROLLER, RollerPose, contacts_of
from beardyn_core.laboratory.placements import loaded_row, random_rollers
from beardyn_core.laboratory.rolling import COIN, ROLLER, Rolling, Trough, run_rolling
from beardyn_core.laboratory.search import SURFACES, SURFACES_CROSSED, SURFACES_PRINTED, search
from beardyn_core.laboratory.sphere_radius import SphereCase, sphere_cases
from beardyn_core.laboratory.timing import (
    FormResult,
    MethodResult,
    RandomResult,
    bearing_setting,
    compare,
    form_results,
    random_results,
)

# The run of Santos (2017): Runge-Kutta 4(5) made steps of 1.33 us in the mean on a copy of its model, six
# evaluations each.
RUN_SECONDS, MEAN_STEP, EVALUATIONS_PER_STEP = 0.03, 1.33e-6, 6
EVALUATIONS = round(RUN_SECONDS / MEAN_STEP * EVALUATIONS_PER_STEP)
# Santos (2017), Table 1: hours of the whole run
SANTOS_HOURS = {"fsolve": 24.0, "numeric Newton": 8.0, "analytic Newton": 9.5}
CONTACT_SHARE = 0.8  # of that time, by its own estimate
LOAD = 5.0e3  # [N]
BARREL_LOADS = (10.0e3, 25.0e3, 50.0e3, 100.0e3)
GOOD_FRICTION = 2.0e-4  # transition speed of the run with little creep, [m/s]


@dataclass(frozen=True)
class LocatedContact:
    """One of the nine contacts at the first time step, most loaded roller."""

    name: str
    abscissa: A[float, "[m]"]
    gap: A[float, "by the general search, [m]"]
    plain_difference: A[float, "of the plain closed forms from it, [m]"]
    compiled_difference: A[float, "of the compiled ones, [m]"]
    p: A[Float, "shape [3], point on P, in the frame of the roller's azimuth, [m]"]
    q: A[Float, "shape [3], point on Q, [m]"]


@dataclass(frozen=True)
class Findings:
    """Results of a run of the laboratory."""

    bearing: Bearing
    quick: bool
    located: tuple[LocatedContact, ...]
    row_difference: A[float, "largest difference of general search and closed forms over the whole row, [m]"]
    by_contact: A[dict[str, tuple[MethodResult, ...]], "random rollers, starts at the nominal roller"]
    random_rollers: A[tuple[MethodResult, ...], "all contacts of them together"]
    whole_bearing: A[tuple[MethodResult, ...], "all rollers of a row at the first time step, warm starts"]
    forms: tuple[FormResult, ...]
    shapes: tuple[RandomResult, ...]
    spheres: tuple[SphereCase, ...]
    rolling: tuple[Rolling, ...]
    barrel: BarrelBearing
    barrel_loads: tuple[BarrelLoads, ...]
    seconds: A[float, "wall time of all this, [s]"]

    @property
    def searches_per_evaluation(self) -> int:
        """Of one row."""
        return SEARCHES_PER_ROLLER * self.bearing.roller_count

    def run_hours(self, result: MethodResult, evaluations: int = EVALUATIONS) -> float:
        """Return the time of contact detection in the run of Santos (2017), 0.03 s, [h]."""
        return result.microseconds * 1e-6 * self.searches_per_evaluation * evaluations / 3600.0


def locate(bearing: Bearing, pose: RollerPose) -> tuple[LocatedContact, ...]:
    """Search all contacts of a roller, with the closed forms next to them."""
    compiled = ClosedForms(bearing).gaps([pose])[0]
    found = []
    for contact, by_kernel in zip(contacts_of(bearing, pose), compiled, strict=True):
        here = search(contact.pair, contact.start)
        if not here.converged:
            raise ArithmeticError(f"{contact.name}: the general search found no contact point")
        plain = closed_forms.contact_gap(bearing, pose, contact)
        differences = plain - here.gap, float(by_kernel) - here.gap
        found.append(LocatedContact(contact.name, contact.abscissa, here.gap, *differences, here.p, here.q))
    return tuple(found)


def find(bearing: Bearing, *, quick: bool = False, say: Callable[[str], None] = lambda _: None) -> Findings:
    """Run the whole laboratory.

    Parameters
    ----------
    bearing : Bearing
        Without end play; loaded by `LOAD`.
    quick : bool
        Fewer placements, shorter runs.
    say : function of a str
        Called with what comes next.
    """
    begun = time.perf_counter()
    blocks, sweeps = (5, 5) if quick else (15, 20)
    say("nine contacts at the first time step")
    row = loaded_row(bearing, LOAD, 0.0)
    poses = list(random_rollers(bearing, 10 if quick else 40, seed=3))
    many = list(random_rollers(bearing, 100 if quick else 1000, seed=5))
    located = [locate(bearing, pose) for pose in row]
    say("random rollers")
    by_contact = {
        name: compare(bearing_setting(bearing, poses, only=name), blocks=max(3, blocks // 5), sweeps=sweeps)
        for name in NAMES
    }
    together = compare(bearing_setting(bearing, poses), blocks=max(3, blocks // 7), sweeps=sweeps)
    say("a whole row of the bearing")
    whole = compare(bearing_setting(bearing, row, warm=True), blocks=blocks, sweeps=sweeps)
    forms = form_results(bearing, many, (SURFACES_PRINTED, SURFACES_CROSSED, SURFACES))
    say("random circles, spheres, cylinders")
    shapes = random_results(40 if quick else 200, blocks=3, sweeps=sweeps)
    say("roller ends of growing radius")
    spheres = sphere_cases(bearing)
    say("coin and roller in the trough")
    trough, duration = Trough(), 0.8 if quick else 1.5
    runs = ((COIN, trough), (COIN, replace(trough, transition_speed=GOOD_FRICTION)), (ROLLER, trough))
    rolling = tuple(run_rolling(body, floor, duration=duration) for body, floor in runs)
    say("barrel rollers")
    forces = BARREL_LOADS[:2] if quick else BARREL_LOADS
    loads = tuple(solve_barrel(BARREL_22317, force) for force in forces)
    return Findings(
        bearing=bearing,
        quick=quick,
        located=located[0],
        row_difference=max(
            max(abs(contact.plain_difference), abs(contact.compiled_difference))
            for contacts in located
            for contact in contacts
        ),
        by_contact=by_contact,
        random_rollers=together,
        whole_bearing=whole,
        forms=forms,
        shapes=shapes,
        spheres=spheres,
        rolling=rolling,
        barrel=BARREL_22317,
        barrel_loads=loads,
        seconds=time.perf_counter() - begun,
    )
