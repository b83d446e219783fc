"""Kernels compiled for a level of x86-64 while a wheel is built are used where nothing else is."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import numba
import pytest

from beardyn_core.base import shipped_kernels
from beardyn_core.base.shipped_kernels import LEVELS, shipped_processor, told_to_numba

ROOT = Path(__file__).resolve().parents[2]
DOUBLE = """
import sys
from pathlib import Path
import numpy as np
from beardyn_core.base import kernel_cache
from beardyn_core.base.jit import LANE_WIDTH, entry, when_compiling
kernel_cache.shipped_root = lambda: Path(sys.argv[1])

@entry
def double(values, out):
    for k in range(values.shape[0]):
        out[k] = {factor} * values[k]

out = np.zeros(64)
with when_compiling(lambda: None) as compiled:
    double(np.arange(64.0), out)
print(bool(compiled), out[63] / 63.0, LANE_WIDTH)
"""


def doubled(
    shipped: Path, cache: Path, factor: float = 2.0, told: Mapping[str, str] | None = None
) -> list[str]:
    """Run a small kernel in a process of its own: whether it was compiled, the factor, the width of lanes."""
    inherited = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    done = subprocess.run(
        [sys.executable, "-c", DOUBLE.format(factor=factor), str(shipped)],
        env={**inherited, **(told or {}), "BEARDYN_CACHE_DIR": str(cache), "PYTHONPATH": str(ROOT)},
        text=True,
        capture_output=True,
        check=True,
    )
    return done.stdout.split()


def test_kernels_of_the_level_of_this_processor_need_no_compiling(tmp_path: Path) -> None:
    here = shipped_processor()
    if here is None:
        pytest.skip("this processor is below every level")
    level, _features = here
    lanes = "8" if level == "x86-64-v4" else "4"
    built, empty = tmp_path / "built", tmp_path / "empty"
    assert doubled(tmp_path / "none", built, told=told_to_numba(level)) == ["True", "2.0", lanes]
    assert doubled(built, empty) == ["False", "2.0", lanes]
    assert not empty.exists()  # nothing had to be kept
    assert doubled(built, empty, 3.0)[:2] == ["True", "3.0"]  # of other sources
    (file,) = (built / "kernels").iterdir()
    file.write_bytes(file.read_bytes()[:-1])
    assert doubled(built, tmp_path / "other")[:2] == ["True", "2.0"]  # damaged


def test_numba_compiles_for_the_processor_that_it_is_told(tmp_path: Path) -> None:
    built = tmp_path / "built"
    doubled(tmp_path / "none", built, told=told_to_numba("x86-64-v3"))
    told = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
    assert doubled(built, tmp_path / "empty", told=told)[0] == "True"


@pytest.mark.parametrize(
    ("features", "level"),
    [
        (LEVELS["x86-64-v4"], "x86-64-v4"),
        (LEVELS["x86-64-v4"][:-1], "x86-64-v3"),
        (LEVELS["x86-64-v3"], "x86-64-v3"),
        (LEVELS["x86-64-v3"][1:], None),
    ],
)
def test_a_processor_takes_the_highest_level_that_it_has_all_of(
    features: tuple[str, ...], level: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(numba.config, "CPU_NAME", None)
    monkeypatch.setattr(numba.config, "CPU_FEATURES", None)
    monkeypatch.setattr(
        shipped_kernels, "get_host_cpu_features", lambda: ",".join(f"+{each}" for each in features)
    )
    found = shipped_processor.__wrapped__()
    assert (found and found[0]) == level


def test_a_level_has_what_the_lower_ones_have() -> None:
    higher, lower = LEVELS.values()
    assert set(higher) > set(lower)
    assert "avx512f" in higher
    assert "avx512f" not in lower
