"""The package in a workspace: colcon builds it in each of its ways, and `colcon test` runs tests of it."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

ROOT = Path(__file__).resolve().parents[2]
LINKED = ("setup.py", "setup.cfg", "package.xml", "resource", "beardyn_core", "beardyn_ros")
LEFT_OUT = (
    ".git",
    ".venv",
    ".*_cache",
    "build",
    "install",
    "log",
    "site",
    "__pycache__",
    "*.egg-info",
    "*.mcap",
)
NODES = {"twin", "load", "recorder", "monitor", "follower", "viewer"}
COLCON = "import sys; from colcon_core.command import main; sys.exit(main())"
needs_colcon = pytest.mark.skipif(
    any(importlib.util.find_spec(f"colcon_{part}") is None for part in ("core", "ros", "test_result")),
    reason="colcon is not installed (pip install colcon-ros colcon-test-result)",
)


def colcon(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run colcon in a workspace, with ROS 2 of the wheels as the sourced one."""
    environment = {**os.environ, "AMENT_PREFIX_PATH": sys.prefix}
    for name in ("PYTEST_ADDOPTS", "PYTEST_CURRENT_TEST", "PYTEST_XDIST_WORKER"):
        environment.pop(name, None)  # of the tests that this one is among
    return subprocess.run(
        [sys.executable, "-c", COLCON, *words],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=550,
        check=False,
    )


def test_setup_runs_through_a_link_as_colcon_makes_it(tmp_path: Path) -> None:
    """`colcon build --symlink-install` links these into its build folder, and no README.md."""
    for name in LINKED:
        (tmp_path / name).symlink_to(ROOT / name)
    command = [sys.executable, "setup.py", "--name"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split()[-1] == "beardyn"


@needs_colcon
@pytest.mark.parametrize(
    ("how", "prefix"),
    [([], "install/beardyn"), (["--symlink-install"], "install/beardyn"), (["--merge-install"], "install")],
    ids=["copied", "linked", "merged"],
)
def test_colcon_builds_the_package_and_a_node_of_it_starts(
    how: list[str], prefix: str, tmp_path: Path
) -> None:
    (tmp_path / "src").mkdir()
    (tmp_path / "src/beardyn").symlink_to(ROOT)
    done = colcon(tmp_path, "build", *how)
    assert done.returncode == 0, done.stdout + done.stderr
    installed = tmp_path / prefix
    assert (installed / "share/beardyn/launch").is_dir()
    assert (installed / "share/ament_index/resource_index/packages/beardyn").exists()
    assert {path.name for path in (installed / "lib/beardyn").iterdir()} >= NODES
    sourced = f". {tmp_path}/install/setup.sh && exec {installed}/lib/beardyn/twin --help"
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    environment["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{environment['PATH']}"
    helped = subprocess.run(
        ["sh", "-c", sourced], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert helped.returncode == 0, helped.stdout + helped.stderr
    assert "speed_factor" in helped.stdout


def outcomes_of(results: Path) -> dict[str, str]:
    """Outcome of every test in a result file of pytest."""
    kinds = {"failure": "failed", "error": "failed", "skipped": "skipped"}
    return {
        f"{case.get('classname')}::{case.get('name')}": next(
            (kinds[child.tag] for child in case if child.tag in kinds), "passed"
        )
        for case in ElementTree.parse(results).iter("testcase")
    }


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A workspace with a copy of the package, built."""
    ignored = shutil.ignore_patterns(*LEFT_OUT)
    shutil.copytree(ROOT, tmp_path / "src/beardyn", symlinks=True, ignore=ignored)
    built = colcon(tmp_path, "build")
    assert built.returncode == 0, built.stdout + built.stderr
    return tmp_path


def colcon_test(folder: Path, *words: str) -> tuple[int, dict[str, str]]:
    """Exit code of `colcon test`, and what became of each test."""
    done = colcon(folder, "test", "--return-code-on-test-failure", *words)
    return done.returncode, outcomes_of(folder / "build/beardyn/pytest.xml")


@needs_colcon
def test_colcon_test_fails_when_a_test_fails(workspace: Path) -> None:
    file = "test/ros/test_requirements.py"
    code, outcomes = colcon_test(workspace, "--pytest-args", file)
    assert code == 0
    assert "passed" in outcomes.values()
    assert colcon(workspace, "test-result").returncode == 0
    with (workspace / "src/beardyn" / file).open("a", encoding="utf-8") as end:
        end.write("\n\ndef test_that_fails() -> None:\n    raise AssertionError\n")
    code, outcomes = colcon_test(workspace, "--pytest-args", file)
    assert code != 0
    failed = [name for name, outcome in outcomes.items() if outcome == "failed"]
    assert failed == ["beardyn.test.ros.test_requirements::test_that_fails"]
    assert colcon(workspace, "test-result").returncode != 0


@pytest.mark.slow
@needs_colcon
def test_colcon_test_without_words_runs_a_selection_with_real_nodes(workspace: Path) -> None:
    """The selection is `IN_A_WORKSPACE` of conftest.py."""
    code, outcomes = colcon_test(workspace)
    assert code == 0, outcomes
    assert 20 < len(outcomes) < 500
    nodes = [outcome for name, outcome in outcomes.items() if "test_malformed" in name]
    assert nodes
    assert set(nodes) <= {"passed", "skipped"}
    assert list(outcomes.values()).count("passed") > 20
