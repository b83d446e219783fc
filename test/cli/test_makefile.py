"""`make` says in a sentence what is missing before it sets anything up."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest


def make(
    repository: Path, tmp_path: Path, *words: str, **environment: str
) -> subprocess.CompletedProcess[str]:
    kept = {name: value for name, value in os.environ.items() if name != "ROS_DISTRO"}
    return subprocess.run(
        ["make", "-C", str(repository), "--no-print-directory", f"VENV={tmp_path / 'venv'}", *words],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
        env={**kept, **environment},
    )


def interpreter(folder: Path, script: str) -> Path:
    """Stand-in for a Python that lacks something."""
    path = folder / "python-stand-in"
    path.write_text(f"#!/bin/sh\n{script}\n")
    path.chmod(0o755)
    return path


def test_help_names_every_target(repository: Path, tmp_path: Path) -> None:
    shown = make(repository, tmp_path, "help").stdout
    for target in ("demo", "test", "slow", "lint", "clean"):
        assert f"make {target} " in shown


@pytest.mark.parametrize(
    ("script", "sentence"),
    [
        ('case "$*" in *version_info*) exit 1;; -V) echo "Python 3.8.1";; esac', "Python 3.8.1, too old"),
        ('case "$*" in *ensurepip*) exit 1;; esac', "sudo apt-get install python3-venv"),
    ],
)
def test_an_unfit_interpreter_is_named(repository: Path, tmp_path: Path, script: str, sentence: str) -> None:
    done = make(repository, tmp_path, "test", f"PYTHON={interpreter(tmp_path, script)}")
    assert done.returncode != 0
    assert sentence in done.stdout
    assert not (tmp_path / "venv").exists()


def test_a_missing_interpreter_is_named(repository: Path, tmp_path: Path) -> None:
    done = make(repository, tmp_path, "demo", "PYTHON=python-of-nowhere")
    assert done.returncode != 0
    assert "There is no python-of-nowhere" in done.stdout


def test_the_wheels_are_left_out_inside_a_sourced_ros(repository: Path, tmp_path: Path) -> None:
    wheels = make(repository, tmp_path, "--dry-run", "demo")
    sourced = make(repository, tmp_path, "--dry-run", "demo", ROS_DISTRO="kilted")
    assert "-e '.[ros,view,plot]'" in wheels.stdout
    assert "-e '.[view,plot]'" in sourced.stdout
    assert "--system-site-packages" in sourced.stdout
