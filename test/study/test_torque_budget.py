"""The torque budget of a run: it adds up to the torque on the shaft, in the summary and in the recording."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.report import json_object as report_object
from beardyn_core.cli.simulate import json_object, text
from beardyn_core.effects import Drag, RollingResistance, Seal
from beardyn_core.physics.bodies.losses import LOSS_NAMES, LOSSES
from beardyn_core.record.reporting import Report, report
from beardyn_core.record.sinks import McapSink
from beardyn_core.sensors.summary import NUMERICAL, torque_budget
from beardyn_core.study import desk_run


def test_budget_is_the_difference_of_energies_over_time_and_speed() -> None:
    lost = np.zeros((3, LOSSES + 1))
    lost[:, 2] = [1.0, 7.0, 13.0]
    lost[:, -1] = [0.0, -0.1, -0.2]
    budget = torque_budget([0.5, 0.7, 0.9], lost, 100.0)
    assert budget is not None
    assert (budget.begin, budget.end) == (0.5, 0.9)
    shares = {share.source: share for share in budget.shares}
    assert tuple(shares) == (*LOSS_NAMES, NUMERICAL)
    assert shares["rolling_resistance"].power == pytest.approx(30.0)
    assert shares["rolling_resistance"].torque == pytest.approx(0.30)
    assert shares[NUMERICAL].power == pytest.approx(-0.5)
    assert budget.power == pytest.approx(29.5)
    assert len(budget.lines()) == 4  # head, two sources, sum


def test_a_shaft_at_rest_has_powers_and_no_torques() -> None:
    budget = torque_budget([0.0, 1.0], np.arange(2.0)[:, None] * np.ones(LOSSES + 1), 0.0)
    assert budget is not None
    assert math.isnan(budget.torque)
    content = json.loads(json_text("simulate", budget.to_json()), parse_constant=pytest.fail)
    assert content["torque_N_m"]["rib"] is None
    assert content["power_W"]["rib"] == 1.0


def test_one_instant_is_no_budget() -> None:
    assert torque_budget([1.0], np.zeros((1, LOSSES + 1)), 1.0) is None


@pytest.fixture(scope="module")
def lossy(tmp_path_factory: pytest.TempPathFactory) -> tuple[desk_run.RunSummary, Report, Path]:
    """80 kN at 122 rad/s for 0.7 s with all that resists, recorded."""
    scene = load_scene("static_80kN", duration=0.7)
    effects = replace(scene.effects, rolling_resistance=RollingResistance(), drag=Drag(), seal=Seal())
    path = tmp_path_factory.mktemp("budget") / "run.mcap"
    summary = desk_run.run(replace(scene, effects=effects), [McapSink(path)])
    return summary, report(path), path


def test_torques_of_all_sources_are_the_torque_on_the_shaft(
    lossy: tuple[desk_run.RunSummary, Report, Path],
) -> None:
    """Steady run; 0.3 % for what is stored and released as the rollers pass the load."""
    summary = lossy[0]
    assert summary.budget is not None
    assert summary.budget.torque == pytest.approx(-summary.shaft_torque, rel=3e-3)
    assert summary.budget.shaft_speed == pytest.approx(122.0, rel=1e-4)
    shares = {share.source: share.torque for share in summary.budget.shares}
    assert min(shares[name] for name in ("rolling_resistance", "rib", "drag", "seal", "pocket")) > 0.05
    scene = load_scene("static_80kN")
    stiff = Seal().stiffening(scene.lubricant.kinematic_viscosity(scene.temperature))
    assert shares["seal"] == pytest.approx(stiff * 2.0 * (0.3 + 5e-4 * 122.0), rel=1e-4)
    assert shares["suspension"] == 0.0


def test_the_recording_tells_the_same_budget(lossy: tuple[desk_run.RunSummary, Report, Path]) -> None:
    summary, found, _ = lossy
    assert summary.budget is not None
    assert found.budget is not None
    for ours, recorded in zip(summary.budget.shares, found.budget.shares, strict=True):
        assert ours.source == recorded.source
        assert recorded.power == pytest.approx(ours.power, rel=0.02, abs=2.0)
    assert "rolling resistance" in found.to_text()
    content = json.loads(json_text("report", report_object(found, ())), parse_constant=pytest.fail)
    assert content["torque_budget"]["torque_sum_N_m"] == pytest.approx(found.budget.torque)


def test_text_and_json_of_the_command_show_the_budget(
    lossy: tuple[desk_run.RunSummary, Report, Path],
) -> None:
    summary = lossy[0]
    assert "\nrolling resistance " in text(summary, None, verbose=True)
    content = json.loads(json_text("simulate", json_object(summary, None)), parse_constant=pytest.fail)
    assert set(content["torque_budget"]["power_W"]) == {*LOSS_NAMES, NUMERICAL}


def test_without_audit_there_is_no_budget(lossy: tuple[desk_run.RunSummary, Report, Path]) -> None:
    silent = replace(lossy[0], budget=None)
    assert "rolling resistance " not in text(silent, None, verbose=True)
    assert json_object(silent, None)["torque_budget"] is None
