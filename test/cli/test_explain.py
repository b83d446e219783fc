"""`beardyn explain`."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from beardyn_core.cli.main import BAD_INPUT, DONE, main


def test_explain_says_what_a_fixed_scene_has_and_what_auto_would_choose(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["explain", "static_80kN", "--accuracy", "3"]) == DONE
    short = capsys.readouterr().out
    assert "tier full" in short
    assert "`effects: auto` would choose:\n  tier quasistatic" in short
    assert "answer: within 3 % of the full model" in short
    assert main(["explain", "static_80kN", "--accuracy", "3", "--verbose"]) == DONE
    said = capsys.readouterr().out
    assert "as the scene has it: tier full, 6 laminae" in said
    assert "what `effects: auto` would choose: tier quasistatic" in said
    assert "within 3 %" in said
    assert "rolling_resistance" in said
    assert "N m of a torque of about" in " ".join(said.split())


def test_explain_json_has_reason_cost_and_error_of_every_effect(capsys: pytest.CaptureFixture[str]) -> None:
    assert (
        main(["explain", "static_80kN", "--effects", "auto", "--quantities", "force,torque", "--json"])
        == DONE
    )
    found = json.loads(capsys.readouterr().out)
    chosen = found["current"]
    assert found["automatic"] is None
    assert chosen["within_accuracy"]
    assert set(chosen["expected_error"]) == {"force", "torque"}
    assert chosen["real_time_factor"] > 0.0
    on = {decision["effect"]: decision for decision in chosen["decisions"] if decision["on"]}
    assert on["rolling_resistance"]["cost_share"] > 0.0
    assert all(decision["reason"] for decision in chosen["decisions"])
    shares = sum(decision["cost_share"] for decision in chosen["decisions"])
    assert 0.0 < shares < 1.0
    assert found["costs"]["machine"]


def test_explain_of_a_wrong_quantity_is_bad_input(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", "static_80kN", "--quantities", "noise", "--accuracy", "-1"]) == BAD_INPUT
    said = capsys.readouterr().err
    assert "--quantities" in said
    assert "--accuracy -1" in said


@pytest.mark.parametrize("tier", ["lumped", "quasistatic", "auto"])
def test_explain_of_heat_in_any_tier(tier: str, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    scene = tmp_path / "warm.yaml"
    scene.write_text(WARM.format(tier=tier, preset="auto" if tier == "auto" else "full"))
    assert main(["explain", str(scene), "--json"]) == DONE
    found = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert found["current"]["decisions"]


WARM = """
scene: warm
bearing: HS130x230
lubricant: L055
tier: {tier}
effects: {{preset: {preset}, thermal: {{}}, audit: {{}}}}
operation: {{kind: constant, force_kN: [0, 0, 80], speed_rpm: 1165}}
duration_s: 1.0
"""


def test_explain_tells_what_the_scene_has_where_no_rule_offers_it(capsys: pytest.CaptureFixture[str]) -> None:
    """Nothing of the reference's friction and cage is said to be there, and no error is made up."""
    words = ["explain", "static_80kN", "--effects", "frictionless", "--quantities", "force, torque", "--json"]
    assert main(words) == DONE
    current = json.loads(capsys.readouterr().out)["current"]
    by_name = {decision["effect"]: decision for decision in current["decisions"]}
    assert by_name["traction"]["choice"] == "off"
    assert not by_name["traction"]["on"]
    unknown = {"error": None, "unit": "share"}
    assert by_name["traction"]["error"] == {"force": unknown, "torque": unknown}
    assert "judged like" in by_name["rib"]["reason"]
    assert current["expected_error"]["torque"] == unknown
    assert not current["within_accuracy"]


def test_a_rib_with_fewer_options_is_judged_like_the_lubricated_one(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """That of the preset `standard` has a film and no drilling friction: it is no dry rib."""
    assert (
        main(["explain", "static_80kN", "--effects", "standard", "--quantities", "torque", "--json"]) == DONE
    )
    current = json.loads(capsys.readouterr().out)["current"]
    (rib,) = (decision for decision in current["decisions"] if decision["effect"] == "rib")
    assert "judged like 'lubricated'" in rib["reason"]
    assert rib["error"]["torque"]["error"] == 0.0


def test_explain_names_the_background_and_a_path_that_is_no_model(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "ratio.csv").write_text("frequency_Hz,real,imaginary\n10,1,0\n5000,1,0\n")
    scene = tmp_path / "mine.yaml"
    scene.write_text(
        "scene: mine\nbearing: HS130x230\nlubricant: L055\n"
        "operation: {kind: constant, force_kN: [0, 0, 60], speed_rpm: 600}\n"
        "background: {name: rattling, knocks: {rate_Hz: 2, impulse_N_s: 0.5}}\n"
        "sensors: [{name: top, measured_paths: [{path: ratio.csv, axes: [z]}]}]\n"
    )
    assert main(["explain", str(scene)]) == DONE
    said = capsys.readouterr().out
    assert "background rattling: knocks" in said
    assert "sensor top: measured path ratio.csv on z, a filter behind the rigid box" in said
