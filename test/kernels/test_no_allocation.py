"""A step allocates nothing: the kernel's heap use does not grow with the number of steps."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from numba import config, njit
from numba.core.errors import NumbaError
from numba.core.runtime import _nrt_python as runtime  # type: ignore[attr-defined]
from numba.core.runtime import rtsys

from beardyn_core.base.jit import entry
from test.kernels.rig import Rig
from test.scenes import standard_scene

pytestmark = pytest.mark.skipif(
    bool(config.DISABLE_JIT),  # type: ignore[attr-defined]
    reason="counts allocations of compiled code",
)


@pytest.fixture(autouse=True)
def _counted() -> Iterator[None]:
    was_on = runtime.memsys_stats_enabled()
    runtime.memsys_enable_stats()
    yield
    if not was_on:
        runtime.memsys_disable_stats()


def allocations() -> int:
    stats = rtsys.get_allocation_stats()
    return int(stats.alloc + stats.mi_alloc)


def of_run(rig: Rig, steps: int) -> int:
    before = allocations()
    rig.run(steps)
    return allocations() - before


def test_a_step_allocates_nothing() -> None:
    """Nor is an array that is handed to it counted: its caller holds it."""
    rig = Rig.at_equilibrium(standard_scene())
    assert of_run(rig, 256) == 0


def test_a_kernel_that_allocates_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BEARDYN_CACHE_DIR", str(tmp_path))

    def doubled(values: np.ndarray) -> float:
        return float((2.0 * values).sum())

    values = np.ones(3)
    with pytest.raises(NumbaError, match="NRT required"):
        entry(doubled)(values)
    assert entry(doubled, allocates=True)(values) == 6.0


def test_the_count_sees_an_allocation_in_compiled_code() -> None:
    """Otherwise the test above could not fail."""

    @njit
    def grows(count: int) -> float:
        total = 0.0
        for i in range(count):
            total += [float(i), total][0]
        return total

    grows(1)
    before = allocations()
    grows(10)
    middle = allocations()
    grows(100)
    assert allocations() - middle > middle - before
