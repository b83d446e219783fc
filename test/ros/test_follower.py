"""The follower node: estimates from what a train has, with a twin beside, and recorded."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.cli.json_output import SCHEMA_VERSION
from beardyn_core.config import load_bearing
from beardyn_core.follow.descriptors import AXES, FINE, band_levels, names_of, places_of
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.familiarity import familiarity_of
from beardyn_core.record.messages import decode, decode_told, header_stamp
from beardyn_core.record.plot_values import CODES, FOLLOWER, VECTOR, value_topics
from beardyn_core.record.reporting import report
from test.cli.json_page import check_known
from test.record.synthetic_run import SyntheticRun
from test.ros.graph import Graph

ALLOWED = {f"/axlebox/{name}" for name in ("vibration", "shaft", "temperature")}
HOUSEKEEPING = {"/diagnostics", "/parameter_events"}
HEAD = {"schema_version": SCHEMA_VERSION, "command": "follow"}
COMPILED_IN_S = 240.0  # a set of kernels that no other test has, on a machine that does much besides


def test_follower_tells_what_a_train_does_not_measure_and_is_recorded(graph: Graph, tmp_path: Path) -> None:
    graph.listen("follower/estimate", *value_topics(FOLLOWER))
    file = tmp_path / "run.mcap"
    graph.fake_twin(speed_factor=2.0)
    graph.node_process("recorder", output=str(file))
    graph.node_process("follower", bearing="HS130x230", mileage=1000.0)
    for name in ("follower", "recorder"):
        graph.until(
            lambda name=name: any(each.value("connected") == "true" for each in graph.statuses(name)),  # type: ignore[misc]
            f"the connection of {name}",
        )
    follower = ("follower", "/axlebox")
    graph.until(
        lambda: follower in graph.node.get_node_names_and_namespaces(), "the follower's name in the graph"
    )
    received = graph.node.get_subscriber_names_and_types_by_node(*follower)
    assert {name for name, _ in received} - HOUSEKEEPING == ALLOWED
    graph.fake_load(duration=5.0)
    assert graph.exit_code("follower") == 0
    assert graph.exit_code("recorder") == 0
    told = [decode_told(cdr) for cdr in graph.messages["follower/estimate"]]
    assert told.pop()["final"]  # the last word again, for who waits for it
    assert [each["time_s"] for each in told] == pytest.approx([1.5, 3.0, 4.5], abs=0.02)
    assert told[0]["health"] == "waiting"
    last = told[-1]
    assert last["shaft_frequency_Hz"] == pytest.approx(19.1, abs=0.1)  # 120 rad/s
    assert len(last["covariance"]) == len(last["names"])
    # an artificial signal is no axlebox: it says so instead of being sure of its load
    assert last["health"] == "unexplained"
    assert last["doubts"]
    assert any(each.value("health") == "unexplained" for each in graph.statuses("follower"))
    counts = {each.name: each.count for each in report(file).topics}
    assert counts["/axlebox/follower/estimate"] == 4
    for name in value_topics(FOLLOWER):
        assert counts[f"/axlebox/{name}"] == 3
        stamps = [1e-9 * header_stamp(cdr) for cdr in graph.messages[name]]
        assert stamps == pytest.approx([each["time_s"] for each in told], abs=1e-9)
    numbers = {
        name: decode(VECTOR, graph.messages[f"values/{name}"][-1]).vector
        for name in ("health", "strangeness")
    }
    assert numbers["health"].x == CODES["unexplained"]
    assert numbers["strangeness"].x == pytest.approx(last["strangeness"], rel=1e-9)


@pytest.mark.parametrize(("scene", "axes"), [("fake", "x y z"), ("fake_one_axis", "z")])
def test_the_estimator_is_that_of_the_axes_that_come(scene: str, axes: str, graph: Graph) -> None:
    graph.listen("follower/estimate")
    graph.fake_twin(scene=scene, speed_factor=4.0)
    graph.node_process("follower", bearing="HS130x230")
    graph.until(
        lambda: any(each.value("connected") == "true" for each in graph.statuses("follower")),
        "the connection of the follower",
    )
    graph.fake_load(duration=3.5)
    assert graph.exit_code("follower") == 0
    told = [decode_told(cdr) for cdr in graph.messages["follower/estimate"]]
    assert [each["time_s"] for each in told[:-1]] == pytest.approx([1.5, 3.0], abs=0.04)
    status = graph.statuses("follower")[-1]
    assert status.value("axes") == axes
    assert "not measured" not in status.message
    assert f"by an estimator of the axes {axes.replace(' ', ', ')}" in graph.processes.log("follower")


def quieter_estimator(path: Path) -> Path:
    """An estimator that has learnt from what the fake twin sends, at a tenth of its level."""
    rate, count, names = 25_600.0, 38_401, names_of(AXES)
    random, rows = np.random.default_rng(3), np.full((130, len(names_of(AXES))), np.nan)
    for number, row in enumerate(rows):
        gain = 0.1 * 10.0 ** (random.normal(0.0, 1.0, 3) / 20.0)
        usual = SyntheticRun(seed=100 + number)._acceleration(np.arange(count) / rate)
        for axis, signal in zip(AXES, (gain * usual).T, strict=True):
            levels = band_levels(signal - signal.mean(), rate, FINE, 12)
            for frequency, level in levels.items():
                row[names.index(f"fine_{axis}_{frequency:.0f}")] = level
    box = places_of(AXES, "box")
    middle, spread = np.zeros(len(names)), np.ones(len(names))
    middle[box], spread[box] = rows[:, box].mean(axis=0), rows[:, box].std(axis=0)
    standard = np.nan_to_num((rows - middle) / spread)
    familiar = familiarity_of(standard[:100], box).set_bound(standard[100:])
    plate = NamePlate.of(load_bearing("HS130x230"))
    numbers: dict[str, Any] = {"quantities": {}}
    Estimator(
        plate, AXES, rate, 1.5, middle, spread, familiar, familiar, {}, None, None, numbers
    ).save(path)  # fmt: skip
    return path


def test_a_gain_that_is_not_as_stated_is_in_the_diagnostics(graph: Graph, tmp_path: Path) -> None:
    graph.fake_twin(speed_factor=4.0)
    graph.node_process(
        "follower", bearing="HS130x230", estimator=str(quieter_estimator(tmp_path / "quiet.npz"))
    )
    graph.until(
        lambda: any(each.value("connected") == "true" for each in graph.statuses("follower")),
        "the connection of the follower",
    )
    graph.fake_load(duration=5.0)
    assert graph.exit_code("follower") == 0
    status = graph.statuses("follower")[-1]
    assert status.value("health") == "unexplained"
    assert "check mounting and gain of the sensor" in status.value("mounting")
    told = re.search(r"the gain of all axes is off by \+(\S+) dB", status.value("mounting"))
    assert told is not None
    assert float(told[1]) == pytest.approx(20.0, abs=1.0)
    assert status.value("mounting") in status.message


@pytest.mark.usefixtures("compiled_kernels")
def test_a_twin_runs_beside_and_what_is_received_is_compared_with_it(graph: Graph) -> None:
    graph.listen("follower/estimate", "follower/residual")
    graph.fake_twin(speed_factor=4.0)
    words = {"twin": "smooth_run", "twin_tier": "lumped", "exit_when_done": False}
    graph.node_process("follower", bearing="HS130x230", **words)
    graph.until(
        lambda: any(each.value("connected") == "true" for each in graph.statuses("follower")),
        "the connection of the follower",
    )
    graph.fake_load(duration=5.0)
    graph.until(lambda: graph.messages["follower/residual"], "a comparison", timeout=COMPILED_IN_S)
    estimates, residuals = (
        [dict(decode_told(cdr)) for cdr in graph.messages[f"follower/{name}"]]
        for name in ("estimate", "residual")
    )
    residual, step = residuals[0], estimates[1]  # from the second stretch on
    assert residual.pop("time_s") == step["time_s"]
    assert not step.pop("final")
    check_known("follow", {**HEAD, "recordings": ["live"], "steps": [step], "residual": residual})
    assert residual["axes"] == ["x", "y", "z"]
    for name in ("measured_dB", "twin_dB"):
        levels = np.array(residual[name], float)
        assert levels.shape == (3, len(residual["frequency_Hz"]))
        assert np.isfinite(levels).mean() > 0.5
    # an artificial signal is no axlebox: the twin at the state that is believed does not explain it
    assert residual["explained"] < 1.0
    assert residual["sentences"]
    told = f"{residual['explained']:.3f}"
    graph.until(
        lambda: any(each.value("explained_by_twin") == told for each in graph.statuses("follower")),
        "the share in the diagnostics",
    )
    status = next(each for each in graph.statuses("follower") if each.value("explained_by_twin") == told)
    assert residual["sentences"][0] in status.message
    assert "Traceback" not in graph.processes.log("follower")


@pytest.mark.slow
def test_a_known_load_gives_a_rating_life_from_a_topic_or_a_parameter(graph: Graph) -> None:
    graph.listen("follower/estimate")
    graph.fake_twin(speed_factor=2.0)
    graph.node_process("follower", bearing="HS130x230", mileage=1000.0, load="topic:5%")
    graph.until(
        lambda: any(each.value("connected") == "true" for each in graph.statuses("follower")),
        "the connection of the follower",
    )
    graph.fake_load(duration=3.5)
    assert graph.exit_code("follower") == 0
    told = [decode_told(cdr) for cdr in graph.messages["follower/estimate"]]
    assert len(told) == 3
    for step in told:
        load = step["known_load"]
        assert load["source"] == "topic"
        low, high = load["interval_90_N"]
        assert np.sqrt(high / low) == pytest.approx(1.05, abs=0.01)
        assert step["estimates"]["vertical_load_N"]["value"] == pytest.approx(load["value_N"])
    rating = told[-1]["forecast"]["rating"]
    assert rating["spans_m"] == [[0.0, pytest.approx(1e6, rel=1e-3)]]
    low, middle, high = rating["used"]
    assert 0.0 < low < middle < high < 1.0


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ({"load": "70000kN"}, "parameter 'load' is '70000kN'"),
        ({"load": "topic:80%"}, "parameter 'load' is 'topic:80%'"),
        ({"load_sensor": "spring x=1"}, "parameter 'load_sensor'"),
        ({"axle_load": "17"}, "parameter 'axle_load'"),
    ],
)
def test_a_load_that_makes_no_sense_is_refused_at_once(
    words: dict[str, str], sentence: str, graph: Graph
) -> None:
    graph.node_process("follower", bearing="HS130x230", **words)
    assert graph.exit_code("follower") == 2
    assert sentence in graph.processes.log("follower")


def test_mistakes_are_refused_with_the_parameter(graph: Graph) -> None:
    graph.node_process("follower", bearing="HS999")
    assert graph.exit_code("follower") == 2
    log = graph.processes.log("follower")
    assert "parameter 'bearing'" in log
    assert "Traceback" not in log


@pytest.mark.parametrize(
    ("twin", "sentence"),
    [("smoth_run", "smoth_run"), ("static_5kN", "runs on a track (kind: quarter_vehicle)")],
)
def test_a_twin_that_cannot_run_beside_is_refused_at_once(twin: str, sentence: str, graph: Graph) -> None:
    graph.node_process("follower", bearing="HS130x230", twin=twin)
    assert graph.exit_code("follower") == 2
    log = graph.processes.log("follower")
    assert "parameter 'twin'" in log
    assert sentence in log


def test_a_bearing_without_an_estimator_is_refused_with_the_command_that_makes_one(graph: Graph) -> None:
    graph.node_process("follower", bearing="AARK_6.5x9")
    assert graph.exit_code("follower") == 2
    log = graph.processes.log("follower")
    assert "parameter 'estimator'" in log
    assert "beardyn train --bearing AARK_6.5x9" in log
