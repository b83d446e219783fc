"""Options of rolling resistance, drag and seal: SI inside, mistakes as sentences, all at once."""

from __future__ import annotations

from pathlib import Path

import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.config import load_effects
from beardyn_core.effects import Drag, RollingResistance, Seal


def test_options_are_read_in_their_units(tmp_path: Path) -> None:
    path = tmp_path / "lossy.yaml"
    path.write_text(
        "name: lossy\n"
        "rolling_resistance: {kind: aihara, supply: 0.5, thermal: false, hysteresis: 0.007}\n"
        "drag: {fill: 0.1}\n"
        "seal: {torque_N_m: 0.5, regularisation_speed_rad_per_s: 0.2}\n"
    )
    found = load_effects(str(path))
    assert found.rolling_resistance == RollingResistance("aihara", 0.5, False, 0.007)
    assert found.drag == Drag(fill=0.1)
    assert found.seal == Seal(torque=0.5, regularisation_speed=0.2)
    assert found.names() == ("rolling_resistance", "drag", "seal")


def test_mistakes_are_named_together(tmp_path: Path) -> None:
    path = tmp_path / "bad.yaml"
    path.write_text(
        "name: bad\n"
        "rolling_resistance: {kind: hysteresis}\n"
        "drag: {fill: 1.5}\n"
        "seal: {torque_Nm: 0.3, speed_coefficient_N_m_s_per_rad: -1}\n"
    )
    with pytest.raises(InputError) as caught:
        load_effects(str(path))
    assert caught.value.problems == [
        f"{path}: rolling_resistance: kind is hysteresis, but hysteresis is 0; give the share of the elastic "
        "energy lost in a cycle, 0.005 to 0.01 for bearing steel",
        f"{path}: drag.fill is 1.5; it must be at most 1",
        f"{path}: seal.torque_Nm: unknown key; give `torque_N_m`, a number in newton metres",
        f"{path}: seal.speed_coefficient_N_m_s_per_rad is -1; it must be at least 0",
    ]


def test_an_unknown_law_is_refused_with_those_allowed(tmp_path: Path) -> None:
    path = tmp_path / "bad.yaml"
    path.write_text("name: bad\nrolling_resistance: {kind: ball}\n")
    with pytest.raises(InputError, match=r"rolling_resistance\.kind is 'ball'; allowed are 'aihara'"):
        load_effects(str(path))
