"""Sweeps on a cluster that is started as docs/sweep.md says: real processes, killed and added in mid-run."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import beardyn_core as bd
from beardyn_core.config import read_sweep
from beardyn_core.experiments import Cluster, Engine, EngineError, Tls
from beardyn_core.population.folder import done_rows
from beardyn_core.population.sweep_scenes import scenes_of
from beardyn_core.population.sweeping import conduct
from test.experiments.work import squared
from test.population.sweeps import tiny

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "sweep.md"
LONGEST_S = 240.0
pytestmark = pytest.mark.slow


class Machines:
    """A scheduler and workers on this machine, by the commands of the page."""

    def __init__(self, folder: Path, scheme: str = "tcp") -> None:
        self._folder, self._scheme = folder, scheme
        self.processes: list[subprocess.Popen[bytes]] = []
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        text = PAGE.read_text(encoding="utf-8")
        every = re.findall(r"^dask .*$", text, re.MULTILINE)
        commands = [line for line in every if ("tls" in line) is (scheme == "tls")]
        self.certificates = re.findall(r"^openssl .*$", text, re.MULTILINE)
        self._commands = {words.split()[1]: words.partition("#")[0].split() for words in commands}

    def start(self, kind: str, **options: str) -> subprocess.Popen[bytes]:
        """Start ``dask scheduler`` or ``dask worker`` as the page does, at a port of this test."""
        words = [word.replace("8786", str(self.port)) for word in self._commands[kind]]
        for name, value in options.items():
            words[words.index(f"--{name}") + 1] = value
        if kind == "scheduler":
            words += ["--dashboard-address", ":0"]
        environment = {**os.environ, "PYTHONPATH": str(ROOT)}
        log = (self._folder / f"{kind}{len(self.processes)}.log").open("wb")
        command = [sys.executable, "-m", "dask", *words[1:]]
        process = subprocess.Popen(
            command, cwd=self._folder, env=environment, stdout=log, stderr=log, start_new_session=True
        )
        self.processes.append(process)
        return process

    def kill(self, process: subprocess.Popen[bytes]) -> None:
        """Kill a process and all it has started, at once."""
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            return
        process.wait()

    @property
    def address(self) -> str:
        return f"{self._scheme}://127.0.0.1:{self.port}"

    def certify(self, folder: Path) -> Tls:
        """Make certificates in a folder by the commands of the page."""
        folder.mkdir(exist_ok=True)
        for line in self.certificates:
            subprocess.run(shlex.split(line), cwd=folder, check=True, capture_output=True)
        return Tls(folder / "ca.pem", folder / "me.pem", folder / "me.key")


@pytest.fixture
def machines(tmp_path: Path) -> Iterator[Machines]:
    started = Machines(tmp_path)
    yield started
    for process in started.processes:
        started.kill(process)


def until(is_so: Callable[[], bool]) -> None:
    end = time.monotonic() + LONGEST_S
    while not is_so():
        assert time.monotonic() < end
        time.sleep(0.2)


def longer(tmp_path: Path) -> Path:
    """A sweep of 24 runs in a file."""
    (tmp_path / "longer.yaml").write_text(json.dumps(tiny(runs=24)))
    return tmp_path / "longer.yaml"


def bits(folder: Path) -> dict[str, bytes]:
    files = [path for path in (folder / "signals.zarr").rglob("*") if path.is_file()]
    files += [folder / "runs.parquet", folder / "features.parquet"]
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The set as this machine's own processes make it."""
    folder = tmp_path_factory.mktemp("whole")
    conduct(scenes_of(*read_sweep(tiny(runs=24))), folder / "set", Cluster(workers=2))
    return bits(folder / "set")


def test_two_workers_of_a_scheduler_make_the_same_set(
    machines: Machines, tmp_path: Path, whole: dict[str, bytes]
) -> None:
    machines.start("scheduler")
    for _ in range(2):
        machines.start("worker", nworkers="1")
    runs = bd.sweep(longer(tmp_path), tmp_path / "set", scheduler=machines.address)
    assert len(runs) == 24
    assert runs.about["processes"] == 2
    assert bits(tmp_path / "set") == whole


@pytest.mark.skipif(shutil.which("openssl") is None, reason="openssl, which makes certificates, is missing")
def test_a_cluster_with_tls_works_for_those_with_its_certificates_alone(tmp_path: Path) -> None:
    machines = Machines(tmp_path, "tls")
    try:
        mine = machines.certify(tmp_path)
        machines.start("scheduler")
        machines.start("worker", nworkers="1")
        runs = bd.sweep(tiny(runs=2), tmp_path / "set", scheduler=machines.address, tls=mine.given)
        assert len(runs) == 2
        with Engine(Cluster(scheduler=machines.address, tls=mine)) as engine:
            assert [each.value[0] for each in engine.run(squared, [3])] == [9]
            (info,) = engine._client.scheduler_info()["workers"].values()
            assert info["nanny"].startswith("tls://")
        strange = Machines(tmp_path, "tls").certify(tmp_path / "strange")
        for cluster in (
            Cluster(scheduler=machines.address, tls=strange, patience=1.0),
            Cluster(scheduler=machines.address.replace("tls", "tcp"), patience=1.0),
        ):
            with pytest.raises(EngineError, match="cannot be reached"), Engine(cluster):
                pass
    finally:
        for process in machines.processes:
            machines.kill(process)


def test_a_worker_that_comes_later_takes_its_share(
    machines: Machines, tmp_path: Path, whole: dict[str, bytes]
) -> None:
    machines.start("scheduler")
    machines.start("worker", nworkers="1")
    seen: list[int] = []

    def add(now: object) -> None:
        seen.append(now.workers)  # type: ignore[attr-defined]
        if now.done == 2:  # type: ignore[attr-defined]
            machines.start("worker", nworkers="1")
            time.sleep(15.0)  # it takes so long to begin

    plan = scenes_of(*read_sweep(tiny(runs=24)))
    conduct(plan, tmp_path / "set", Cluster(scheduler=machines.address), report=add)
    assert seen[0] == 1
    assert seen[-1] == 2
    assert bd.open_set(tmp_path / "set").about["processes"] == 2
    assert bits(tmp_path / "set") == whole


def test_a_scheduler_that_is_killed_and_comes_back_loses_nothing_that_was_finished(
    machines: Machines, tmp_path: Path, whole: dict[str, bytes]
) -> None:
    """Its workers go with it, so they are started again too; the sweep waits and goes on by itself."""
    scheduler = machines.start("scheduler")
    machines.start("worker", nworkers="1")
    said: list[str] = []
    plan = scenes_of(*read_sweep(tiny(runs=24)))
    cluster = Cluster(scheduler=machines.address, patience=LONGEST_S)
    sweep = threading.Thread(
        target=conduct, args=(plan, tmp_path / "set", cluster), kwargs={"say": said.append}, daemon=True
    )
    sweep.start()
    until(lambda: len(done_rows(tmp_path / "set")) >= 4)
    machines.kill(scheduler)
    kept = done_rows(tmp_path / "set")
    until(lambda: any("waiting for it to come back" in each for each in said))
    machines.start("scheduler")
    machines.start("worker", nworkers="1")
    sweep.join(LONGEST_S)
    assert not sweep.is_alive()
    after = done_rows(tmp_path / "set")
    assert all(after[run] == made for run, made in kept.items())
    assert len((tmp_path / "set" / "journal.jsonl").read_text().splitlines()) == 12
    assert bits(tmp_path / "set") == whole


def test_killing_the_command_itself_loses_nothing_that_was_finished(
    tmp_path: Path, whole: dict[str, bytes]
) -> None:
    command = [sys.executable, "-m", "beardyn_core.cli.main", "sweep", str(longer(tmp_path)), "-o", "set"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    first = subprocess.Popen(command, cwd=tmp_path, env=environment, stderr=subprocess.DEVNULL)
    until(lambda: len(done_rows(tmp_path / "set")) >= 4)
    first.kill()
    first.wait()
    kept = done_rows(tmp_path / "set")
    again = subprocess.run(
        [*command, "--json"], cwd=tmp_path, env=environment, capture_output=True, check=True
    )
    told = json.loads(again.stdout)
    assert told["complete"]
    assert told["here"] == 24 - len(kept)
    assert bits(tmp_path / "set") == whole
    verified = subprocess.run(
        [*command[:4], "-o", "set", "--verify"],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        check=True,
    )
    assert b"every file is what it was" in verified.stdout
