"""Kernels are compiled once on a machine; who only reads them waits for nobody."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest

from beardyn_core.choice import load_scene
from beardyn_core.study import compiling
from beardyn_core.study.compiling import alone_on_this_machine, is_compiled, warm_once
from beardyn_core.twin import Twin


@pytest.fixture
def warmed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[str]:
    """Tiers of the scenes whose kernels were asked for, by a stand-in, in a cache of its own."""
    seen: list[str] = []
    monkeypatch.setenv("BEARDYN_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(compiling, "_ready", set())
    monkeypatch.setattr(Twin, "warm", lambda twin: seen.append(twin.scene.tier))
    return seen


def test_of_each_kind_of_kernels_it_is_done_once_in_a_process(warmed: list[str]) -> None:
    lumped, other = load_scene("static_5kN", tier="lumped"), load_scene("static_5kN", tier="quasistatic")
    assert not is_compiled(lumped)
    for scene in (lumped, other, lumped, other):
        warm_once(scene)
        assert is_compiled(scene)
    assert warmed == ["lumped", "quasistatic"]


def test_a_new_kind_waits_for_who_compiles_and_a_known_one_does_not(
    warmed: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = load_scene("static_5kN", tier="lumped")
    waiting = threading.Thread(target=warm_once, args=(scene,), daemon=True)
    with alone_on_this_machine():  # another process compiles
        waiting.start()
        waiting.join(0.5)
        assert waiting.is_alive()
        assert not warmed
    waiting.join(10.0)
    assert warmed == ["lumped"]
    monkeypatch.setattr(compiling, "_ready", set())  # as in another process
    with alone_on_this_machine():
        warm_once(scene)
    assert warmed == ["lumped", "lumped"]
