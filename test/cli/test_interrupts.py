"""Ctrl-C: every command stops within two seconds, keeps what is done and says so.

Real processes in a group of their own, the signal sent to the whole group as a terminal does.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import psutil
import pytest

from beardyn_core.base.interrupts import GRACE_S
from beardyn_core.cli import main as command
from beardyn_core.config import config_folder
from beardyn_core.record.reading import read_run
from test.finite_elements import need_finite_elements
from test.population.sweeps import tiny

ROOT = Path(__file__).resolve().parents[2]
# What is promised is 2 s. Noise may double it, and a machine with more to do than it has cores is slower
# by as much.
STOPPED_S = 4.0


def longest() -> float:
    """Time in which a command must have stopped on this machine now, [s]."""
    return STOPPED_S * max(1.0, os.getloadavg()[0] / len(os.sched_getaffinity(0)))


BEGUN = ("compiling the", "once all kernels are compiled")  # what the commands say before they compile


COMMAND_LINE = ("-m", "beardyn_core.cli.main")


class Command:
    """A command or script in a process group of its own, and what it says while it runs."""

    def __init__(
        self, words: list[str], cwd: Path, cache: Path | None, program: tuple[str, ...] = COMMAND_LINE
    ) -> None:
        environment = {**os.environ, "PYTHONPATH": str(ROOT)}
        if cache is not None:
            environment["BEARDYN_CACHE_DIR"] = str(cache)
        self.process = subprocess.Popen(
            [sys.executable, *program, *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            cwd=cwd,
            env=environment,
            start_new_session=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        )
        self._said = bytearray()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        while part := os.read(self.process.stdout.fileno(), 4096):
            self._said += part

    @property
    def said(self) -> str:
        """Everything on both streams so far."""
        return self._said.decode(errors="replace")

    def wait_for(self, condition: Callable[[], bool], timeout: float = 300.0) -> None:
        """Wait for something that the command says or does; compiling comes before it, beside other tests."""
        deadline = time.monotonic() + timeout
        while not condition():
            assert self.process.poll() is None, self.said
            assert time.monotonic() < deadline, self.said
            time.sleep(0.02)

    def interrupt(self) -> float:
        """Send Ctrl-C to the whole group; the time until all of it has ended, [s]."""
        began = time.monotonic()
        os.killpg(self.process.pid, signal.SIGINT)
        self.process.wait(timeout=120.0)
        self._reader.join(timeout=120.0)  # ends when the last process of the group has closed the stream
        assert not self._reader.is_alive()
        return time.monotonic() - began


@contextmanager
def running(
    words: list[str], cwd: Path, cache: Path | None = None, program: tuple[str, ...] = COMMAND_LINE
) -> Iterator[Command]:
    started = Command(words, cwd, cache, program)
    try:
        yield started
    finally:
        _kill_group(started.process.pid)
        started.process.wait()


def _kill_group(pid: int) -> None:
    """Kill what is left of a process group that this test began."""
    try:
        os.killpg(pid, signal.SIGKILL)
    except ProcessLookupError:
        return


def check(stopped: Command, took: float, *words: str) -> None:
    assert stopped.process.returncode == command.INTERRUPTED, stopped.said
    assert "Traceback" not in stopped.said, stopped.said
    last = next(line for line in stopped.said.splitlines() if "interrupted" in line)
    for word in words:
        assert word in last, stopped.said
    assert took < longest(), stopped.said


COMMANDS = [
    (["warmup", "static_5kN", "static_80kN"], "0 of 2 are ready, and kept"),
    (["simulate", "static_5kN", "-o", "run.mcap"], "nothing has been written"),
    (["trial", "quick", "-o", "out"], "0 of 51 runs are done; the same command goes on"),
    (["ladder", "static_5kN", "--quick", "-o", "out"], "no level has been run"),
    (["demo", "--output", "out"], "nothing has been written"),
    (["contacts", "--quick", "-o", "out"], "nothing has been written"),
]
# one command at once, one later in its own process and one with others; the rest stop in the same place
# of the compiler
FAST = {("warmup", 0.0), ("simulate", 4.0)}


@pytest.mark.parametrize(
    ("words", "kept", "later"),
    [
        pytest.param(
            words,
            kept,
            later,
            id=f"{words[0]} {later:g} s later",
            marks=[] if (words[0], later) in FAST else [pytest.mark.slow],
        )
        for words, kept in COMMANDS
        for later in (0.0, 4.0)
    ],
)
def test_a_command_stops_while_it_compiles(words: list[str], kept: str, later: float, tmp_path: Path) -> None:
    """At once and some seconds later, when the time is spent in one call of the compiler."""
    with running(words, tmp_path, tmp_path / "cache") as started:
        started.wait_for(lambda: any(words in started.said for words in BEGUN))
        time.sleep(later)
        took = started.interrupt()
        check(started, took, kept)
    assert not list(tmp_path.rglob("run.mcap"))


@pytest.mark.slow
def test_an_interrupted_compilation_leaves_a_cache_that_works(tmp_path: Path) -> None:
    words = ["contacts", "--quick"]
    for later in (1.5, 5.0):
        with running(words, tmp_path, tmp_path / "cache") as started:
            started.wait_for(lambda: any(words in started.said for words in BEGUN))
            time.sleep(later)
            took = started.interrupt()
            check(started, took)
    done = subprocess.run(
        [sys.executable, "-m", "beardyn_core.cli.main", *words, "--json"],
        env={**os.environ, "PYTHONPATH": str(ROOT), "BEARDYN_CACHE_DIR": str(tmp_path / "cache")},
        capture_output=True,
        text=True,
        timeout=240,
        check=False,
    )
    assert done.returncode == command.DONE, done.stderr
    json.loads(done.stdout)


def test_an_interrupted_simulation_says_what_its_recording_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["simulate", "static_5kN", "--duration", "600", "-o", "run.mcap", "--json"]
    recording = tmp_path / "run.mcap"
    with running(words, tmp_path) as started:
        started.wait_for(lambda: recording.exists() and recording.stat().st_size > 200_000)
        took = started.interrupt()
        check(started, took, "run.mcap holds the run until ", " s, and is closed and readable")
        assert "{" not in started.said  # no result
    assert command.main(["report", str(recording)]) == command.DONE
    assert "interrupted" in capsys.readouterr().out
    run = read_run(recording)
    assert run.complete
    said = float(started.said.partition("until ")[2].partition(" s,")[0])
    assert run.vibration.time[-1] == pytest.approx(said, abs=0.021)


@pytest.mark.slow
def test_modes_that_are_being_solved_are_left_at_once(tmp_path: Path) -> None:
    """In one call of the solver, which takes most of a minute."""
    need_finite_elements()
    with running(["structure", "high_speed", "--mesh", "18"], tmp_path) as started:
        started.wait_for(lambda: "solving" in started.said)
        time.sleep(1.0)
        took = started.interrupt()
        check(started, took, "nothing has been written")


@pytest.fixture
def small_trial(tmp_path: Path) -> list[str]:
    """A trial of one set of effects in the cheapest tier, so that little is compiled."""
    text = (config_folder() / "trials" / "quick.yaml").read_text(encoding="utf-8")
    text = text.replace("tier: quasistatic", "tier: lumped").replace("check: {tier: full, every: 5}", "")
    (tmp_path / "small.yaml").write_text(text.replace("faults: [cup, cone, roller]", "faults: [cup]"))
    return ["trial", "small.yaml", "-o", "out"]


# after the first run, and as soon as the processes begin: that a trial stops then too, `trial 4 s later` says
@pytest.mark.slow
@pytest.mark.parametrize(
    ("jobs", "moments"),
    [
        pytest.param("1", (1,), marks=pytest.mark.slow),
        ("2", (1,)),
        pytest.param("2", (0, 1), marks=pytest.mark.slow),
    ],
    ids=["1", "2", "2, twice"],
)
def test_an_interrupted_trial_keeps_every_run_that_was_done(
    jobs: str, moments: tuple[int, ...], small_trial: list[str], tmp_path: Path
) -> None:
    """Its processes end with it, without tracebacks, also while they begin."""
    words = [*small_trial, "--jobs", jobs]
    runs = tmp_path / "out" / "runs.jsonl"

    def count() -> int:
        return len(runs.read_text().splitlines()) - 1 if runs.exists() else -1

    for least in moments:
        before = max(count(), 0)
        with running(words, tmp_path) as started:
            started.wait_for(lambda wanted=before + least: count() >= wanted)  # type: ignore[misc]
            time.sleep(0.3)
            took = started.interrupt()
            check(started, took, f"interrupted; {count()} of 24 runs are done; the same command goes on")
        summary = tmp_path / "out" / "trial.json"
        # a process that does not answer in time, for it compiles or the machine is slow, is ended without it
        if (least and took < GRACE_S) or summary.exists():
            assert json.loads(summary.read_text())["complete"] is False
        assert count() >= before + least


def test_an_interrupted_sweep_keeps_every_run_that_was_done(tmp_path: Path) -> None:
    (tmp_path / "tiny.yaml").write_text(json.dumps(tiny(runs=200)))
    journal = tmp_path / "out" / "journal.jsonl"

    def count() -> int:
        return 2 * len(journal.read_text().splitlines()) if journal.exists() else 0

    with running(["sweep", "tiny.yaml", "-o", "out", "--workers", "2"], tmp_path) as started:
        started.wait_for(lambda: count() >= 2)
        took = started.interrupt()
        check(started, took, f"interrupted; {count()} of 200 runs are done; the same command goes on")


@pytest.mark.slow
def test_a_killed_trial_leaves_no_process_behind(small_trial: list[str], tmp_path: Path) -> None:
    words = [*small_trial, "--jobs", "2"]
    runs = tmp_path / "out" / "runs.jsonl"
    with running(words, tmp_path) as started:
        started.wait_for(lambda: runs.exists() and len(runs.read_text().splitlines()) > 1)
        children = psutil.Process(started.process.pid).children(recursive=True)
        assert len(children) >= 3  # the scheduler and two workers
        started.process.kill()
        started.process.wait()
        _, alive = psutil.wait_procs(children, timeout=20.0)
        assert not alive


# on a slow machine the later ones are what the earlier ones are on a fast one
@pytest.mark.parametrize("moment", [0.5, 1.5, *(pytest.param(m, marks=pytest.mark.slow) for m in (2.5, 3.5))])
def test_ctrl_c_at_any_moment_of_a_start_is_clean(moment: float, tmp_path: Path) -> None:
    """While modules are imported, files are read and kernels are loaded from the cache."""
    with running(["simulate", "static_5kN", "--duration", "600"], tmp_path) as started:
        time.sleep(moment)
        took = started.interrupt()
        check(started, took)


SIMULATES = """
import beardyn_core as bd

bd.simulate("static_5kN", tier="lumped", duration=0.1)  # compiled extensions do not load through a Ctrl-C
print("begun", flush=True)
bd.simulate("static_5kN", tier="lumped", duration=6000.0)
"""
TRIES = """
from beardyn_core.choice import load_trial
from beardyn_core.study.trial import conduct, plan_of

if __name__ == "__main__":
    conduct(plan_of(load_trial("small.yaml"), "", None), None, 2, lambda run: print("begun", flush=True))
"""
CLIMBS = """
from dataclasses import replace
from beardyn_core.choice import load_scene
from beardyn_core.study.ladder import climb, comparison_of
from beardyn_core.study.ladder_levels import levels_of

scene = load_scene("static_5kN", tier="lumped")
levels = levels_of(scene, quick=True)
lumped = next(level for level in levels.levels if level.tier == "lumped")
comparison = comparison_of(scene, 600.0, 1.0)
levels = replace(levels, reference=lumped)
climb(comparison, levels, 0.05, progress=lambda name, wall: print("begun", flush=True))
"""


@pytest.mark.parametrize(
    "script",
    [
        pytest.param(SIMULATES, id="simulate"),
        pytest.param(TRIES, id="trial", marks=pytest.mark.slow),
        pytest.param(CLIMBS, id="ladder", marks=pytest.mark.slow),
    ],
)
def test_a_script_gets_a_keyboard_interrupt_and_leaves_no_process_behind(
    script: str, small_trial: list[str], tmp_path: Path
) -> None:
    """Its own Ctrl-C, unlike the command's: the process belongs to the user, who may catch it."""
    (tmp_path / "script.py").write_text(script)
    with running([], tmp_path, program=("script.py",)) as started:
        started.wait_for(lambda: "begun" in started.said)
        time.sleep(1.0)
        took = started.interrupt()  # returns when every process of the group has closed its output
        assert started.process.returncode == -signal.SIGINT, started.said
        assert started.said.rstrip().endswith("KeyboardInterrupt"), started.said
        assert started.said.count("Traceback") == 1, started.said
        assert took < longest(), started.said
