"""Kernels take as many rollers at once as the processor that numba compiles for."""

from __future__ import annotations

import llvmlite.binding
import numba
import pytest

from beardyn_core.base.jit import lane_width


class Features(dict[str, bool]):
    """What llvmlite gives."""

    def flatten(self) -> str:
        return ",".join(f"{'+' if there else '-'}{name}" for name, there in self.items())


@pytest.mark.parametrize(
    ("told", "avx", "lanes"),
    [
        (None, 1, 8),
        (None, 0, 4),
        ("", 1, 4),  # NUMBA_CPU_NAME=generic
        ("+avx2,+fma", 1, 4),
        ("+avx2,+avx512f", 0, 8),
        ("+avx2,-avx512f", 1, 4),
    ],
)
def test_lanes_are_those_of_the_features_that_numba_takes(
    told: str | None, avx: int, lanes: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(llvmlite.binding, "get_host_cpu_features", lambda: Features(sse2=True, avx512f=True))
    monkeypatch.setattr(numba.config, "CPU_FEATURES", told)
    monkeypatch.setattr(numba.config, "ENABLE_AVX", avx)
    assert lane_width() == lanes


def test_a_processor_without_a_list_of_features_takes_four(monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown() -> Features:
        raise RuntimeError

    monkeypatch.setattr(llvmlite.binding, "get_host_cpu_features", unknown)
    monkeypatch.setattr(numba.config, "CPU_FEATURES", None)
    assert lane_width() == 4
