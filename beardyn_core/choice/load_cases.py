"""Load cases of a scene: typical, lightest and heaviest load, and the axial extremes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.rail.build import load_of_scene
from beardyn_core.rail.measured import read_measurement
from beardyn_core.scene.operation import ConstantOperation, MeasuredOperation, SteppedOperation
from beardyn_core.scene.scene import Scene

# A load that depends on chance is looked at this long.
_LONGEST_LOOK = 1.0
# Share of the time that may be lighter, or heavier, than the lightest and the heaviest case.
_RARE = 0.02
_AXIAL_SHARE = 0.02
_SAME = 0.02


@dataclass(frozen=True)
class LoadCase:
    """One load on the journal."""

    name: A[str, "``typical``, ``lightest``, ``heaviest`` or ``axial``"]
    force: A[tuple[float, float, float], "[N]"]
    moment: A[tuple[float, float, float], "[N m]"]
    speed: A[float, "of the shaft, [rad/s]"]

    @property
    def size(self) -> float:
        """Magnitude of the force, [N]."""
        return float(np.linalg.norm(self.force))


@dataclass(frozen=True)
class Circumstances:
    """The load cases of a scene."""

    cases: A[tuple[LoadCase, ...], "the typical one first; those that are nearly the same are left out"]
    top_speed: A[float, "largest amount of the shaft speed, [rad/s]"]
    axial_low: A[float, "smallest axial force, [N]"]
    axial_high: A[float, "largest axial force, [N]"]

    @property
    def typical(self) -> LoadCase:
        """Median force."""
        return self.cases[0]

    @property
    def reverses(self) -> bool:
        """Whether the axial force changes its sign by more than a share of the typical force."""
        notable = _AXIAL_SHARE * self.typical.size
        return self.axial_low < -notable and self.axial_high > notable


def circumstances(scene: Scene) -> Circumstances:
    """Find the load cases of a scene's operation."""
    wrench, speed = _samples(scene)
    wrench = scene.mounting.about_bearing_centre(wrench)
    size = np.linalg.norm(wrench[:, :3], axis=1)
    order = np.argsort(size, kind="stable")
    last = len(order) - 1
    # a mean over revolutions is asked for: the load that is there half of the time stands for it
    picks = {
        "typical": order[last // 2],
        "lightest": order[round(_RARE * last)],
        "heaviest": order[round((1.0 - _RARE) * last)],
    }
    axial = wrench[:, 1]
    if np.ptp(axial) > _AXIAL_SHARE * max(size[picks["typical"]], 1.0):
        picks |= {"axial": int(np.argmin(axial)), "axial, other way": int(np.argmax(axial))}
    cases: list[LoadCase] = []
    for name, index in picks.items():
        x, y, z, mx, my, mz = wrench[index].tolist()
        case = LoadCase(name, (x, y, z), (mx, my, mz), float(speed[index]))
        if not any(_alike(case, other) for other in cases):
            cases.append(case)
    return Circumstances(
        tuple(cases),
        top_speed=float(np.abs(speed).max()),
        axial_low=float(axial.min()),
        axial_high=float(axial.max()),
    )


def _alike(one: LoadCase, other: LoadCase) -> bool:
    turned = np.abs(np.subtract(one.moment, other.moment)).max() / 0.1
    apart = np.abs(np.subtract(one.force, other.force)).max() + turned
    return bool(apart <= _SAME * max(one.size, other.size, 1.0))


def _samples(scene: Scene) -> tuple[Float, Float]:
    """Sample equally likely wrenches and shaft speeds, shapes [sample, 6] and [sample]."""
    operation, look = scene.operation, min(scene.duration, _LONGEST_LOOK)
    if isinstance(operation, ConstantOperation):
        return np.array([[*operation.force, *operation.moment]]), np.array([operation.speed])
    if isinstance(operation, SteppedOperation):
        steps = [step for step in operation.steps if step.time < scene.duration]
        ends = [*(step.time for step in steps[1:]), scene.duration]
        counts = [
            max(1, round(1000 * (end - step.time) / scene.duration))
            for step, end in zip(steps, ends, strict=True)
        ]
        levels = np.array([[*step.force, *step.moment, step.speed] for step in steps])
        signals = np.repeat(levels, counts, axis=0)
        return signals[:, :6], signals[:, 6]
    if isinstance(operation, MeasuredOperation) and operation.take == "both":
        measured = read_measurement(operation.path)
        within = measured.time <= scene.duration
        return measured.wrench[within], measured.shaft_speed[within]
    history = load_of_scene(scene, look)
    begun = history.time_ns >= min(0.2, 0.5 * look) * 1e9  # the irregularity fades in
    if not begun.any():
        raise InputError(f"{scene.name}: duration is {scene.duration:g} s, too short to have a load")
    return history.wrench[begun], history.shaft_speed[begun]
