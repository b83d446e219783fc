"""Linear algebra in one thread while a function runs."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg
from threadpoolctl import threadpool_info, threadpool_limits

from beardyn_core.base.one_thread import in_one_thread
from beardyn_core.choice import choose as choosing
from beardyn_core.choice import load_scene
from beardyn_core.physics.statics import static


def threads() -> list[int]:
    return [int(each["num_threads"]) for each in threadpool_info() if each["user_api"] == "blas"]


def test_every_library_has_one_thread_inside_and_as_many_as_before_afterwards() -> None:
    scipy.linalg.solve(np.eye(2), np.ones(2))
    with threadpool_limits(2):
        before = threads()
        assert in_one_thread(threads)() == [1] * len(before)
        assert threads() == before


def test_the_threads_come_back_after_an_error() -> None:
    @in_one_thread
    def fail() -> None:
        raise ValueError("no")

    with threadpool_limits(2):
        before = threads()
        with pytest.raises(ValueError, match="no"):
            fail()
        assert threads() == before


class _SeenError(Exception):
    pass


def test_statics_and_choices_are_in_one_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    def look(*_: object, **__: object) -> None:
        raise _SeenError(threads())

    scene = load_scene("static_5kN")
    monkeypatch.setattr(static, "_equilibrium", look)
    monkeypatch.setattr(choosing, "Evidence", look)
    with threadpool_limits(2):
        count = len(threads())
        with pytest.raises(_SeenError) as found:
            static.solve(scene.bearing, (0.0, 0.0, 1e4), end_play=None)
        assert found.value.args[0] == [1] * count
        with pytest.raises(_SeenError) as found:
            choosing.choose(scene)
        assert found.value.args[0] == [1] * count
