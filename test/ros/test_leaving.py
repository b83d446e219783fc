"""Nodes that leave stop nobody who stays, and newcomers are found at once."""

from __future__ import annotations

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

from evidence.ros import leaving

PROFILES = sorted(leaving.FASTDDS_LOCAL_PROFILE.parent.glob("fastdds*_profile.xml"))


def test_nodes_that_leave_stop_nobody(capfd: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """By `destroy_node` alone 28 of 60 joins stopped one, as provoked here; so quietly 1 of 220."""
    if not leaving.slow_acknowledgements(tmp_path, 1000):
        pytest.skip("needs a C compiler and the Fast DDS 3.2 of the wheels")
    assert leaving.main(["--joins", "16"]) == 0
    told = re.search(r"(\d+) watcher\(s\) stopped", capfd.readouterr().out)
    assert told
    assert int(told[1]) <= 1


def test_newcomers_are_found_within_half_a_second(capfd: pytest.CaptureFixture[str]) -> None:
    """Also the one in ten whose first announcement is answered before it listens."""
    assert leaving.main(["--joins", "12", "--period", "0.2", "--delay", "0"]) == 0
    told = re.search(r"found after ([\d.]+) s", capfd.readouterr().out)
    assert told
    assert float(told[1]) < 0.5


def test_a_node_that_cannot_leave_ends_with_its_code_nevertheless() -> None:
    """Even where the interpreter is held for good, as rclpy holds it when it destroys."""
    leaves = (
        "import ctypes; from beardyn_ros.runtime import ended_after\n"
        "with ended_after(60.0, 7): pass\n"
        "with ended_after(0.2, 5): ctypes.PyDLL(None).sleep(50)"
    )
    assert subprocess.run([sys.executable, "-c", leaves], check=False, timeout=40.0).returncode == 5


@pytest.mark.parametrize("profile", PROFILES, ids=lambda path: path.stem)
def test_every_profile_announces_within_what_a_newcomer_may_wait(profile: Path) -> None:
    tags = ElementTree.parse(profile).iter()
    seconds, nanoseconds = next(tuple(tag) for tag in tags if tag.tag.endswith("leaseAnnouncement"))
    assert 0.0 < float(seconds.text or 0) + 1e-9 * float(nanoseconds.text or 0) <= 0.2
