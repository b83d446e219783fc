"""`beardyn explain`."""

from __future__ import annotations

import json

import pytest

from beardyn_core.cli.main import BAD_INPUT, DONE, main


def test_explain_says_what_a_fixed_scene_has_and_what_auto_would_choose(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["explain", "static_80kN", "--accuracy", "3"]) == DONE
    said = capsys.readouterr().out
    assert "as the scene has it: tier full, 6 laminae" in said
    assert "what `effects: auto` would choose: tier full" in said
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
    assert chosen["expected_rtf"] > 0.0
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
