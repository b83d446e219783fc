"""Ten thousand hostile messages beside a run of all nodes: ``python -m evidence.ros.fuzz --messages 10000``.

They go to every topic that any node subscribes to. Nothing may end or be missing in the recording, and every
one that is not of the run is refused and counted.

They come 150 times a second beside a run that plays at half of real time, 850 messages a second. Six nodes
and a listener to every topic fill two cores in real time: receive buffers overflow (`RcvbufErrors` of
``/proc/net/snmp``), and messages are missing without a hostile one too. A text of 5 MB is one in some 400
on a topic of texts: it is refused by its length, and what it costs is the middleware's.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from beardyn_core.record.reading import read_run
from beardyn_core.record.reporting import report
from beardyn_core.record.topics import TOPICS, topic
from beardyn_ros.message_guard import ANYBODY
from evidence.ros.hostile import Hostile
from test.ros.graph import Graph

NODES = ("twin", "load", "recorder", "monitor", "follower", "viewer")
RATE = 150.0  # messages a second
SPEED_FACTOR = 0.5  # of the run
BEGIN_S, END_S = 6.0, 6.0  # of the run before and after them; the follower wants stretches of 1.5 s
ENDING_S = 300.0  # a busy machine is behind
BLOCKS_PER_S, BLOCK_SAMPLES = 50, 512
FREE = (  # without a publisher
    *(*ANYBODY, "load/wrench", "load/shaft", "temperature", "follower/residual", "vibration_samples"),
)


def fuzz(folder: Path, messages: int, seed: int, nodes: Sequence[str] = NODES) -> list[str]:
    """Publish hostile messages beside a run; return what did not hold."""
    sent: Counter[str] = Counter()
    path = folder / "run.mcap"
    duration = float(round(BEGIN_S + SPEED_FACTOR * messages / RATE + END_S))
    with Graph(folder) as graph:
        _start(graph, path, nodes)
        names = [entry.name for entry in TOPICS]
        received = [name for name in names if name != "/diagnostics"]
        graph.listen(*received)
        graph.out.publisher("load/consumed")  # the load listens to it, once it is there
        graph.connected(*[name for name in names if name != "load/consumed"])
        graph.fake_load(duration=duration)
        graph.until_state("running")
        _passes(graph, BEGIN_S)
        true = {name: list(graph.messages[name]) for name in names}
        own: set[bytes] = set()
        hostile = Hostile(seed, lambda name: true[name])
        begin = time.monotonic()
        for number in range(messages):
            entry = TOPICS[number % len(TOPICS)]
            while not graph.out.publish(entry.name, cdr := hostile.message(entry)):
                pass  # bytes that the middleware itself refuses
            sent[entry.name] += 1
            own.add(cdr)
            due = begin + number / RATE
            graph.until(lambda due=due: time.monotonic() >= due, "the next message")  # type: ignore[misc]
        graph.until(lambda: time.monotonic() > begin + messages / RATE + 1.0, "what is under way")
        problems = []
        forget_statuses(graph, own)
        if float(graph.statuses("twin")[-1].value("simulated_time")) > duration - 0.5:
            problems.append("the run was over before the last message")
        for part in nodes:
            graph.until(
                lambda part=part: graph.processes.exit_code(part) is not None,  # type: ignore[misc]
                f"the end of {part}",
                timeout=ENDING_S,
                check_processes=False,
            )
            code = graph.exit_code(part)
            if code:
                problems.append(f"{part} ended with {code}")
            if "Traceback" in graph.processes.log(part):
                problems.append(f"{part}: a traceback")
        while graph.drain():
            pass  # the last words wait in the queues of this process
        forget_statuses(graph, own)
        problems += _refusals(graph, sent, nodes)
    return problems + _recording(path, duration)


def _start(graph: Graph, path: Path, nodes: Sequence[str]) -> None:
    graph.fake_twin(speed_factor=SPEED_FACTOR)
    graph.node_process("recorder", output=str(path))
    if "monitor" in nodes:
        graph.node_process("monitor")
    if "follower" in nodes:
        graph.node_process("follower")
    if "viewer" in nodes:
        drawn = str(path.with_name("live.rrd"))
        graph.node_process("viewer", target="file", output=drawn, exit_when_done=True)
    for part in set(nodes) & {"recorder", "monitor", "follower"}:
        graph.until(
            lambda part=part: any(s.value("connected") == "true" for s in graph.statuses(part)),  # type: ignore[misc]
            f"the connection of the {part}",
        )
    if "viewer" in nodes:
        graph.until(lambda: graph.statuses("viewer"), "the viewer")


def forget_statuses(graph: Graph, own: set[bytes]) -> None:
    """Forget the hostile diagnostics, which the listener has received too."""
    kept = graph.messages["/diagnostics"]  # the subscription appends to this list
    kept[:] = [each for each in kept if each not in own]


def _passes(graph: Graph, seconds: float) -> None:
    graph.until(
        lambda: float(graph.statuses("twin")[-1].value("simulated_time")) >= seconds, f"{seconds:g} s"
    )


def _refusals(graph: Graph, sent: Counter[str], nodes: Sequence[str]) -> list[str]:
    """Compare what was sent to a followed topic with what the recorder has refused of it."""
    problems = []
    last = graph.statuses("recorder")[-1]
    for name, count in sent.items():
        refused = int(last.value(f"refused: {name}") or 0)
        fewest = 1 if topic(name).depth == 1 else count  # such a topic keeps its latest message only
        if name not in FREE and not fewest <= refused <= count:
            problems.append(f"the recorder refused {refused} of {count} on {name}")
    for part in nodes:
        refused = max((int(s.value("refused_messages") or 0) for s in graph.statuses(part)), default=0)
        print(f"{part}: {refused} refused", flush=True)
        if not refused:
            problems.append(f"{part} has refused nothing")
    return problems


def _recording(path: Path, duration: float) -> list[str]:
    problems = []
    files = sorted(each.name for each in path.parent.glob("*.mcap"))
    if files != [path.name]:
        problems.append(f"recordings: {files}")
    found, run = report(path), read_run(path)
    blocks = round(duration * BLOCKS_PER_S)
    if found.missing_messages != ():
        problems.append(f"missing: {found.missing_messages}")
    for name, samples in (("vibration", run.vibration), ("force_waveform", run.force_waveform)):
        if not np.array_equal(samples.sample, np.arange(blocks * BLOCK_SAMPLES)):
            problems.append(f"{name}: {len(samples)} samples, {blocks * BLOCK_SAMPLES} are right")
    for name, signal in (("force", run.force), ("shaft", run.shaft), ("imu", run.specific_force)):
        if len(signal) != blocks * 8 or (np.diff(signal.time_ns) != 2_500_000).any():
            problems.append(f"{name}: {len(signal)} samples, {blocks * 8} are right")
    if run.status != "complete":
        problems.append(f"status {run.status}")
    print(f"{path.name}: {blocks} blocks, {found.topics and sum(t.count for t in found.topics)} messages")
    return problems


def main(words: Sequence[str] | None = None) -> int:
    """Run the battery; gives 1 when something did not hold."""
    parser = argparse.ArgumentParser(prog="python -m evidence.ros.fuzz", description=__doc__)
    parser.add_argument("--messages", type=int, default=10_000, help="how many; default 10000")
    parser.add_argument("--seed", type=int, default=1, help="of their content; default 1")
    args = parser.parse_args(words)
    with tempfile.TemporaryDirectory(prefix="fuzz-") as name:
        problems = fuzz(Path(name), args.messages, args.seed)
    for problem in problems:
        print(f"DOES NOT HOLD: {problem}")
    print(f"{args.messages} messages: {'everything held' if not problems else f'{len(problems)} problems'}")
    return int(bool(problems))


if __name__ == "__main__":
    sys.exit(main())
