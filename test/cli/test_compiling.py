"""What a user sees while kernels are compiled; `test_interrupts` ends it."""

from __future__ import annotations

import logging
import os
import subprocess
import sys
from pathlib import Path

import numba
import numpy as np
import pytest

from beardyn_core import twin
from beardyn_core.base.jit import when_compiling
from beardyn_core.choice import load_scene
from beardyn_core.cli.main import main
from beardyn_core.cli.warmup import _of_one_box
from beardyn_core.config import read_scene


def test_only_a_kernel_that_is_not_compiled_yet_is_announced_and_once() -> None:
    summed = numba.njit(lambda values: 3.0 * values.sum())  # not kept in the cache
    said: list[str] = []
    for _ in range(2):
        with when_compiling(lambda: said.append("compiling")) as compiled:
            assert summed(np.ones(3)) == 9.0
        assert said == ["compiling"]
    assert not compiled


def test_a_scene_whose_kernels_are_in_the_cache_says_nothing(caplog: pytest.LogCaptureFixture) -> None:
    scene = load_scene("static_80kN", tier="lumped")
    twin.Twin(scene).warm()
    caplog.clear()
    with caplog.at_level(logging.INFO, logger="beardyn"):
        twin.Twin(scene).warm()
    assert caplog.messages == []


def test_warmup_tells_what_it_found(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["warmup", "static_80kN", "--tier", "lumped"]) == 0
    assert main(["warmup", "static_80kN", "--tier", "lumped"]) == 0
    last = capsys.readouterr().out.splitlines()[-1]
    assert last.split()[:2] == ["static_80kN", "lumped"]
    assert "in the cache" in last


def test_warmup_takes_a_sound_and_a_faulty_box_of_a_scene_with_axleboxes() -> None:
    found = _of_one_box(read_scene("bogie").scene)
    assert [bool(scene.faults) for scene in found] == [False, True]
    assert [scene.axleboxes for scene in found] == [None, None]
    sound = read_scene("smooth_run").scene
    assert _of_one_box(sound) == [sound]


FIRST_BLOCK = """
from beardyn_core.choice import load_scene
from beardyn_core.base.jit import when_compiling
from beardyn_core.rail.build import load_history
from beardyn_core.twin import Twin
scene = load_scene("static_80kN", tier="lumped")
twin = Twin(scene)
twin.warm()
with when_compiling(lambda: None) as compiled:
    twin.start(load_history(scene.operation, scene.mounting, 0.1, scene.seed))
    for _ in range(2):
        block = twin.advance()
        block.body_pose, block.body_twist, block.contacts
assert not compiled, compiled
"""


@pytest.mark.slow
def test_a_warm_twin_compiles_nothing_in_its_first_blocks(repository: Path, tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": str(repository), "BEARDYN_CACHE_DIR": str(tmp_path)}
    subprocess.run([sys.executable, "-c", FIRST_BLOCK], env=environment, check=True)
