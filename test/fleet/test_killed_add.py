"""``beardyn fleet add`` that is killed: what is committed stays, no process is left, and it goes on."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.fleet.store import open_store
from test.fleet.made_history import write_files

PATIENCE = 240.0


def children(parent: int) -> list[int]:
    """Processes that a process has started, zombies left aside."""
    told = subprocess.run(
        ["ps", "-eo", "pid=,ppid=,stat="], capture_output=True, text=True, check=True
    ).stdout
    rows = [line.split() for line in told.splitlines()]
    return [int(pid) for pid, ppid, state in rows if int(ppid) == parent and not state.startswith("Z")]


def is_there(process: int) -> bool:
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.slow  # processes begin, twice
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc, which Linux has")
def test_a_killed_command_loses_nothing_leaves_no_process_and_goes_on(tmp_path: Path) -> None:
    write_files(tmp_path / "own", 6)
    store = tmp_path / "s.sqlite"
    words = [
        "fleet",
        "add",
        str(tmp_path / "own"),
        "--store",
        str(store),
        "--workers",
        "2",
        "--estimator",
        "none",
    ]
    command = [sys.executable, "-m", "beardyn_core.cli.main", *words]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    until = time.monotonic() + PATIENCE
    count = 0
    while count < 2 and time.monotonic() < until:
        assert process.poll() is None, "it ended before it could be killed"
        time.sleep(0.05)
        try:
            with open_store(store) as opened:
                count = opened.count()
        except InputError:  # not made yet
            continue
    analysing = children(process.pid)
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert count >= 2
    assert analysing
    while any(map(is_there, analysing)) and time.monotonic() < until:
        time.sleep(0.2)
    assert not any(map(is_there, analysing))
    with open_store(store) as opened:
        kept = {each.file for each in opened.recordings()}
    assert count <= len(kept) < 24
    done = subprocess.run(
        command, env=environment, capture_output=True, text=True, timeout=PATIENCE, check=True
    )
    assert f"{24 - len(kept)} recordings added, {len(kept)} were there" in done.stdout
