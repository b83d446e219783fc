"""The summary of a recorded run, made from its arrays."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.physics.bodies.losses import LOSS_NAMES
from beardyn_core.record.encoding import loss_key
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.waviness import Waviness
from beardyn_core.sensors.summary import (
    COMPLETE,
    NUMERICAL,
    SETTLING_S,
    RunSummary,
    TorqueBudget,
    TrendMeans,
    torque_budget,
    trend_means,
)

if TYPE_CHECKING:
    from beardyn_core.physics.statics.rating_life import RatingLife
    from beardyn_core.record.run import Run


def summary_of(run: Run) -> RunSummary:
    """Summarise a run as ``beardyn simulate`` does, as far as its arrays allow.

    Raises
    ------
    InputError
        The recording does not name its scene.
    """
    description, truth = run.described(), run.truth
    means = _means(run)
    factors = collect_diagnostic(run, "real_time_factor")
    residuals = collect_diagnostic(run, "energy_residual")
    waves = [Waviness(**each) for each in truth.get("waviness", ())]
    warm = run.temperature
    return RunSummary(
        scene=description.scene,
        tier=str(truth.get("tier", "")),
        effects=tuple(truth.get("effects", ())),
        not_in_tier=tuple(truth.get("not_in_this_tier", {}).get("effects", ())),
        chosen=chosen_for(truth) or "",
        duration=round(run.duration, 9),
        wall_time=run.duration / float(np.mean(factors)) if factors else 0.0,
        status=run.status or (COMPLETE if run.complete else run.problem),
        mean_force=means.force,
        shaft_torque=means.torque,
        cage_speed_ratio=means.cage_speed_ratio(
            description.shape.fault_frequencies["FTF"], int(truth.get("rows", 2))
        ),
        energy_residual=residuals[-1] if residuals else None,
        budget=recorded_budget(run),
        averaged=means.averaged,
        cage_revolutions=means.revolutions,
        life=_life(run),
        faults=tuple(each.described() for each in (*description.defects, *waves)),
        temperatures=tuple(zip(warm.components, warm.values[-1].tolist(), strict=True)) if len(warm) else (),
        shaft_speed=means.shaft_speed,
        largest_roller_load=_largest(run.contacts.largest, 1),
        largest_pressure=_largest(run.contacts.largest_pressure, 2),
        wheel_diameter=truth.get("wheel_diameter_m"),
    )


def _largest(values: Float, raceways: int) -> float:
    """Find the largest number of the cup, or of cup and cone; NaN where none is known."""
    seen = values[..., :raceways]
    return float(np.nanmax(seen)) if np.isfinite(seen).any() else float("nan")


def chosen_for(truth: Mapping[str, Any]) -> str | None:
    """Find the sentence of what the effects of a run were chosen for; earlier versions have none."""
    return next((each for each in truth.get("chosen", ()) if "chosen for" in each), None)


def _means(run: Run) -> TrendMeans:
    time, slow = run.force.time, run.torque.time
    if not len(time) or not len(slow) or not len(run.shaft):
        return TrendMeans()
    cages = np.stack([np.interp(time, slow, row) for row in run.cages.speed.T], axis=1)
    return trend_means(
        time,
        run.force.values[:, :3],
        np.interp(time, slow, run.torque.values),
        np.interp(time, run.shaft.time, run.shaft.speed),
        cages,
    )


def life_of(scene: Scene, load: LoadHistory) -> RatingLife | None:
    """Rate the life under the load of a run; a load that nothing can carry has none.

    The standards rate the whole bearing: neither has one that lacks rollers.
    """
    if scene.rows != 2 or scene.missing_rollers:
        return None
    from beardyn_core.physics.statics.rating_life import scene_life  # brings the compiler along

    try:
        return scene_life(scene, load)
    except ValidityError:
        return None


def _life(run: Run) -> RatingLife | None:
    """Rate the bearing under the recorded load; ``None`` when the scene or the load is not known."""
    from beardyn_core.choice import scene_from_text

    load = run.load
    if not run.scene_text or not len(load):
        return None
    try:
        scene = scene_from_text(run.scene_text, run.label)
        return life_of(scene, LoadHistory(load.time_ns, load.wrench, load.shaft_speed, load.bogie))
    except InputError:
        return None


def collect_diagnostic(run: Run, key: str) -> list[float]:
    """Collect a number that the diagnostics of the twin carry."""
    values = (_number(status.value(key)) for _, statuses in run.diagnostics for status in statuses)
    return [value for value in values if value is not None]


def _number(text: str | None) -> float | None:
    """Read a number; ``None`` for what is none, as a foreign diagnostic may have it."""
    with suppress(ValueError):
        return None if text is None else float(text)
    return None


def recorded_budget(run: Run) -> TorqueBudget | None:
    """Make the torque budget of the energies in the diagnostics, without the first part of the run."""
    wanted = [loss_key(source) for source in (*LOSS_NAMES, NUMERICAL)]
    rows = [
        (stamp * 1e-9, *(_number(status.value(key)) or 0.0 for key in wanted))
        for stamp, statuses in run.diagnostics
        for status in statuses
        if not set(wanted).isdisjoint(key for key, _ in status.values)
    ]
    if len(rows) < 2:
        return None
    lost = np.array(rows)
    lost = lost[lost[:, 0] >= lost[0, 0] + min(SETTLING_S, 0.5 * (lost[-1, 0] - lost[0, 0]))]
    within = (run.shaft.time >= lost[0, 0]) & (run.shaft.time <= lost[-1, 0])
    speed = float(np.abs(run.shaft.speed[within]).mean()) if within.any() else float("nan")
    return torque_budget(lost[:, 0].tolist(), lost[:, 1:], speed)
