"""Choices are kept: found again by all that they depend on, by nothing else, and never damaged."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from beardyn_core.choice import choice_cache, load
from beardyn_core.choice.choice_cache import folder, kept, typical
from beardyn_core.choice.rule import Choice
from beardyn_core.config import read_scene
from beardyn_core.config.load import OpenScene
from beardyn_core.effects import EffectSet
from beardyn_core.scene.scatter import Scatter
from beardyn_core.scene.scene import Free


@pytest.fixture(autouse=True)
def _empty(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BEARDYN_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(choice_cache, "_known", {})


@pytest.fixture
def found() -> OpenScene:
    """A scene with its effects left open."""
    return read_scene("static_80kN", {("effects",): "auto"})


def made(seconds: float = 1.0, vibration_to: float = 1e4) -> Choice:
    """Make a choice that could be any."""
    return Choice(
        "full", EffectSet(), 4, 3, 0.05, ("force",), "a", "b", "c", (), {"force": 0.0}, 1.0, seconds, True,
        vibration_to,
    )  # fmt: skip


def counted(choice: Choice) -> tuple[Callable[[], Choice], list[int]]:
    """Make what works a choice out, and what counts how often."""
    calls: list[int] = []

    def work_out() -> Choice:
        calls.append(1)
        return choice

    return work_out, calls


def asked(scene: object, work_out: Callable[[], Choice], free: Free | None = None) -> Choice:
    """Ask as a new process would, which remembers nothing."""
    choice_cache._known.clear()
    return kept(scene, free or Free(), None, work_out)  # type: ignore[arg-type]


def test_a_choice_is_made_once_and_then_read(found: OpenScene) -> None:
    work_out, calls = counted(made())
    first = asked(found.scene, work_out)
    second = asked(found.scene, work_out)
    assert len(calls) == 1
    assert (first.kept, second.kept) == (False, True)
    assert replace(second, kept=False) == first


def test_the_seconds_of_a_choice_are_announced_once(
    found: OpenScene, monkeypatch: pytest.MonkeyPatch
) -> None:
    said: list[str] = []
    monkeypatch.setattr(load.log, "info", said.append)
    monkeypatch.setattr("beardyn_core.choice.choose.choose", lambda *_: made())
    load._announce.cache_clear()
    load.choice_for(found)
    assert said == [load.CHOOSING]
    load.choice_for(replace(found, scene=replace(found.scene, duration=7.0)))
    assert said == [load.CHOOSING]
    load._announce.cache_clear()
    choice_cache._known.clear()
    load.choice_for(found)
    assert said == [load.CHOOSING], "it was kept, and took no seconds"


def test_what_a_choice_depends_on_makes_another(found: OpenScene) -> None:
    work_out, calls = counted(made())
    scene = found.scene
    asked(scene, work_out)
    sensor = replace(scene.sensors[0], position=(0.0, 0.0, 0.1))
    others = (
        replace(scene, end_play=2e-4),
        replace(scene, bearing=replace(scene.bearing, roller_count=scene.bearing.roller_count - 1)),
        replace(scene, accuracy=0.02),
        replace(scene, quantities=("force",)),
        replace(scene, sensors=(sensor,)),
        replace(scene, effects=replace(scene.effects, drag=None)),
    )
    for number, other in enumerate(others, start=2):
        asked(other, work_out)
        assert len(calls) == number, other
    asked(scene, work_out, Free(tier=False))
    assert len(calls) == len(others) + 2


def test_name_and_purpose_make_no_other_choice(found: OpenScene) -> None:
    work_out, calls = counted(made())
    asked(found.scene, work_out)
    asked(replace(found.scene, name="copy", purpose="mine"), work_out)
    assert len(calls) == 1


def test_other_rules_or_costs_make_another(found: OpenScene, monkeypatch: pytest.MonkeyPatch) -> None:
    work_out, calls = counted(made())
    asked(found.scene, work_out)
    monkeypatch.setattr(choice_cache, "_rules", lambda: "of another version")
    asked(found.scene, work_out)
    assert len(calls) == 2


def test_a_file_counts_by_its_content(tmp_path: Path, found: OpenScene) -> None:
    from beardyn_core.scene.operation import MeasuredOperation

    table = tmp_path / "load.csv"
    work_out, calls = counted(made())
    scene = replace(found.scene, operation=MeasuredOperation(table))
    for content, number in (("1", 1), ("1", 1), ("2", 2)):
        table.write_text(content)
        asked(scene, work_out)
        assert len(calls) == number


@pytest.mark.parametrize("damage", [b"", b"x", b"\0" * 64, b"half"])
def test_a_damaged_file_counts_as_none_and_is_mended(found: OpenScene, damage: bytes) -> None:
    work_out, calls = counted(made())
    asked(found.scene, work_out)
    (path,) = folder().iterdir()
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2] if damage == b"half" else damage)
    assert asked(found.scene, work_out) == made()
    assert len(calls) == 2
    assert path.read_bytes() == whole


def test_a_folder_that_cannot_be_written_keeps_nothing(
    tmp_path: Path, found: OpenScene, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("BEARDYN_CACHE_DIR", str(tmp_path / "file"))
    work_out, calls = counted(made())
    assert asked(found.scene, work_out) == made()
    assert asked(found.scene, work_out) == made()
    assert len(calls) == 2


def test_what_nothing_could_judge_is_not_kept(found: OpenScene) -> None:
    work_out, calls = counted(made(vibration_to=float("nan")))
    for _ in range(2):
        asked(found.scene, work_out)
    assert len(calls) == 2


def test_chance_decides_nothing(found: OpenScene) -> None:
    one = replace(found.scene, seed=3, scatter=Scatter("G1", 5))
    other = replace(found.scene, seed=4, scatter=Scatter("G1", 6))
    assert typical(one) == typical(other)
    assert typical(one) != typical(replace(one, scatter=Scatter("G2", 5)))


def test_every_shipped_scene_has_a_key() -> None:
    from beardyn_core.config.folders import shipped_names

    keys = {choice_cache._key(read_scene(name).scene, Free(), None) for name in shipped_names("scenes")}
    assert len(keys) > 1
