"""The package in a workspace: colcon builds it, also with links to the sources."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
LINKED = ("setup.py", "setup.cfg", "package.xml", "resource", "beardyn_core", "beardyn_ros")


def test_setup_runs_through_a_link_as_colcon_makes_it(tmp_path: Path) -> None:
    """`colcon build --symlink-install` links these into its build folder, and no README.md."""
    for name in LINKED:
        (tmp_path / name).symlink_to(ROOT / name)
    command = [sys.executable, "setup.py", "--name"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split()[-1] == "beardyn"


@pytest.mark.slow
@pytest.mark.skipif(
    importlib.util.find_spec("colcon_core") is None,
    reason="colcon is not installed (pip install colcon-common-extensions)",
)
@pytest.mark.parametrize("how", [[], ["--symlink-install"]], ids=["copied", "linked"])
def test_colcon_builds_the_package_and_its_nodes_start(how: list[str], tmp_path: Path) -> None:
    (tmp_path / "src").mkdir()
    (tmp_path / "src/beardyn").symlink_to(ROOT)
    environment = {**os.environ, "AMENT_PREFIX_PATH": sys.prefix}
    colcon = shutil.which("colcon", path=str(Path(sys.executable).parent)) or "colcon"
    done = subprocess.run(
        [colcon, "build", *how],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    installed = tmp_path / "install/beardyn"
    assert (installed / "share/beardyn/launch").is_dir()
    assert (installed / "share/ament_index/resource_index/packages/beardyn").exists()
    nodes = {path.name for path in (installed / "lib/beardyn").iterdir()}
    assert {"twin", "load", "recorder", "monitor", "follower", "viewer"} <= nodes
