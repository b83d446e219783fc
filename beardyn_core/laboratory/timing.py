"""Time, iterations, failures and gap errors of every method to find the contacts.

Times are of the processor, not of the wall, and methods are timed block by block in turn, so that a busy
machine disturbs little and disturbs all of them alike; medians.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import fsolve

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.laboratory import closed_forms
from beardyn_core.laboratory.closed_forms import ClosedForms, pose_rows
from beardyn_core.laboratory.compiled import WORK_NUMBERS, Batch, batch, pair_residual
from beardyn_core.laboratory.nine_contacts import (
    SEARCHES_PER_ROLLER,
    Contact,
    RollerPose,
    contacts_of,
    nominal_pose,
)
from beardyn_core.laboratory.placements import RANDOM_CASES, near_start, random_start
from beardyn_core.laboratory.search import SURFACES, Form, Pair, condition_number, search
from beardyn_core.laboratory.shapes import Cone, Shape, Straight

METHODS = (
    "fsolve, plain",
    "numeric Newton, plain",
    "analytic Newton, plain",
    "closed form, plain",
    "fsolve, compiled equations",
    "numeric Newton, compiled",
    "analytic Newton, compiled",
    "closed form, compiled",
)
FAILURE = 1e-9  # a gap that is farther off is a failure, [m]
# from one evaluation to the next a disc turns by about this, and a body moves by this
WARM_TURN, WARM_SHIFT = 1e-3, 1e-6
_PLAIN_SOLVERS = {METHODS[0]: "fsolve", METHODS[1]: "numeric", METHODS[2]: "analytic"}


@dataclass(frozen=True)
class MethodResult:
    """What one method did on a set of pairs."""

    method: A[str, "one of `METHODS`"]
    microseconds: A[float, "per search, median over blocks"]
    iterations: A[float | None, "mean; evaluations of the residual for fsolve; none for closed forms"]
    failures: A[float, "share that did not converge or is off by more than `FAILURE`, [-]"]
    largest_error: A[float, "of the gap, among those that did not fail, [m]"]


@dataclass(frozen=True)
class Setting:
    """Pairs with starts and true gaps, for all methods."""

    pairs: tuple[Pair, ...]
    starts: tuple[Float, ...]
    truth: A[Float, "shape [pair], [m]"]
    plain_closed: A[Callable[[], Float] | None, "give all gaps by the closed forms"] = None
    compiled_closed: A[Callable[[], None] | None, "write the same, compiled, to ``compiled_gaps``"] = None
    compiled_gaps: A[Float | None, "shape [pair], [m]"] = None


def compare(
    setting: Setting, *, blocks: int, sweeps: int, methods: Sequence[str] = METHODS
) -> tuple[MethodResult, ...]:
    """Run all methods on a setting.

    Parameters
    ----------
    setting : Setting
    blocks : int
        Timed blocks of each method, in turn.
    sweeps : int
        Sweeps over all pairs in a block of a compiled method; plain methods make one.
    methods : sequence of str
    """
    arrays = batch(setting.pairs, setting.starts)
    jobs = {name: made for name in methods if (made := _job(setting, arrays, name, sweeps)) is not None}
    seconds: dict[str, list[float]] = {method: [] for method in jobs}
    for _ in range(blocks):
        for method, (job, times, _, _) in jobs.items():
            begun = time.thread_time()
            for _ in range(times):
                job()
            seconds[method].append((time.thread_time() - begun) / times)
    found = []
    for method, (_, _, gaps, iterations) in jobs.items():
        error = np.abs(gaps - setting.truth)
        good = error <= FAILURE
        converged = np.zeros(0) if iterations is None else iterations[iterations >= 0]
        if iterations is not None:
            good &= iterations >= 0
        found.append(
            MethodResult(
                method,
                1e6 * float(np.median(seconds[method])) / len(setting.pairs),
                float(converged.mean()) if converged.size else None,
                float(1.0 - good.mean()),
                float(error[good].max()) if good.any() else float("nan"),
            )
        )
    return tuple(found)


def _job(
    setting: Setting, arrays: Batch, method: str, sweeps: int
) -> tuple[Callable[[], object], int, Float, Float | None] | None:
    """Return what is timed and how often in a block, gaps and iterations; ``None``: not for this setting."""
    if method in _PLAIN_SOLVERS or method == METHODS[4]:
        solve = (
            partial(_root_finder_compiled, setting, arrays)
            if method == METHODS[4]
            else partial(_plain, setting, _PLAIN_SOLVERS[method])
        )
        return solve, 1, *solve()
    if method in METHODS[5:7]:
        analytic = method == METHODS[6]
        x, out = np.zeros((len(setting.pairs), 4)), np.zeros((len(setting.pairs), 2))
        _, iterations, gaps = arrays.solve(analytic=analytic)
        job = partial(arrays.solve_into, x, out, analytic=analytic)
        return job, sweeps, gaps, iterations.astype(float)
    if method == METHODS[3] and setting.plain_closed is not None:
        return setting.plain_closed, 1, setting.plain_closed(), None
    if method == METHODS[7] and setting.compiled_closed is not None and setting.compiled_gaps is not None:
        setting.compiled_closed()
        return setting.compiled_closed, 10 * sweeps, setting.compiled_gaps, None
    return None


def _plain(setting: Setting, method: str) -> tuple[Float, Float]:
    gaps, iterations = np.empty(len(setting.pairs)), np.empty(len(setting.pairs))
    for i, (pair, start) in enumerate(zip(setting.pairs, setting.starts, strict=True)):
        found = search(pair, start, method)  # type: ignore[arg-type]
        gaps[i] = found.gap
        iterations[i] = found.iterations if found.converged else -1
    return gaps, iterations


def _root_finder_compiled(setting: Setting, arrays: Batch) -> tuple[Float, Float]:
    """Run SciPy's root finder with the compiled residual."""
    gaps, iterations = np.empty(len(setting.pairs)), np.empty(len(setting.pairs))
    work, moved = np.zeros(WORK_NUMBERS), np.zeros(4)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        for i, start in enumerate(setting.starts):
            count = int(arrays.counts[i])
            constants = arrays.p[i], arrays.q[i], arrays.cut[i], arrays.forms[i], count
            equations = partial(_compiled_residual, constants, moved, work, np.empty(count))
            root, info, _, _ = fsolve(equations, start, full_output=True, xtol=1e-13)
            left = float(np.abs(equations(root)).max())
            gaps[i] = work[:3] @ work[18:21] if arrays.signed[i] else np.sqrt(work[:3] @ work[:3])
            iterations[i] = info["nfev"] if left < 1e-9 else -1
    return gaps, iterations


def _compiled_residual(
    constants: tuple[Any, ...], moved: Float, work: Float, value: Float, parameters: Float
) -> Float:
    moved[: len(parameters)] = parameters
    pair_residual(*constants, moved, work, value)
    return value.copy()


def warm_start(shape: Shape, parameters: Float, random: np.random.Generator) -> Float:
    """Draw the parameters an evaluation earlier: `WARM_TURN` and `WARM_SHIFT` away, either way."""
    away = np.full(parameters.size, WARM_TURN)
    if isinstance(shape, (Cone, Straight)):
        away[0] = WARM_SHIFT
    return parameters + away * random.choice([-1.0, 1.0], parameters.size)


def bearing_setting(
    bearing: Bearing, poses: Sequence[RollerPose], *, warm: bool = False, only: str | None = None
) -> Setting:
    """Collect all searches of many rollers, or ``only`` those of one contact of `NAMES`.

    They start near the solution when ``warm``, as a time step does, otherwise from the nominal roller.
    """
    random = np.random.default_rng(7)
    chosen = [
        (pose, contact)
        for pose in poses
        for contact in contacts_of(bearing, pose)
        if only in (None, contact.name)
    ]
    pairs = tuple(contact.pair for _, contact in chosen)
    starts = tuple(contact.start for _, contact in chosen)
    if warm:
        solved, _, _ = batch(pairs, starts).solve()
        starts = tuple(
            np.concatenate([warm_start(pair.p, x[:cut], random), warm_start(pair.q, x[cut:], random)])
            for pair, x, cut in (
                (pair, solved[i, : len(start)], pair.p.parameter_count)
                for i, (pair, start) in enumerate(zip(pairs, starts, strict=True))
            )
        )

    def plain() -> Float:
        return np.array([closed_forms.contact_gap(bearing, pose, contact) for pose, contact in chosen])

    if only is not None:
        return Setting(pairs, starts, plain(), plain)
    closed, rows = ClosedForms(bearing), pose_rows(poses)
    out = np.zeros((len(poses), SEARCHES_PER_ROLLER))
    return Setting(pairs, starts, plain(), plain, lambda: closed.gaps_into(rows, out), out.ravel())


@dataclass(frozen=True)
class RandomResult:
    """How the search does on random placements of simple shapes."""

    case: str
    start: A[str, "``near`` (nearest to the other's centre) or ``random``"]
    methods: tuple[MethodResult, ...]
    elsewhere: A[float, "share that converged, but to another stationary pair of points, [-]"]


def random_results(count: int, *, blocks: int, sweeps: int) -> tuple[RandomResult, ...]:
    """Run all of `RANDOM_CASES` from both starts."""
    found = []
    for case in RANDOM_CASES:
        random = np.random.default_rng(11)
        pairs = tuple(case.draw(random) for _ in range(count))
        truth = np.array([case.truth(pair.p, pair.q) for pair in pairs])
        for start in ("near", "random"):
            starts = tuple(
                near_start(pair) if start == "near" else random_start(pair, random) for pair in pairs
            )
            setting = Setting(pairs, starts, truth)
            methods = compare(setting, blocks=blocks, sweeps=sweeps, methods=(*METHODS[:3], METHODS[6]))
            _, iterations, gaps = batch(pairs, starts).solve()
            elsewhere = (iterations >= 0) & (np.abs(gaps - truth) > FAILURE)
            found.append(RandomResult(case.name, start, methods, float(elsewhere.mean())))
    return tuple(found)


@dataclass(frozen=True)
class FormResult:
    """How one form of the surface-surface conditions does on the contact of sphere and rib."""

    form: str
    failures: A[float, "[-]"]
    iterations: A[float | None, "mean, of those that converged"]
    condition: A[float, "median of the Jacobian at the true contact"]
    even_condition: A[float, "the same for the roller in its place, its axis and the bearing's in one plane"]


def form_results(
    bearing: Bearing, poses: Sequence[RollerPose], forms: Sequence[Form]
) -> tuple[FormResult, ...]:
    """Search the surface-surface contact FR with several forms, from the nominal roller."""
    found = []
    sound = [_of_rib(bearing, pose, SURFACES) for pose in poses]
    truth = np.array(
        [closed_forms.contact_gap(bearing, pose, contact) for pose, contact in zip(poses, sound, strict=True)]
    )
    solved, reached, _ = _search_all(sound)
    for form in forms:
        contacts = [_of_rib(bearing, pose, form) for pose in poses]
        _, iterations, gaps = _search_all(contacts)
        good = iterations >= 0
        conditions = [condition_number(c.pair, solved[i]) for i, c in enumerate(contacts) if reached[i] >= 0]
        even = _of_rib(bearing, nominal_pose(bearing), form)
        found.append(
            FormResult(
                form.name,
                float(1.0 - (good & (np.abs(gaps - truth) <= FAILURE)).mean()),
                float(iterations[good].mean()) if good.any() else None,
                float(np.median(conditions)),
                condition_number(even.pair, even.start),
            )
        )
    return tuple(found)


def _search_all(contacts: Sequence[Contact]) -> tuple[Float, NDArray[np.int64], Float]:
    return batch([contact.pair for contact in contacts], [contact.start for contact in contacts]).solve()


def _of_rib(bearing: Bearing, pose: RollerPose, form: Form) -> Contact:
    return next(contact for contact in contacts_of(bearing, pose, form) if contact.name == "FR")
