"""A twin without physics that keeps the twin's contract: cheap signals that depend on the load only.

Run as a module it is the twin node around it: ``python -m test.ros.fake_twin twin [--ros-args ...]``;
``load`` and ``car_twin`` are nodes with a fake load and of several fake twins.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.scene.load import LoadHistory
from beardyn_core.sensors.block import Block
from test.record.synthetic_run import BLOCK_NS, SyntheticRun, description

SCENES = ("fake", "fake_slow", "fake_invalid", "fake_background", "fake_one_axis")
SLOW_BLOCK_S = 0.06
INVALID_BLOCK = 5


class FakeTwin:
    """Keeps the contract of `beardyn_core.twin.Twin`; the force is the load, interpolated."""

    block_ns = BLOCK_NS
    rows = 2

    def __init__(self, scene: str) -> None:
        self._scene = scene
        self._description = description()
        self.roller_count = self._description.roller_count
        self.body_names = self._description.body_names

    def warm(self) -> None:
        self._pattern = SyntheticRun(seed=7)

    def start(self, load: LoadHistory) -> None:
        self._load = load
        self._begin_ns = int(load.time_ns[0])
        self._index = 0
        self._pattern = SyntheticRun(seed=7)

    def feed(self, load: LoadHistory) -> None:
        self._load = LoadHistory(
            np.concatenate((self._load.time_ns, load.time_ns)),
            np.concatenate((self._load.wrench, load.wrench)),
            np.concatenate((self._load.shaft_speed, load.shaft_speed)),
            np.concatenate((self._load.bogie, load.bogie)),
        )

    @property
    def next_end_ns(self) -> int:
        return self._begin_ns + (self._index + 1) * BLOCK_NS

    @property
    def wanted_ns(self) -> int:
        return self.next_end_ns

    def end_load(self) -> None:
        """Take note of nothing: this twin does not look ahead."""

    def covered(self) -> bool:
        return bool(self._load.time_ns[-1] >= self.next_end_ns)

    def advance(self) -> Block:
        assert self.covered(), "advance() without load that covers the block"
        begin = time.perf_counter()
        block = self._pattern.block(self._index).later(self._begin_ns)
        block = replace(
            block,
            force_waveform=self._wrench(block.waveform_time_ns),
            force=self._wrench(block.trend_time_ns),
            load=self._wrench(block.trend_time_ns),
        )
        if self._scene == "fake_one_axis":  # the sensor measures z alone
            only_z = np.array([np.nan, np.nan, 1.0])
            received = tuple(
                replace(each, acceleration=each.acceleration * only_z) for each in block.vibration
            )
            block = replace(block, vibration=received)
        self._index += 1
        keep = max(int(np.searchsorted(self._load.time_ns, block.end_ns)) - 1, 0)
        self._load = self._load.part(keep, len(self._load))
        if self._scene == "fake_slow":
            time.sleep(SLOW_BLOCK_S)
        if self._scene == "fake_invalid" and self._index > INVALID_BLOCK:
            error = ValidityError("a roller has left its rib at t = 0.120 s; lower the load")
            error.block = replace(block, status=4)
            raise error
        return replace(block, wall_s=time.perf_counter() - begin)

    def _wrench(self, time_ns: np.ndarray) -> np.ndarray:
        columns = [
            np.interp(time_ns.astype(float), self._load.time_ns.astype(float), self._load.wrench[:, axis])
            for axis in range(6)
        ]
        return np.stack(columns, axis=1)

    def truth(self) -> dict[str, Any]:
        return dict(self._description.truth)


def fake_rig(scene: str, _tier: str, _effects: str = "") -> Callable[[], Any]:
    from beardyn_ros.rig import Rig

    if scene not in SCENES:
        raise InputError(f"scene '{scene}' does not exist, there are {', '.join(SCENES)}")

    def build() -> Rig:
        twin = FakeTwin(scene)
        background = "driven_emu" if scene == "fake_background" else ""
        return Rig(twin, replace(description(), load=None, truth=twin.truth()), background)

    return build


def fake_history(_scene: str, _csv: str, duration: float) -> LoadHistory:
    load = description(duration or 1.0).load
    assert load is not None
    return load


def fake_scenario(scene: str, csv: str, duration: float) -> Any:
    from beardyn_ros.scenario import Scenario

    return Scenario(fake_history(scene, csv, duration), {"scene": "fake", "seed": 7})


def main(words: Sequence[str]) -> int:
    from beardyn_ros.environment import prepare_environment

    prepare_environment()
    if words[0] == "load":
        from beardyn_ros.load_node import main as load_main

        return load_main(words[1:], fake_scenario)
    if words[0] == "car_twin":
        from beardyn_ros import car

        car.box_rig = lambda train, box, pace=0.0: lambda *_: fake_rig("fake", "")
        return car.run_twins(words[1:])
    from beardyn_ros.twin_node import main as twin_main

    return twin_main(words[1:], fake_rig)


if __name__ == "__main__":
    from beardyn_ros.runtime import leave

    leave(main(sys.argv[1:]))
