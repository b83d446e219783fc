"""A twin that is started with a scene that names no effects: read at once, chosen for when it compiles."""

from __future__ import annotations

from typing import Any

import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.choice import load
from beardyn_core.config import load_effects
from beardyn_ros.rig import scene_rig

pytestmark = pytest.mark.usefixtures("shipped_configuration")


class ChosenError(Exception):
    """Raised in place of a choice."""


@pytest.fixture(autouse=True)
def _no_choice(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: Any) -> None:
        raise ChosenError

    monkeypatch.setattr(load, "choice_for", refuse)


def test_reading_a_scene_does_not_choose_and_building_does() -> None:
    build = scene_rig("cup_spall")
    with pytest.raises(ChosenError):
        build()


def test_a_mistake_is_told_at_once() -> None:
    with pytest.raises(InputError, match="there is no effects preset 'everything'"):
        scene_rig("cup_spall", effects="everything")


def test_named_effects_are_taken_as_they_are() -> None:
    rig = scene_rig("cup_spall", tier="quasistatic", effects="standard")()
    assert rig.twin.scene.effects == load_effects("standard")
    assert rig.twin.scene.tier == "quasistatic"
