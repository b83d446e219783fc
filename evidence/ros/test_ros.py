"""The short parts of the trials of the ROS graph; `make soak` and the commands run all of them."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

if importlib.util.find_spec("rclpy") is None:
    pytest.skip("rclpy is not installed (pip install .[ros])", allow_module_level=True)

from evidence.ros.faults import FAULTS, Fault
from evidence.ros.fuzz import fuzz
from evidence.ros.kills import LARGEST_LOSS_S, killed_recorders
from evidence.ros.review import line_of
from evidence.ros.soak import soak
from test.ros.graph import Graph

pytestmark = [pytest.mark.ros, pytest.mark.slow]


def test_a_killed_recorder_lacks_at_most_a_second_each_time(tmp_path: Path) -> None:
    with Graph(tmp_path) as graph:
        found = list(killed_recorders(graph, tmp_path, 3))
    assert max(each.lost_s for each in found) <= LARGEST_LOSS_S
    assert not any(each.gaps for each in found)


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: f"fault {fault.number}")
def test_a_fault_of_the_review_is_mended(fault: Fault, tmp_path: Path) -> None:
    line = line_of(fault, tmp_path)
    assert line.holds, line.now


def test_five_minutes_of_faults_leave_nothing_that_does_not_hold(tmp_path: Path) -> None:
    assert soak(tmp_path, 300.0) == []


def test_hostile_messages_on_every_topic_end_nothing_and_cost_nothing(tmp_path: Path) -> None:
    assert fuzz(tmp_path, 400, seed=2) == []
