"""Rings that bend or not, by one word in statics and in runs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import beardyn_core as bd
from beardyn_core.cli.main import BAD_INPUT, DONE, main
from beardyn_core.config import automatic
from beardyn_core.config.automatic import set_rings
from beardyn_core.config.load import read_scene
from beardyn_core.effects import ModalStructure, RingStructure


@pytest.mark.parametrize("effects", ["standard", "all", {"preset": "all", "structure": {"kind": "rings"}}])
def test_the_word_decides_and_all_other_effects_stay(effects: Any) -> None:
    plain = bd.scene("static_80kN", effects=effects, tier="full").effects
    rigid = bd.scene("static_80kN", effects=effects, tier="full", rings="rigid").effects
    elastic = bd.scene("static_80kN", effects=effects, tier="full", rings="elastic").effects
    assert rigid.structure is None
    assert isinstance(elastic.structure, RingStructure)
    assert replace(rigid, structure=plain.structure) == replace(elastic, structure=plain.structure) == plain


def test_a_box_of_modes_is_kept_by_elastic_rings() -> None:
    written = {"preset": "auto", "structure": {"kind": "modes", "table": "high_speed"}}
    assert set_rings(written, "elastic") == written
    assert set_rings(written, "rigid") == {"preset": "auto", "structure": False}
    assert set_rings(None, "rigid") == {"preset": automatic.UNNAMED, "structure": False}
    free = read_scene("smooth_run", {("rings",): "rigid"})
    assert free.scene.effects.structure is None
    assert "structure" not in free.free.effects
    assert isinstance(read_scene("smooth_run").scene.effects.structure, ModalStructure)


def test_effects_in_code_take_the_word_too() -> None:
    whole = bd.scene("static_80kN", effects="all", tier="full").effects
    assert bd.scene("static_80kN", effects=whole, rings="rigid").effects == replace(whole, structure=None)
    assert bd.scene("static_80kN", effects=whole, rings="elastic").effects == whole


def test_the_command_prints_which_rings_a_run_had(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["simulate", "static_80kN", "--tier", "lumped", "--effects", "standard", "--duration", "0.1"]
    assert main(words) == DONE
    assert "rigid rings" in capsys.readouterr().out
    assert main([*words, "--rings", "elastic"]) == DONE
    assert "elastic rings" in capsys.readouterr().out
    assert main([*words, "--rings", "soft"]) == BAD_INPUT
    assert "allowed are elastic, rigid" in capsys.readouterr().err


def test_elastic_rings_of_a_run_and_of_statics_carry_alike(tmp_path: Path) -> None:
    for rings in ("elastic", "rigid"):
        run = bd.simulate(
            {"scene": "x", "bearing": "HS130x230", "lubricant": "L055", "tier": "quasistatic",
             "effects": "standard", "duration_s": 0.6, "end_play_mm": 0.2,
             "operation": {"kind": "constant", "force_kN": [0, 0, 80], "speed_rpm": 60}},
            rings=rings,
        )  # fmt: skip
        static = bd.equilibrium("HS130x230", 80, rings=rings)
        contacts = run.contacts
        most = contacts.load[len(contacts) // 2 :, ..., contacts.of("cup")].max()
        pressure = contacts.pressure[len(contacts) // 2 :, ..., contacts.of("cone")].max()
        assert most == pytest.approx(static.largest_roller_load, rel=0.03)
        assert pressure == pytest.approx(static.cone_pressure.max(), rel=0.03)
