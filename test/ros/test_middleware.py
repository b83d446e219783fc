"""Nodes take the middleware that `RMW_IMPLEMENTATION` names, and set nothing for another one."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

from beardyn_ros.environment import FASTDDS_PROFILE, PROFILE_VARIABLES, prepare_environment
from beardyn_ros.processes import local_environment

ROOT = Path(__file__).resolve().parents[2]
CHOICE = "RMW_IMPLEMENTATION"


def test_nothing_chooses_a_middleware() -> None:
    """The name is read where a profile is chosen, and written nowhere."""
    found = []
    for folder in ("beardyn_ros", "launch", "scripts"):
        for path in (ROOT / folder).rglob("*"):
            if not path.is_file() or "__pycache__" in path.parts:
                continue
            text = path.read_text(encoding="utf-8", errors="replace")
            if path.suffix != ".py":
                assert CHOICE not in text, path
                continue
            for node in ast.walk(ast.parse(text)):
                if isinstance(node, ast.Call) and any(
                    isinstance(word, ast.Constant) and word.value == CHOICE for word in node.args
                ):
                    found.append(ast.unparse(node.func))
                elif isinstance(node, (ast.Dict, ast.Subscript)):
                    assert f"'{CHOICE}'" not in ast.unparse(node), f"{path} writes {CHOICE}"
    assert set(found) == {"os.environ.get"}


@pytest.mark.parametrize("middleware", ["", "rmw_fastrtps_cpp", "rmw_fastrtps_dynamic_cpp"])
def test_fast_dds_has_its_profile(middleware: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("ROS_DISTRO", *PROFILE_VARIABLES):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv(CHOICE, middleware)
    prepare_environment()
    assert os.environ[PROFILE_VARIABLES[0]] == str(FASTDDS_PROFILE)
    assert os.environ[CHOICE] == middleware


@pytest.mark.parametrize("middleware", ["rmw_zenoh_cpp", "rmw_cyclonedds_cpp"])
def test_another_middleware_has_nothing_of_fast_dds(middleware: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in PROFILE_VARIABLES:
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv(CHOICE, middleware)
    prepare_environment()
    assert not set(PROFILE_VARIABLES) & set(os.environ)
    child = local_environment(7)
    assert child[CHOICE] == middleware
    assert not set(PROFILE_VARIABLES) & set(child)


def test_a_node_does_not_fall_back_to_fast_dds() -> None:
    """Where the named middleware is missing ROS says so, and the node does not start."""
    pytest.importorskip("rclpy", reason="rclpy is not installed (pip install .[ros])")
    environment = {**os.environ, CHOICE: "rmw_of_nobody_cpp"}
    command = [sys.executable, "-m", "beardyn_ros", "recorder", "--ros-args", "-p", "start_timeout:=1.0"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode != 0
    assert "rmw_of_nobody_cpp" in done.stdout + done.stderr
