"""`beardyn bearing` with laminae: load and pressure along the most loaded roller."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from beardyn_core.cli.main import main


def answer(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert main(["bearing", "HS130x230", "--end-play", "0", "--rings", "rigid", *words]) == 0
    return capsys.readouterr().out


def most_loaded(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, Any]:
    static = json.loads(answer(capsys, "--json", "--laminae", "20", *words))["static"]
    roller: dict[str, Any] = static["most_loaded_roller"]
    load = np.mean(roller["cup_load_per_length_N_per_m"]) * 0.05
    assert load == pytest.approx(static["largest_roller_load_N"], rel=1e-9)
    return roller


def test_most_loaded_roller_of_80_kN_is_at_its_hertz_pressure(capsys: pytest.CaptureFixture[str]) -> None:
    """Derived: 787 MPa at 9.8 kN, the contact with the cone; 0.5 % for its rounded load."""
    roller = most_loaded(capsys)
    assert np.mean(roller["cone_pressure_Pa"]) == pytest.approx(787e6, rel=5e-3)
    assert np.mean(roller["cup_pressure_Pa"]) < 0.95 * np.mean(roller["cone_pressure_Pa"])
    assert len(roller["place_m"]) == 20
    assert roller["place_m"][0] == pytest.approx(-0.02375)


def test_coupled_laminae_show_the_load_on_the_ends(capsys: pytest.CaptureFixture[str]) -> None:
    independent, coupled = most_loaded(capsys), most_loaded(capsys, "--coupled-laminae")
    for ring in ("cup", "cone"):
        name = f"{ring}_pressure_Pa"
        more = np.divide(coupled[name], independent[name])
        assert min(more[0], more[-1]) > 1.1
        assert 0.95 < more[10] < 1.0


def test_table_lists_the_laminae_when_there_are_several(capsys: pytest.CaptureFixture[str]) -> None:
    assert "along roller 0 of row" in answer(capsys, "--laminae", "6")
    assert "along roller" not in answer(capsys)
