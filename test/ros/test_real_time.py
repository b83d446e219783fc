"""The twin takes the best tier that keeps the pace that it is asked for, and says what that costs."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from beardyn_core.base.errors import ValidityError
from beardyn_core.choice.discretisation_error import (
    BEYOND,
    COUPLED_BEYOND,
    COUPLED_IN_MIDDLE_BAND,
    IN_MIDDLE_BAND,
)
from beardyn_core.config import read_scene
from beardyn_core.config.load import OpenScene
from beardyn_core.scene.scene import Scene

pytest.importorskip("rclpy")

from beardyn_ros import real_time, rig
from beardyn_ros.real_time import MARGIN, Kept, keep_pace, measured_speed

SCENE = "static_80kN"


@pytest.fixture(autouse=True)
def many_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(real_time.os, "sched_getaffinity", lambda _process: range(8), raising=False)


def read(tier: str) -> OpenScene:
    given: dict[Any, Any] = {("effects",): "auto", ("tier",): tier}
    return read_scene(SCENE, given)


def kept(speeds: dict[str, float], pace: float = 1.0) -> tuple[Kept, list[str]]:
    """What is taken where the tiers run at these speeds, and which were measured."""
    measured = []

    def measure(scene: Scene) -> float:
        measured.append(scene.tier)
        return speeds[scene.tier]

    return keep_pace(read("full"), read, pace, measure), measured


@pytest.mark.parametrize(
    ("speeds", "taken", "measured"),
    [
        ({"full": 1.4, "quasistatic": 15.0}, "full", ["quasistatic", "full"]),
        ({"full": 1.2, "quasistatic": 15.0}, "quasistatic", ["quasistatic", "full"]),
        ({"quasistatic": 1.4}, "quasistatic", ["quasistatic"]),
        ({"quasistatic": 1.2, "lumped": 9.0}, "lumped", ["quasistatic", "lumped"]),
        ({"quasistatic": 0.1, "lumped": 0.7}, "lumped", ["quasistatic", "lumped"]),
    ],
)
def test_the_best_tier_with_a_margin_is_taken_and_no_other_is_compiled(
    speeds: dict[str, float], taken: str, measured: list[str]
) -> None:
    found, asked = kept(speeds)
    assert (found.tier, found.scene.tier, asked) == (taken, taken, measured)
    assert bool(found.note) == (taken != "full")
    if taken != "full":
        assert f"tier {taken} runs {speeds[taken]:.1f} times" in found.note
        assert ("too slow" in found.note) == (speeds[taken] < MARGIN)
        assert "% in place of" in found.note


COUPLED, PLAIN = "quasistatic, coupled", "quasistatic"


@pytest.mark.parametrize(
    ("speeds", "taken", "measured"),
    [
        ({"full": 1.4, COUPLED: 12.0}, "full", [COUPLED, "full"]),
        ({"full": 1.2, COUPLED: 12.0}, COUPLED, [COUPLED, "full"]),
        ({COUPLED: 1.2, PLAIN: 1.4}, PLAIN, [COUPLED, PLAIN]),
        ({COUPLED: 0.5, PLAIN: 0.6, "lumped": 2.0}, "lumped", [COUPLED, PLAIN, "lumped"]),
    ],
)
def test_where_rings_bend_quasistatic_with_coupled_laminae_comes_before_without(
    speeds: dict[str, float], taken: str, measured: list[str]
) -> None:
    asked = []

    def read_spall(tier: str) -> OpenScene:
        given: dict[Any, Any] = {("effects",): "auto", ("tier",): tier}
        return read_scene("cup_spall", given)

    def measure(scene: Scene) -> float:
        asked.append(COUPLED if scene.effects.lamina_coupling and scene.tier == PLAIN else scene.tier)
        assert scene.tier == "full" or scene.numerics.steps_per_sample == 2
        return speeds[asked[-1]]

    found = keep_pace(read_spall("full"), read_spall, 1.0, measure)
    assert asked == measured
    assert found.tier == taken.partition(",")[0]
    if found.tier == PLAIN:
        assert (found.scene.effects.lamina_coupling is not None) == (taken == COUPLED)
    if taken == COUPLED:
        bounds = f"up to {COUPLED_IN_MIDDLE_BAND:g} dB to 5 kHz, {COUPLED_BEYOND:g} dB above"
        assert f"tier quasistatic with coupled laminae runs {speeds[COUPLED]:.1f} times" in found.note
        assert f"third octaves {bounds} in place of 1.1 dB" in found.note
    if taken == PLAIN:
        assert f"up to {IN_MIDDLE_BAND[PLAIN]:g} dB to 5 kHz, {BEYOND[PLAIN]:g} dB above" in found.note


@pytest.mark.parametrize(("cores", "taken"), [(1, "quasistatic"), (2, "quasistatic"), (3, "full")])
def test_few_cores_carry_the_other_nodes_too(cores: int, taken: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 1.7 alone 1.1 was left on two cores with recorder and monitor, and five minutes fell behind."""
    monkeypatch.setattr(real_time.os, "sched_getaffinity", lambda _process: range(cores), raising=False)
    assert kept({"full": 1.7, "quasistatic": 15.0})[0].tier == taken


def test_a_slow_pace_has_the_full_tier_without_compiling_another() -> None:
    found, measured = kept({"full": 0.5}, pace=0.05)
    assert (found.tier, measured, found.note) == ("full", ["full"], "")


def test_a_tier_that_the_automatic_choice_takes_is_not_made_slower() -> None:
    """`effects: auto` takes the cheapest tier within the accuracy: here a faster one than full."""
    given: dict[Any, Any] = {("effects",): "auto"}
    found = keep_pace(read_scene(SCENE, given), read, 1.0, lambda scene: 2.0)
    assert (found.tier, found.note) == ("quasistatic", "")


def test_a_scene_that_only_the_full_tier_runs_stays_in_it() -> None:
    """Without ribs the fast tiers have no balance of the rollers."""

    def without_rib(tier: str) -> OpenScene:
        given: dict[Any, Any] = {("effects",): {"preset": "auto", "rib": False}, ("tier",): tier}
        return read_scene(SCENE, given)

    found = keep_pace(without_rib("full"), without_rib, 1.0, lambda scene: 0.5)
    assert (found.tier, found.note) == ("full", "")


def test_where_nothing_can_be_measured_the_tier_stays_and_the_reason_is_told() -> None:
    def fails(_scene: Scene) -> float:
        raise ValidityError("rollers fly apart")

    found = keep_pace(read("full"), read, 1.0, fails)
    assert found.tier == "full"
    assert found.note.endswith("is not known: rollers fly apart")


def test_a_speed_is_simulated_over_wall_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """By a clock that goes on by 10 ms whenever it is read: twice a block of 20 ms."""
    from beardyn_core.choice import load_scene

    now = 0.0

    def clock() -> float:
        nonlocal now
        now += 0.01
        return now

    scene = load_scene(SCENE, tier="lumped", effects="standard")
    monkeypatch.setattr(real_time, "time", SimpleNamespace(perf_counter=clock))
    assert measured_speed(scene) == pytest.approx(2.0, rel=0.3)


@pytest.mark.parametrize(
    ("tier", "effects", "pace", "asked"),
    [
        ("scene", "auto", 1.0, True),
        ("scene", "auto", 0.0, False),
        ("lumped", "auto", 1.0, False),
        ("scene", "standard", 1.0, False),
    ],
)
def test_only_what_is_left_open_is_chosen_for_a_pace(
    tier: str, effects: str, pace: float, asked: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    called = []

    def keep(_usual: OpenScene, _read: Any, pace: float, of_box: Any) -> Kept:
        assert of_box is None
        called.append(pace)
        return Kept(rig_scene, "lumped", "slower")

    from beardyn_core.choice import load_scene

    rig_scene = load_scene(SCENE, tier="lumped", effects="standard")
    monkeypatch.setattr(real_time, "keep_pace", keep)
    build = rig.scene_rig(SCENE, tier, effects, pace=pace)
    notes = [build().tier_note for _ in range(2)]
    assert called == [pace] * asked  # once, also when the run is reset
    assert notes == ["slower" if asked else ""] * 2
