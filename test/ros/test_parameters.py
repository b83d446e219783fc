"""Parameters: declared once, refused with a sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

from test.ros.graph import Graph

BAD: dict[str, tuple[dict[str, object], list[str]]] = {
    "unknown": ({"speeed_factor": 1.0}, ["unknown parameter 'speeed_factor'", "speed_factor"]),
    "range": ({"speed_factor": -1.0}, ["parameter 'speed_factor': -1.0 is outside the range 0 to 1000"]),
    "nan": ({"max_age": ".nan"}, ["parameter 'max_age': nan is outside the range 0.02 to 3600 s"]),
    "type": ({"autostart": 3}, ["parameter 'autostart': 3 is of type int, bool is needed"]),
    "choice": ({"mode": "lively"}, ["'lively' is not allowed, choose one of lockstep, live"]),
    "scene": ({"scene": "no_such_scene"}, ["scene 'no_such_scene' does not exist"]),
}


@pytest.mark.parametrize("case", list(BAD))
def test_bad_parameter_of_the_twin_is_refused_with_a_sentence(graph: Graph, case: str) -> None:
    parameters, sentences = BAD[case]
    graph.fake_twin(**parameters)
    assert graph.exit_code("twin") == 2
    log = graph.processes.log("twin")
    assert [sentence for sentence in sentences if sentence not in log] == []
    assert "Traceback" not in log


def test_all_bad_parameters_are_told_at_once(graph: Graph) -> None:
    graph.fake_twin(mode="lively", max_age=-3.0, colour="red")
    assert graph.exit_code("twin") == 2
    log = graph.processes.log("twin")
    assert all(name in log for name in ("'mode'", "'max_age'", "'colour'"))


def test_parameter_file_works_and_an_integer_is_taken_for_a_double(graph: Graph) -> None:
    file = graph.folder / "twin.yaml"
    file.write_text("/**:\n  ros__parameters:\n    scene: fake\n    speed_factor: 2\n    load_timeout: 1\n")
    graph.start("twin", "test.ros.fake_twin", "twin", "--ros-args", "--params-file", str(file))
    assert graph.until_state("waiting for load").value("speed_factor") == "2"
    described = graph.parameters_of("twin", "speed_factor")
    assert "simulated seconds per wall second" in described.description
    assert described.floating_point_range[0].to_value == 1000.0


def test_speed_factor_changes_while_running_and_a_bad_one_is_refused(graph: Graph) -> None:
    from rcl_interfaces.msg import Parameter, ParameterValue
    from rcl_interfaces.srv import SetParameters

    def set_to(name: str, value: float) -> bool:
        wanted = Parameter(name=name, value=ParameterValue(type=3, double_value=value))
        answer = graph.call("twin/set_parameters", SetParameters, parameters=[wanted])
        return bool(answer.results[0].successful)

    graph.fake_twin(speed_factor=0.5)
    graph.until_state("waiting for load")
    assert set_to("speed_factor", 3.0)
    graph.until(lambda: graph.statuses("twin")[-1].value("speed_factor") == "3", "the new speed factor")
    assert not set_to("speed_factor", -3.0)
    assert not set_to("max_age", 1.0)


def test_bad_file_of_the_recorder_is_refused(graph: Graph, tmp_path: Path) -> None:
    graph.node_process("recorder", output=str(tmp_path / "missing" / "run.mcap"))
    assert graph.exit_code("recorder") == 2
    assert "the folder does not exist" in graph.processes.log("recorder")


def test_unknown_node_and_stray_arguments_are_refused(graph: Graph) -> None:
    graph.processes.start("nobody", "-m", "beardyn_ros", "toaster")
    graph.processes.start("stray", "-m", "beardyn_ros", "twin", "scene:=cup_spall")
    assert graph.exit_code("nobody") == 2
    assert graph.exit_code("stray") == 2
    assert "there is no node 'toaster'" in graph.processes.log("nobody")
    assert "unknown argument(s) scene:=cup_spall" in graph.processes.log("stray")
