"""One bearing followed over several recordings: what goes on, and what is refused."""

from __future__ import annotations

import pytest

import beardyn_core as bd
from beardyn_core.cli import main as command
from beardyn_core.errors import InputError


def test_mileages_that_fall_are_refused() -> None:
    with pytest.raises(InputError, match="mileages: 0 m comes after"):
        bd.follow(["june.mcap", "may.mcap"], mileages=[1.2e7, 0.0])


def test_the_option_of_mileages_that_fall_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main(["follow", "june.mcap", "may.mcap", "--at-km", "412000", "400000"]) == 2
    assert "--at-km: 400000 comes after 412000" in capsys.readouterr().err
