"""All runs of the study side by side, as the mapping that is written as JSON."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.experiments import Cluster, Engine
from beardyn_core.experiments.loop import Progress, run_plan
from beardyn_core.experiments.plan import Plan
from beardyn_core.physics.tiers.friction_steps import StepChoice
from beardyn_core.physics.tiers.status import LARGEST_CHATTER_INDEX
from beardyn_core.study.measures import NOMINAL_BANDS
from beardyn_core.twin import Twin
from evidence.step.cases import (
    BRIDGE,
    COMPARED_STEPS,
    EFFECTS,
    LAMINAE,
    LONG_EXPLICIT,
    POINTS,
    REFERENCE,
    Method,
    Point,
    chosen,
    compared,
    scene_of,
)
from evidence.step.comparison import (
    LEVEL_LIMIT,
    MEAN_LIMIT,
    NOT,
    SCATTER_LIMIT,
    WITHIN,
    Difference,
    difference,
)
from evidence.step.run import LINES, StepRun, attempt
from evidence.step.unstable import UNSTABLE_EFFECTS, unstable_runs

Float = NDArray[np.float64]
_ALIKE = 9  # lines side by side, of which one variance is taken
Job = tuple[Point, Method, int]
Runs = dict[tuple[Point, Method], list[StepRun | str]]


@dataclass(frozen=True)
class Extent:
    """How much is run.

    Parameters
    ----------
    settling, duration : float
        Of each run, [s].
    reference_runs, bridge_runs, runs : int
        Of the reference, of the explicit step beside it, and of each implicit step; explicit steps that are
        too long run once.
    steps : tuple of int
        Implicit steps per sample beside the chosen ones.
    """

    settling: float = 0.3
    duration: float = 1.7
    reference_runs: int = 3
    bridge_runs: int = 6
    runs: int = 8
    steps: tuple[int, ...] = COMPARED_STEPS


QUICK = Extent(0.1, 0.4, 2, 2, 2)


def run_study(
    extent: Extent, points: Sequence[Point] = POINTS, jobs: int = 1, report: Callable[[str], None] = print
) -> dict[str, Any]:
    """Run everything and compare it.

    Parameters
    ----------
    extent : Extent
    points : sequence of Point
    jobs : int
        Processes side by side.
    report : callable
        Gets a line after each run.
    """
    jobs_of = [job for point in points for job in _jobs(point, extent)]
    for effects in UNSTABLE_EFFECTS:
        for method in (REFERENCE, Method("implicit", 4)):
            Twin(scene_of(points[0], method, effects=effects)).warm()  # no two processes compile the same
    report("explicit steps across their limit")
    unstable = unstable_runs(points)
    results: dict[Job, StepRun | str] = {}
    plan = Plan[Job, StepRun | str](
        {
            f"{point.name}, {method.name}, run {number + 1}": (point, method, number)
            for point, method, number in jobs_of
        },
        attempt_jobs,
        (extent.settling, extent.duration),
        lost=lambda _, killed: f"{killed} processes died of it",
    )

    def tell(now: Progress[StepRun | str]) -> None:
        for key, found in now.latest.items():
            results[plan.items[key]] = found
            report(f"{now.done:3}/{len(plan.items)}  {key}: {_said(found)}")

    with Engine(Cluster(workers=jobs)) as engine:
        run_plan(plan, engine, report=tell)
    runs: Runs = {}
    for point, method, number in jobs_of:
        runs.setdefault((point, method), []).append(results[point, method, number])
    return {
        "effects": EFFECTS,
        "laminae": LAMINAE,
        "extent": asdict(extent),
        "limits": {
            "mean": MEAN_LIMIT,
            "scatter": SCATTER_LIMIT,
            "level_dB": LEVEL_LIMIT,
            "chatter": LARGEST_CHATTER_INDEX,
        },
        "bands_Hz": list(NOMINAL_BANDS),
        "lines_Hz": LINES.tolist(),
        "unstable": unstable,
        "points": [point_mapping(point, extent, runs) for point in points],
    }


def attempt_jobs(jobs: Sequence[Job], lengths: tuple[float, float]) -> list[StepRun | str]:
    """Do some runs in this process; their settling and duration are given, [s]."""
    return [attempt(*job, *lengths) for job in jobs]


def _said(found: StepRun | str) -> str:
    if isinstance(found, str):
        return found
    return f"torque {found.mean[0]:.4f} +- {found.scatter[0]:.3f} N m, {found.wall:.2g} s a simulated second"


def _jobs(point: Point, extent: Extent) -> list[Job]:
    """List the runs of a load, the long ones first."""
    repeats = [(REFERENCE, extent.reference_runs)]
    counts = {BRIDGE: extent.bridge_runs, **dict.fromkeys(LONG_EXPLICIT, 1)}
    repeats += [(method, counts.get(method, extent.runs)) for method in compared(point, extent.steps)]
    return [(point, method, number) for method, count in repeats for number in range(count)]


def point_mapping(point: Point, extent: Extent, runs: Runs) -> dict[str, Any]:
    """Describe one load: reference, rows, what is chosen and the verdict on it."""
    reference = [run for run in runs[point, REFERENCE] if isinstance(run, StepRun)]
    pooled = [*reference, *(run for run in runs[point, BRIDGE] if isinstance(run, StepRun))]
    rows = [
        row_mapping(method, runs[point, method], reference, pooled)
        for method in compared(point, extent.steps)
    ]
    choices = chosen(point)
    mean, scatter = (_mean(reference, key) for key in ("mean", "scatter"))
    own = difference(_relative(reference, "mean", mean), _relative(reference, "mean", mean))
    bands, lines = (_spectra(reference, reference, key) for key in ("bands", "lines"))
    return {
        "name": point.name,
        "load_N": point.load,
        "speed_rad_s": point.speed,
        "reference": {
            "name": REFERENCE.name,
            "runs": len(reference),
            "torque_Nm": mean,
            "torque_doubt": float(own.doubt[0] / np.sqrt(2.0)),
            "pooled_runs": len(pooled),
            "pooled_torque_Nm": _mean(pooled, "mean"),
            "scatter_Nm": scatter,
            "filtered_scatter_Nm": _mean(reference, "filtered_scatter"),
            "chatter": max(run.chatter for run in reference),
            "wall": float(np.median([run.wall for run in reference])),
            "bands_dB": np.mean([run.bands[0] for run in reference], axis=0).tolist(),
            "bands_band_dB": bands.band.tolist(),
            "lines_dB": np.mean([run.lines[0] for run in reference], axis=0).tolist(),
            "lines_band_dB": lines.band.tolist(),
        },
        "chosen": {name: _judged(choice, name, rows) for name, choice in choices.items()},
        "rows": rows,
    }


def row_mapping(
    method: Method, runs: Sequence[StepRun | str], reference: Sequence[StepRun], pooled: Sequence[StepRun]
) -> dict[str, Any]:
    """Compare one time step with the reference; give only name and reason when a run of it ended early.

    Parameters
    ----------
    method : Method
    runs : sequence
        As of `attempt`.
    reference : sequence of StepRun
        What all is compared with.
    pooled : sequence of StepRun
        The same together with the runs of `BRIDGE`, for the mean torque, which takes the longest to be known.
    """
    row: dict[str, Any] = {
        **asdict(method),
        "name": method.name,
        "step_us": 1e6 * method.step,
        "runs": len(runs),
    }
    whole = [run for run in runs if isinstance(run, StepRun)]
    if len(whole) < len(runs):
        return {**row, "ended": next(run for run in runs if isinstance(run, str))}
    mean, scatter, filtered = (_mean(reference, key) for key in ("mean", "scatter", "filtered_scatter"))
    found = {
        key: difference(_relative(whole, key, size), _relative(reference, key, size))
        for key, size in (("mean", mean), ("scatter", scatter), ("filtered_scatter", filtered))
    }
    size = _mean(pooled, "mean")
    found["pooled_mean"] = difference(_relative(whole, "mean", size), _relative(pooled, "mean", size))
    bands, lines = (_spectra(whole, reference, key) for key in ("bands", "lines"))
    return {
        **row,
        "wall": float(np.median([run.wall for run in whole])),
        "status": next((run.status for run in whole if run.status != "fine"), "fine"),
        "chatter": max(run.chatter for run in whole),
        "begun": _paired(whole, reference),
        "torque_Nm": _mean(whole, "mean"),
        "scatter_Nm": _mean(whole, "scatter"),
        "mean": _single(found["mean"], MEAN_LIMIT),
        "pooled_mean": _single(found["pooled_mean"], MEAN_LIMIT),
        "scatter": _single(found["scatter"], SCATTER_LIMIT),
        "filtered_scatter": _single(found["filtered_scatter"], SCATTER_LIMIT),
        "bands": _many(bands),
        "bands_limit": {"verdict": bands.against(LEVEL_LIMIT)},
        "lines": _many(lines),
    }


def _judged(choice: StepChoice, asked: str, rows: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Judge a chosen step by the worst verdict on what was asked."""
    row = next(r for r in rows if (r["integrator"], r["steps"]) == ("implicit", choice.steps_per_sample))
    spectra = ("bands", "bands_limit", "lines") if asked == "vibration" else ()
    criteria = ("mean", "pooled_mean", "scatter", *spectra)
    verdicts: dict[str, str] = {key: row[key]["verdict"] if "ended" not in row else NOT for key in criteria}
    worst = next((v for v in (NOT, "open") if v in verdicts.values()), WITHIN)
    return {**asdict(choice), "verdicts": verdicts, "verdict": worst}


def _paired(runs: Sequence[StepRun], reference: Sequence[StepRun]) -> float:
    """Return the relative difference of the torque at the beginning, of runs that begin alike."""
    return float(
        np.mean([run.begun / other.begun - 1.0 for run, other in zip(runs, reference, strict=False)])
    )


def _mean(runs: Sequence[StepRun], key: str) -> float:
    return float(np.mean([getattr(run, key)[0] for run in runs]))


def _relative(runs: Sequence[StepRun], key: str, size: float) -> list[Float]:
    return [getattr(run, key)[:, None] / size for run in runs]


def _spectra(runs: Sequence[StepRun], reference: Sequence[StepRun], key: str) -> Difference:
    here, there = ([getattr(run, key) for run in group] for group in (runs, reference))
    return difference(here, there, _ALIKE if key == "lines" else 1)


def _single(found: Difference, limit: float) -> dict[str, Any]:
    value, doubt, band = (float(each[0]) for each in (found.value, found.doubt, found.band))
    return {"difference": value, "doubt": doubt, "band": band, "verdict": found.against(limit)}


def _many(found: Difference) -> dict[str, Any]:
    return {
        "difference_dB": found.value.tolist(),
        "doubt_dB": found.doubt.tolist(),
        "rms_dB": float(np.sqrt(np.mean(found.value**2))),
        "verdict": found.against_band(),
    }
