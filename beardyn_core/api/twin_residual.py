"""Measured minus twin: third octaves of a bearing and of a twin in its known state."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite, nan, pi
from typing import Any

import numpy as np

from beardyn_core.api.making import scene as make_scene
from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import write_noun
from beardyn_core.base.errors import InputError
from beardyn_core.base.units import STANDARD_GRAVITY, ZERO_CELSIUS
from beardyn_core.follow.descriptors import describe
from beardyn_core.follow.estimator import Estimates, Estimator
from beardyn_core.follow.inference import stretches_of
from beardyn_core.follow.residual import Residual, residual_of
from beardyn_core.population.batch import simulated
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.labels import HEALTHY

_TWIN_STRETCHES = 4  # that are compared with the twin, the last ones
_USUAL_LENGTH_MM, _DEPTH_UM = 20.0, 100.0  # of a spall whose length is not given; of all


def residual_beside(
    estimator: Estimator, rows: Float, known: Estimates, base: Scene, tier: str = "quasistatic"
) -> Residual:
    """Run a twin in the known state, and compare its third octaves with those of measured stretches.

    Raises
    ------
    InputError
        The scene of the twin is not on a track.
    """
    scene = scene_beside(base, known, tier, 1.1 * estimator.stretch)
    stretches = stretches_of(simulated(scene), estimator)
    beside = [describe(each, estimator.orders, estimator.plate, estimator.axes) for each in stretches]
    if not beside:
        raise InputError(f"scene {base.name}: the twin gives no whole stretch at this speed")
    return residual_of(estimator, rows[-_TWIN_STRETCHES:], np.stack(beside))


def scene_beside(base: Scene, known: Estimates, tier: str, duration: float) -> Scene:
    """Give the scene of a twin at the state that is known; what is not given stays that of `base`.

    A spall of which the least width alone is known has that one.

    Raises
    ------
    InputError
        The scene is not on a track.
    """
    course = base.operation
    if not isinstance(course, QuarterVehicleOperation):
        raise InputError(f"scene {base.name}: a twin next to a train runs on a track (kind: quarter_vehicle)")
    told = {each.quantity.name: each.value for each in known.quantities if isfinite(each.value)}
    operation: dict[str, Any] = write_noun(course)
    speed = known.shaft_frequency * pi * course.wheel_diameter
    operation["speed_profile"] = [{"time_s": 0.0, "speed_kmh": 3.6 * speed}]
    if "lateral_load" in told:
        operation["lateral_force_kN"] = 1e-3 * told["lateral_load"]
    if "vertical_load" in told:
        other = course.vehicle.bogie_mass / 4.0 + base.mounting.box_mass
        body = 8.0 * (told["vertical_load"] / STANDARD_GRAVITY - other)
        operation["vehicle"] = {**operation["vehicle"], "body_mass_t": 1e-3 * (body - course.payload)}
    part = "" if known.part is None else known.part.condition
    keys: dict[str, Any] = {"operation": operation}
    if "end_play" in told:
        keys["end_play_mm"] = 1e3 * told["end_play"]
    if "temperature" in told:
        keys["temperature_C"] = told["temperature"] - ZERO_CELSIUS
    faults: list[Mapping[str, Any]] = []
    width = told.get("width", _least_width(known))
    if part not in ("", HEALTHY) and isfinite(width):
        length = 1e3 * told["length"] if "length" in told else _USUAL_LENGTH_MM
        size = {"width_mm": 1e3 * width, "length_mm": length, "depth_um": _DEPTH_UM}
        faults = [{"on": part, **size}]
    return make_scene(base, tier=tier, duration=duration, faults=faults, **keys)


def _least_width(known: Estimates) -> float:
    return next((each.at_least for each in known.quantities if each.quantity.name == "width"), nan)
