"""The kernels mean the same without the compiler: their tests once more, in plain Python on NumPy arrays."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

CLAIMS = (
    "test_raceway.py",
    "test_lamina_coupling.py",
    "test_joint_lamina.py",
    "test_rib_and_pocket.py",
    "test_cage.py",
    "test_solve.py",
    "test_film_and_traction.py",
    "test_defect.py",
    "test_patch_power.py",
    "test_losses.py",
    "test_losses_step.py",
    "test_stage_timer.py",
    "test_lane_math.py::test_plain_operations_are_exact",
    "test_lane_math.py::test_nan_survives",
    "test_step.py::test_step_of_every_roller_is_that_of_dense_algebra",
)


@pytest.mark.slow
def test_kernels_pass_their_tests_without_the_compiler(repository: Path) -> None:
    """Also what coverage of the kernels is measured with."""
    here = Path(__file__).parent
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1", "PYTHONPATH": str(repository)}
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider"]
    done = subprocess.run(
        [*command, *(str(here / claim) for claim in CLAIMS)],
        cwd=repository, env=environment, capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-4000:]
