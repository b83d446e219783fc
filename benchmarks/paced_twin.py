"""The real twin node in real time: twin and load node as processes, lateness of every block.

``python -m benchmarks.paced_twin --scene smooth_run --tier full --effects auto --seconds 60`` runs one
level alone. A block is late when it is handed over more than 40 ms after it is due.
"""

from __future__ import annotations

import argparse
import os
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from beardyn_core.choice import load_scene
from beardyn_core.config import scene_text
from beardyn_core.record.messages import Diagnostic, decode_diagnostics, header_stamp
from beardyn_core.record.topics import topic
from beardyn_core.scene.scene import Scene
from beardyn_ros.environment import MISSING_ROS, prepare_environment, ros_available
from beardyn_ros.processes import Processes, free_domain_id, local_environment
from benchmarks.runs import Table

SCENE = "smooth_run"


class Level(NamedTuple):
    """What a twin computes with; laminae and steps are those that tier and effects get by themselves."""

    tier: str
    effects: str


# the dearest first
LEVELS = (Level("full", "full"), Level("full", "auto"), Level("quasistatic", "auto"), Level("lumped", "auto"))
READY_TIMEOUT_S = 600.0
COLUMNS = (
    *(
        "tier",
        "effects",
        "laminae",
        "steps a sample",
        "simulated s",
        "wall s",
        "blocks",
        "late",
        "worst late ms",
        "worst arrival ms",
    ),
    *("RTF", "waited for load s", "state"),
)


@dataclass(frozen=True)
class Reception:
    """What a listener in another process saw of a run.

    Parameters
    ----------
    last : Diagnostic
        Last words of the twin.
    wall_s : float
        From the first to the last block, [s].
    worst_arrival_s : float
        Largest delay of a block against the beat of the wall clock that the fastest one sets, [s].
    """

    last: Diagnostic
    wall_s: float
    worst_arrival_s: float


class _Listener:
    """Diagnostics and clock of the graph."""

    def __init__(self, domain: int) -> None:
        import rclpy
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.node import Node

        from beardyn_ros.wire import RawIntake

        os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
        self._context = rclpy.Context()
        rclpy.init(context=self._context, domain_id=domain)
        self._node = Node("stopwatch", namespace="axlebox", context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self.twin: Diagnostic | None = None
        self.arrivals: list[tuple[float, float]] = []
        intake = RawIntake(self._node)
        intake.add(topic("/diagnostics"), self._receive)
        intake.add(topic("/clock"), self._on_clock)

    def _receive(self, cdr: bytes) -> None:
        for status in decode_diagnostics(cdr)[1]:
            if status.name.endswith("/twin"):
                self.twin = status

    def _on_clock(self, cdr: bytes) -> None:
        self.arrivals.append((time.monotonic(), header_stamp(cdr) * 1e-9))

    def state(self) -> str:
        """Return the state of the twin."""
        return str(self.twin.value("state")) if self.twin else ""

    def until(self, states: tuple[str, ...], timeout: float, processes: Processes) -> None:
        """Wait for a state of the twin, or for the end of its process."""
        deadline = time.monotonic() + timeout
        while self.state() not in states:
            self._executor.spin_once(timeout_sec=0.2)
            if processes.failed() or time.monotonic() > deadline:
                raise RuntimeError(f"the twin is '{self.state()}': {processes.log('twin')[-2000:]}")

    def close(self) -> None:
        """Leave the graph."""
        self._executor.shutdown()
        self._node.destroy_node()
        self._context.try_shutdown()


def run_paced(scene: Scene, mode: str = "lockstep") -> Reception:
    """Run a scene at speed factor 1; ``mode``: ``lockstep`` or ``live``."""
    prepare_environment()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        file = folder / "paced.yaml"
        file.write_text(scene_text(scene), encoding="utf-8")
        domain = free_domain_id()
        common = ["-p", f"scene:={file}", "-p", f"mode:={mode}", "-p", "speed_factor:=1.0"]
        with Processes(local_environment(domain), folder) as processes:
            listener = _Listener(domain)
            try:
                processes.start("twin", "-m", "beardyn_ros", "twin", "--ros-args", *common)
                listener.until(("waiting for load",), READY_TIMEOUT_S, processes)
                lasting = ("-p", f"duration:={scene.duration}")
                processes.start("load", "-m", "beardyn_ros", "load", "--ros-args", *common, *lasting)
                listener.until(("finished", "stopped"), 60.0 + 20.0 * scene.duration, processes)
            finally:
                listener.close()
    assert listener.twin is not None
    offsets = [wall - simulated for wall, simulated in listener.arrivals]
    wall_s = listener.arrivals[-1][0] - listener.arrivals[0][0]
    return Reception(listener.twin, wall_s, max(offsets) - min(offsets))


def row(level: Level, scene: Scene, received: Reception) -> tuple[str | float | int, ...]:
    """Write the row of the table."""

    def number(key: str) -> float:
        return float(received.last.value(key) or 0.0)

    return (
        *level,
        scene.numerics.laminae,
        scene.numerics.steps_per_sample,
        number("simulated_time"),
        received.wall_s,
        int(number("blocks")),
        int(number("late_blocks")),
        1e3 * number("worst_lag"),
        1e3 * received.worst_arrival_s,
        number("real_time_factor"),
        number("waited_for_load"),
        str(received.last.value("state")),
    )


def paced(seconds: float, name: str = SCENE, levels: tuple[Level, ...] = LEVELS) -> Table:
    """Try levels from the finest down to the first that keeps up for the whole time."""
    rows: list[tuple[str | float | int, ...]] = []
    note = f"speed factor 1, lockstep; load average {os.getloadavg()[0]:.2f} before"
    if not ros_available():
        return Table("paced", "Twin node in real time", COLUMNS, rows, MISSING_ROS)
    for level in levels:
        scene = load_scene(name, tier=level.tier, effects=level.effects, duration=seconds)
        received = run_paced(scene)
        rows.append(row(level, scene, received))
        if received.last.value("late_blocks") == "0" and received.last.value("state") == "finished":
            break
    else:
        note += "; no level has kept up"
    return Table("paced", f"Twin node in real time, {name}, {seconds:g} s", COLUMNS, rows, note)


def main() -> None:
    """Run one level."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.paced_twin", description=__doc__)
    parser.add_argument("--scene", default=SCENE)
    parser.add_argument("--tier", default=LEVELS[0].tier)
    parser.add_argument("--effects", default=LEVELS[0].effects)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--mode", choices=("lockstep", "live"), default="lockstep")
    given = parser.parse_args()
    level = Level(given.tier, given.effects)
    scene = load_scene(given.scene, **level._asdict(), duration=given.seconds)
    received = run_paced(scene, given.mode)
    table = Table(
        "paced",
        f"Twin node in real time, {given.scene}, {given.mode}",
        COLUMNS,
        [row(level, scene, received)],
    )
    print("\n".join(table.lines()))


if __name__ == "__main__":
    main()
