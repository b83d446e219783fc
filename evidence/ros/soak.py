"""Everything that goes wrong in a graph, in turn, for a stated time: ``python -m evidence.ros.soak``.

Nodes are killed with SIGKILL, fed malformed and late messages and those of a stranger on every topic, given a
full disk, clocks that jump, and live load of two clocks, one of which is set. What must hold is written
beside each fault; one that does not hold is printed and makes the exit code 1.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from beardyn_core.record.clouds import column_dtype, encode_points, points_of
from beardyn_core.record.load_stream import encode_load
from beardyn_core.record.messages import encode_clock, header_stamp
from beardyn_core.record.reading import read_run
from beardyn_core.record.topics import TOPICS
from evidence.ros.costs import usage
from evidence.ros.fuzz import forget_statuses
from evidence.ros.hostile import Hostile
from test.ros.fake_twin import fake_history
from test.ros.graph import Graph
from test.ros.live_train import LiveTrain

BEGIN_S = 2.0  # of a run before a fault
STRAYS = 500  # messages of a stranger
LATEST_S = 5.0  # stamps behind their clock on a machine that is busy
CLOUDS = ("load/blocks", "vibration", "force_waveform", "bodies", "contacts")
CLOCKS_NS = (0, 2_000_000_000_000_000_000, 1, 10**18, 0)


class Soak:
    """One graph, started anew where a fault ends it.

    Parameters
    ----------
    folder : Path
        Of recordings and logs.

    Attributes
    ----------
    problems : list of str
        What did not hold.
    """

    def __init__(self, folder: Path) -> None:
        self.problems: list[str] = []
        self._folder = folder
        self._number = 0
        self.graph: Graph

    def faults(self) -> tuple[Callable[[], None], ...]:
        """List the faults in their order."""
        return (
            self.kill_monitor,
            self.kill_recorder,
            self.send_malformed,
            self.send_late,
            self.send_as_stranger,
            self.jump_clocks,
            self.set_clock_of_live_load,
            self.fill_disk,
            self.kill_load,
            self.kill_twin,
        )

    def run(self, fault: Callable[[], None]) -> None:
        """Start all nodes, let one fault happen, and note what does not hold."""
        self._number += 1
        place = self._folder / f"{self._number}_{fault.__name__}"
        place.mkdir()
        with Graph(place) as self.graph:
            try:
                start = self._start_live if fault == self.set_clock_of_live_load else self._start
                start(place)
                fault()
            except (AssertionError, OSError) as error:
                self._check(False, f"{fault.__name__}: {error}")
            for log in place.glob("*.log"):
                self._check("Traceback" not in log.read_text(errors="replace"), f"{log}: a traceback")
        for path in place.glob("*.mcap"):
            path.unlink()

    def _start(self, place: Path) -> None:
        graph = self.graph
        graph.fake_twin(speed_factor=1.0, load_timeout=3.0)
        self._record(place / "run.mcap")
        graph.node_process("monitor")
        self._connected("recorder")
        self._connected("monitor")
        graph.fake_load(duration=20.0, loop=True)
        self._passes(BEGIN_S)

    def _start_live(self, place: Path) -> None:
        graph = self.graph
        graph.listen("force_waveform")
        graph.fake_twin(mode="live", max_age=10.0)
        self._record(place / "run.mcap")
        graph.node_process("monitor")
        self._connected("recorder")
        self._connected("monitor")

    def _record(self, path: Path) -> None:
        self._file = path
        self.graph.node_process("recorder", output=str(path))

    def _connected(self, part: str) -> None:
        self.graph.messages["/diagnostics"].clear()
        self.graph.until(
            lambda: any(s.value("connected") == "true" for s in self.graph.statuses(part)),
            f"{part} connected",
        )

    def _passes(self, seconds: float) -> None:
        """Wait until the twin has simulated that much more."""

        def simulated() -> float:
            return max((float(s.value("simulated_time")) for s in self.graph.statuses("twin")), default=0.0)

        self.graph.messages["/diagnostics"].clear()
        self.graph.until(lambda: self.graph.statuses("twin"), "a word of the twin", check_processes=False)
        goal = simulated() + seconds
        self.graph.until(lambda: simulated() >= goal, f"{seconds:g} s more", check_processes=False)

    def _check(self, holds: bool, what: str) -> None:
        if not holds:
            self.problems.append(what)
            print(f"  DOES NOT HOLD: {what}", flush=True)

    def _ends(self, node: str, code: int) -> None:
        found = self.graph.exit_code(node)
        self._check(found == code, f"{node} ended with {found}, {code} is right")

    def _alive(self, *nodes: str) -> None:
        for node in nodes:
            self._check(self.graph.processes.exit_code(node) is None, f"{node} has ended")

    def _refused(self, part: str) -> int:
        found = self.graph.statuses(part)
        return int(found[-1].value("refused_messages") or 0) if found else 0

    # --- faults --------------------------------------------------------------------------------------

    def kill_monitor(self) -> None:
        """Kill the monitor: a new one listens, nobody else notices."""
        self.graph.processes.signal("monitor", signal.SIGKILL)
        self.graph.node_process("monitor")
        self._connected("monitor")
        self._alive("twin", "load", "recorder")

    def kill_recorder(self) -> None:
        """Kill the recorder: its file is whole but for the last second, the next one records on."""
        before = self._file
        self.graph.processes.signal("recorder", signal.SIGKILL)
        run = read_run(before)
        self._check(bool((np.diff(run.vibration.sample) == 1).all()), f"{before}: gaps")
        self._check(len(run.vibration) * 1.0 / run.vibration.rate > BEGIN_S - 1.0, f"{before}: too short")
        self._record(before.with_name("second.mcap"))
        self._connected("recorder")
        self._passes(1.0)
        self._alive("twin", "load", "recorder")

    def send_malformed(self) -> None:
        """Publish malformed messages: they are counted and refused, everybody goes on."""
        points = points_of(column_dtype((("x", "f4"),)), 0, np.arange(5), 0)
        wrong = encode_points(points, 0, "axlebox")
        self.graph.connected(*CLOUDS)
        for name in CLOUDS:
            for cdr in (wrong, wrong[:50], b"\x00\x01\x00\x00"):
                self.graph.out.publish(name, cdr)
        self.graph.until(lambda: self._refused("recorder") == 3 * len(CLOUDS), "refusals of the recorder")
        self.graph.until(lambda: self._refused("twin") >= 3, "refusals of the twin")
        self._passes(1.0)
        self._alive("twin", "load", "recorder", "monitor")

    def send_late(self) -> None:
        """Publish load that came already: the twin refuses it, the run goes on."""
        refused = self._refused("twin")
        self.graph.connected("load/blocks")
        for first in (0, 50, 100):
            old = fake_history("", "", 1.0).part(first, first + 40)
            self.graph.out.publish("load/blocks", encode_load(old, first))
        self.graph.until(lambda: self._refused("twin") >= refused + 3, "refusals of late load")
        self._passes(1.0)
        self._alive("twin", "load", "recorder", "monitor")

    def send_as_stranger(self) -> None:
        """Publish on every topic beside its node: nothing of it is taken, nothing of the run is lost."""
        self.graph.listen(*(entry.name for entry in TOPICS if entry.name != "/diagnostics"))
        self._passes(0.5)
        true = {name: list(messages) for name, messages in self.graph.messages.items()}
        hostile, sent = Hostile(self._number, lambda name: true.get(name, ())), set()
        for number in range(STRAYS):
            entry = TOPICS[number % len(TOPICS)]
            while not self.graph.out.publish(entry.name, cdr := hostile.message(entry)):
                pass  # bytes that the middleware itself refuses
            sent.add(cdr)
            self.graph.drain()
        forget_statuses(self.graph, sent)
        self._passes(0.5)
        self._alive("twin", "load", "recorder", "monitor")
        self.graph.processes.signal("twin", signal.SIGINT)
        self._ends("twin", 0)
        self._ends("recorder", 0)
        run = read_run(self._file)
        self._check(bool((np.diff(run.vibration.sample) == 1).all()), f"{self._file}: gaps")
        self._check(int(run.vibration.sample[0]) == 0, f"{self._file}: begins late")

    def set_clock_of_live_load(self) -> None:
        """Give live load of two clocks and set one of them: stamps follow it and never go back."""
        with LiveTrain(self.graph, shaft_ahead=3.2) as train:
            for step in (0.0, -0.3, 0.4, -0.1, 2.0):
                train.ahead += step
                self._passes(1.0)
                late = train.now - 1e-9 * header_stamp(self.graph.messages["force_waveform"][-1])
                self._check(-0.1 < late < LATEST_S, f"stamps are {late:.3f} s behind their clock")
            told = self.graph.statuses("twin")[-1].message
            self._check("they have two clocks" in told, f"two clocks go unmentioned: {told}")
            self._alive("twin", "recorder", "monitor")
            self.graph.processes.signal("twin", signal.SIGINT)
            self._ends("twin", 0)
        self._ends("recorder", 0)
        run = read_run(self._file)
        self._check(bool((np.diff(run.vibration.sample) == 1).all()), f"{self._file}: gaps")
        self._check(bool((np.diff(run.vibration.time_ns) > 0).all()), f"{self._file}: stamps go back")

    def jump_clocks(self) -> None:
        """Publish a clock that jumps by years: nodes go on, those that follow it too."""
        self.graph.start("other", "beardyn_ros", "monitor", use_sim_time=True, exit_when_done=False)
        self.graph.connected("/clock")
        for stamp in CLOCKS_NS:
            self.graph.out.publish("/clock", encode_clock(stamp))
            self._passes(0.3)
        self._alive("twin", "load", "recorder", "monitor", "other")

    def fill_disk(self) -> None:
        """Fill the disk of a recorder: it ends with a sentence and code 2, the others go on."""
        self.graph.start("full", "beardyn_ros", "recorder", output="/dev/full", replace=True)
        self._ends("full", 2)
        self._check("No space left" in self.graph.processes.log("full"), "the full disk is not named")
        self._alive("twin", "load", "recorder", "monitor")

    def kill_load(self) -> None:
        """Kill the load: the twin stops and says why, recorder and monitor end with the run."""
        self.graph.processes.signal("load", signal.SIGKILL)
        self._ends("twin", 4)
        self._ends("recorder", 0)
        self._ends("monitor", 0)
        run = read_run(self._file)
        self._check(run.complete and bool(run.status) and run.status != "complete", f"status {run.status!r}")

    def kill_twin(self) -> None:
        """Kill the twin: the others end, and the file says so."""
        self.graph.processes.signal("twin", signal.SIGKILL)
        self._ends("recorder", 0)
        self._ends("monitor", 0)
        self._ends("load", 4)
        self._check("vanished" in (read_run(self._file).status or ""), "the file does not say it")


def soak(folder: Path, seconds: float) -> list[str]:
    """Let every fault happen in turn until the time is over, each at least once; return what did not hold."""
    end, trial, rounds = time.monotonic() + seconds, Soak(folder), 0
    while not rounds or time.monotonic() < end:
        for fault in trial.faults():
            begin = time.monotonic()
            if rounds and begin > end:
                break
            trial.run(fault)
            print(f"round {rounds + 1}: {fault.__name__} {time.monotonic() - begin:.1f} s", flush=True)
        rounds += 1
        own = usage(os.getpid())[1]
        print(f"round {rounds}: {len(trial.problems)} problem(s), {own:.0f} MB here", flush=True)
    return trial.problems


def main(words: Sequence[str] | None = None) -> int:
    """Run the soak; gives 1 when something did not hold."""
    parser = argparse.ArgumentParser(prog="python -m evidence.ros.soak", description=__doc__)
    parser.add_argument("--minutes", type=float, default=5.0, help="how long, each fault once at least")
    args = parser.parse_args(words)
    with tempfile.TemporaryDirectory(prefix="soak-") as name:
        problems = soak(Path(name), 60.0 * args.minutes)
    print(f"{len(problems)} of what must hold did not" if problems else "everything held")
    return int(bool(problems))


if __name__ == "__main__":
    sys.exit(main())
