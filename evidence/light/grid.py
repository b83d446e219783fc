"""The grid of loads and speeds, and how fast the cages run over pure rolling."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Annotated as A
from typing import NamedTuple

import numpy as np

from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.choice import load_scene
from beardyn_core.choice.load import complete_scene
from beardyn_core.config.load import read_scene
from beardyn_core.physics.tiers.status import Status, describe
from beardyn_core.rail.build import load_history
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin

LOADS_KN = (0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 80.0, 150.0)
SPEEDS_RPM = (20.0, 300.0, 1165.0, 2500.0)
SETS = ("all", "standard", "dry")
# `all` in the fast tier whose rollers and cages move by themselves.
FAST = "quasistatic"
# Where what 5 % of accuracy need leaves out most: a dry rib and no rolling resistance, or the latter alone.
AUTO = "auto"
AUTO_POINTS = ((300.0, 0.5), (1165.0, 1.0), (2500.0, 20.0))
LARGEST_RATIO = 1.002
SMALLEST_RATIO = 0.0
DURATION = 1.2
LISTENED = 0.5  # last part of it, of which the mean is taken
# In this tier light cages wander by their play, which 0.5 s of 20 rpm do not even out: 1.008 at 0.5 kN.
FAST_TURNS = 4.0
CAGES = Status.CAGE_FAST | Status.CAGE_BACKWARDS


@dataclass(frozen=True)
class Point:
    """How the cages ran at one load and speed."""

    effects: A[str, "set of effects, or `FAST`"]
    load_kn: A[float, "radial, [kN]"]
    speed_rpm: A[float, "of the shaft"]
    ratio: A[float, "mean speed of both cages over pure rolling, [-]"]
    status: A[int, "all bits that were set in the time listened to"]

    @property
    def told(self) -> str:
        """Say what the status tells of the cages."""
        return describe(self.status & CAGES) if self.status & CAGES else ""

    @property
    def holds(self) -> bool:
        """Whether the cages follow the rollers, or the status says why they do not."""
        return SMALLEST_RATIO <= self.ratio <= LARGEST_RATIO


def scene_of(effects: str, load_kn: float, speed_rpm: float) -> Scene:
    """Put a radial load and a speed on the bearing without play."""
    force = (0.0, 0.0, 1e3 * load_kn)
    operation = ConstantOperation(force=force, speed=speed_rpm * math.pi / 30.0)
    if effects == AUTO:
        found = read_scene("static_5kN", {("effects",): AUTO})
        return complete_scene(
            replace(found, scene=replace(found.scene, operation=operation, duration=DURATION))
        )
    if effects == FAST:
        turning = max(LISTENED, FAST_TURNS * 60.0 / speed_rpm)
        scene = load_scene("static_5kN", effects="all", tier=FAST)
        return replace(scene, operation=operation, duration=DURATION - LISTENED + turning)
    return replace(load_scene("static_5kN", effects=effects), operation=operation, duration=DURATION)


class Cages(NamedTuple):
    """How the cages of one run ran."""

    ratio: A[float, "mean speed of both over pure rolling, [-]"]
    status: A[int, "all bits that were set in the time listened to"]


def run_scene(scene: Scene) -> Cages:
    """Run a scene of `scene_of` and average its cages."""
    assert isinstance(scene.operation, ConstantOperation)
    twin = Twin(scene)
    twin.start(load_history(scene.operation, scene.mounting, scene.duration, scene.seed))
    nominal = cage_speed(scene.bearing, scene.operation.speed)
    ratios, status = [], 0
    while twin.next_end_ns <= scene.duration * 1e9:
        block = twin.advance()
        if block.start_ns >= (DURATION - LISTENED) * 1e9:
            status |= int(block.status)
            ratios.append(float(block.cage_speed.mean()) / nominal)
    return Cages(float(np.mean(ratios)), status)


def run_point(effects: str, load_kn: float, speed_rpm: float) -> Point:
    """Run one point and average the cages."""
    ratio, status = run_scene(scene_of(effects, load_kn, speed_rpm))
    return Point(effects, load_kn, speed_rpm, ratio, status)


def run_automatic() -> Iterator[Point]:
    """Run the points at which effects are chosen for the point itself."""
    for speed, load in AUTO_POINTS:
        yield run_point(AUTO, load, speed)


def run_grid(sets: tuple[str, ...] = (*SETS, FAST)) -> Iterator[Point]:
    """Run all points of some sets."""
    for effects in sets:
        for speed in SPEEDS_RPM:
            for load in LOADS_KN:
                yield run_point(effects, load, speed)
