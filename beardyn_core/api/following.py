"""Follow one bearing over a run, or over several."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isfinite, pi
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.api.making import scene as make_scene
from beardyn_core.api.reading import heard_of
from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import written
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.config import load_bearing, load_lubricant
from beardyn_core.follow.descriptors import describe
from beardyn_core.follow.estimator import Estimates, Estimator, read_estimator
from beardyn_core.follow.following import Followed, Follower
from beardyn_core.follow.forecast import Service
from beardyn_core.follow.growth import GrowthLaw
from beardyn_core.follow.inference import doubt_of, stretches_of
from beardyn_core.follow.residual import Residual, residual_of
from beardyn_core.follow.shipped import shipped_for
from beardyn_core.population.batch import simulated
from beardyn_core.record.run import Run
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.labels import HEALTHY

_GRAVITY = 9.81
_TWIN_STRETCHES = 4  # that are compared with the twin, the last ones
_USUAL_LENGTH_MM, _DEPTH_UM = 20.0, 100.0  # of a spall whose length is not told; of all


@dataclass(frozen=True)
class Following:
    """What following a bearing has come to."""

    steps: A[tuple[Followed, ...], "after every stretch"]
    residual: A[Residual | None, "what is heard beside the twin at the end; none without a twin"]

    @property
    def sentences(self) -> list[str]:
        """Say everything, a line each."""
        lines = [each.sentence for each in self.steps]
        last = self.steps[-1]
        lines += ["at the end:", *last.estimates.sentences]
        lines += [] if last.remains is None else last.remains.sentences
        if self.residual is not None:
            lines.append(
                f"twin beside it: {100 * self.residual.explained:.0f} % of the third octaves explained"
            )
            lines += self.residual.sentences
        return lines


def follow(
    runs: Run | Path | str | Sequence[Run | Path | str],
    estimator: Estimator | Path | str | None = None,
    *,
    bearing: Bearing | NamePlate | str | None = None,
    sensor: str = "",
    service: Service | None = None,
    mileages: Sequence[float] | None = None,
    law: GrowthLaw | None = None,
    lubricant: Lubricant | str = "L055",
    twin: Scene | Path | str | None = None,
    tier: str = "quasistatic",
) -> Following:
    """Follow load, end play and spall of one bearing over its runs, stretch by stretch.

    Parameters
    ----------
    runs : Run, Path or sequence of them
        Of one axlebox, in the order of time. Loads, end play and temperature are learnt anew in each.
    estimator, bearing, sensor
        See `beardyn_core.estimate`.
    service : Service, optional
        Mileage at the first run, wheel, and the width at which a bearing is taken out.
    mileages : sequence of float, optional
        Since the first run, at the begin of each, [m]; by default each goes on where the one before ended.
    law : GrowthLaw, optional
        Of spalls, before anything is known of this one.
    lubricant : Lubricant or str
    twin : Scene or Path, optional
        Scene of this axlebox on its track, sound: it runs at the state known at the end, and what is heard
        is compared with it. By default no twin.
    tier : str
        Of the twin: ``lumped`` or ``quasistatic``.

    Raises
    ------
    InputError
        No estimator fits, an axis is not measured, the runs are too short, or mileages fall.
    """
    several = [runs] if isinstance(runs, Run | Path | str) else list(runs)
    if mileages is not None and len(mileages) != len(several):
        raise InputError(f"mileages: has {len(mileages)} of them for {len(several)} runs; give one a run")
    for before, after in pairwise(mileages or ()):
        if after < before:
            raise InputError(
                f"mileages: {after:g} m comes after {before:g} m; give them in the order of time"
            )
    heard, plate, ear = heard_of(several[0], bearing, sensor)
    follower = follower_of(plate, estimator, service=service, law=law, lubricant=lubricant)
    steps, rows = list[Followed](), list[Float]()
    time = distance = 0.0
    for k, run in enumerate(several):
        if k:
            heard, plate, ear = heard_of(run, bearing, sensor)
            follower.begin()
        begin = distance if mileages is None else mileages[k]
        for row, end, metres in _stretches(heard, follower, plate, ear):
            rows.append(row)
            steps.append(follower.take(row, time + end, begin + metres))
        time, distance = (steps[-1].time, steps[-1].distance) if steps else (0.0, begin)
    if not steps:
        raise InputError(f"{heard.label}: has no stretch of {follower.estimator.stretch:.2f} s to follow")
    residual = None
    if twin is not None:
        base = twin if isinstance(twin, Scene) else make_scene(twin)
        residual = residual_beside(follower.estimator, np.stack(rows), steps[-1].estimates, base, tier)
    return Following(tuple(steps), residual)


def follower_of(
    plate: Bearing | NamePlate,
    estimator: Estimator | Path | str | None = None,
    *,
    service: Service | None = None,
    law: GrowthLaw | None = None,
    lubricant: Lubricant | str = "L055",
) -> Follower:
    """Make the filter of one bearing; see `follow`.

    Raises
    ------
    InputError
        The estimator is for another bearing.
    """
    if estimator is None:
        estimator = shipped_for(plate)
    elif not isinstance(estimator, Estimator):
        estimator = read_estimator(Path(estimator))
    if doubt := doubt_of(estimator, plate):
        raise InputError(f"{doubt}; train one with `beardyn train`")
    whole = plate if isinstance(plate, Bearing) else _whole(plate.name)
    grease = load_lubricant(lubricant) if isinstance(lubricant, str) else lubricant
    return Follower(estimator, whole, grease, service or Service(), law or GrowthLaw())


def _whole(name: str) -> Bearing | None:
    """Find the bearing of a name plate; none where only the plate is known."""
    try:
        return load_bearing(name)
    except InputError:
        return None


def _stretches(
    run: Run, follower: Follower, plate: Bearing | NamePlate, sensor: str
) -> Iterator[tuple[Float, float, float]]:
    """Give descriptors, end [s] and way of the wheel since the begin [m] of each stretch of a run."""
    estimator, wheel = follower.estimator, follower.service.wheel_diameter
    if doubt := doubt_of(estimator, plate):
        raise InputError(f"{run.label}: {doubt}; train one with `beardyn train`")
    turned = np.unwrap(run.shaft.angle) if len(run.shaft) else np.zeros(1)
    begin_ns = int(run.shaft.time_ns[0]) if len(run.shaft) else 0
    for stretch in stretches_of(run, estimator, sensor):
        row = describe(stretch, estimator.orders, estimator.plate, estimator.axes)
        angle = float(np.interp(stretch.end_ns, run.shaft.time_ns, turned)) - float(turned[0])
        yield row, 1e-9 * (stretch.end_ns - begin_ns), 0.5 * wheel * abs(angle)


def residual_beside(
    estimator: Estimator, rows: Float, known: Estimates, base: Scene, tier: str = "quasistatic"
) -> Residual:
    """Run a twin at a state that is known, and compare its third octaves with those of stretches heard.

    Raises
    ------
    InputError
        The scene of the twin is not on a track.
    """
    scene = scene_beside(base, known, tier, 1.1 * estimator.stretch)
    stretches = stretches_of(simulated(scene), estimator)
    beside = [describe(each, estimator.orders, estimator.plate, estimator.axes) for each in stretches]
    if not beside:
        raise InputError(f"scene {base.name}: the twin beside gives no whole stretch at this speed")
    return residual_of(estimator, rows[-_TWIN_STRETCHES:], np.stack(beside))


def scene_beside(base: Scene, known: Estimates, tier: str, duration: float) -> Scene:
    """Give the scene of a twin at the state that is known; what is not told stays that of `base`.

    Raises
    ------
    InputError
        The scene is not on a track.
    """
    course = base.operation
    if not isinstance(course, QuarterVehicleOperation):
        raise InputError(f"scene {base.name}: a twin beside a train runs on a track (kind: quarter_vehicle)")
    told = {each.quantity.name: each.value for each in known.quantities if isfinite(each.value)}
    operation: dict[str, Any] = written(course)
    speed = known.shaft_frequency * pi * course.wheel_diameter
    operation["speed_profile"] = [{"time_s": 0.0, "speed_kmh": 3.6 * speed}]
    if "lateral_load" in told:
        operation["lateral_force_kN"] = 1e-3 * told["lateral_load"]
    if "vertical_load" in told:
        other = course.vehicle.bogie_mass / 4.0 + base.mounting.box_mass
        body = 8.0 * (told["vertical_load"] / _GRAVITY - other)
        operation["vehicle"] = {**operation["vehicle"], "body_mass_t": 1e-3 * (body - course.payload)}
    part = "" if known.part is None else known.part.condition
    keys: dict[str, Any] = {"operation": operation}
    if "end_play" in told:
        keys["end_play_mm"] = 1e3 * told["end_play"]
    if "temperature" in told:
        keys["temperature_C"] = told["temperature"] - 273.15
    faults: list[Mapping[str, Any]] = []
    if part not in ("", HEALTHY) and "width" in told:
        length = 1e3 * told["length"] if "length" in told else _USUAL_LENGTH_MM
        size = {"width_mm": 1e3 * told["width"], "length_mm": length, "depth_um": _DEPTH_UM}
        faults = [{"on": part, **size}]
    return make_scene(base, tier=tier, duration=duration, faults=faults, **keys)
