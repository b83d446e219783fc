"""Launch files: read, run with a stand-in of launch_ros, and with launch_ros where it is installed."""

from __future__ import annotations

import ast
import importlib.util
import json
import re
import signal
import subprocess
import sys
from pathlib import Path

import psutil
import pytest

from beardyn_core.record.reporting import report
from beardyn_ros.__main__ import PROGRAMS
from beardyn_ros.node_parameters import PARAMETERS
from test.ros.graph import Graph

FOLDER = Path(__file__).parents[2] / "launch"
OPTIONAL = ("recorder", "monitor", "follower", "viewer")


def started_by(file: str, folder: Path, **arguments: str) -> dict[str, dict[str, object]]:
    """Parameters of the nodes that a launch file starts, none of which is started."""
    words = [f"{name}:={value}" for name, value in arguments.items()]
    stand_in = [sys.executable, "-m", "test.ros.launch_stand_in", str(folder), file, "--dry", *words]
    subprocess.run(stand_in, check=True, cwd=FOLDER.parent, stderr=subprocess.PIPE, text=True)
    found = {}
    for path in folder.glob("*.yaml"):
        ((name, given),) = json.loads(path.read_text(encoding="utf-8")).items()
        found[name.rpartition("/")[2]] = given["ros__parameters"]
    return found


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.launch.py")), ids=lambda path: path.name)
def test_launch_file_compiles_and_describes_a_launch(path: Path) -> None:
    tree = ast.parse(path.read_text(), str(path))
    compile(tree, str(path), "exec")
    assert "generate_launch_description" in [
        node.name for node in tree.body if isinstance(node, ast.FunctionDef)
    ]


def test_twin_launch_starts_existing_nodes_with_declared_parameters(tmp_path: Path) -> None:
    started = started_by("twin.launch.py", tmp_path, **dict.fromkeys(OPTIONAL, "true"))
    assert set(started) == {"twin", "load", *OPTIONAL} <= set(PROGRAMS)
    for name, given in started.items():
        declared = {parameter.name for parameter in PARAMETERS[name]}
        assert set(given) - {"use_sim_time"} <= declared


@pytest.mark.parametrize(
    ("wanted", "awaited"), [((), ""), (("viewer",), ""), (("follower", "recorder"), "recorder follower")]
)
def test_the_load_waits_for_the_listeners_that_are_launched(
    wanted: tuple[str, ...], awaited: str, tmp_path: Path
) -> None:
    started = started_by("twin.launch.py", tmp_path, **dict.fromkeys(wanted, "true"))
    assert set(started) == {"twin", "load", *wanted}
    assert started["load"]["wait_for"] == awaited


@pytest.mark.parametrize("word", ["True", "TRUE", "1"])
def test_a_switch_is_on_as_launch_writes_it(word: str, tmp_path: Path) -> None:
    started = started_by("twin.launch.py", tmp_path, monitor=word, use_sim_time=word, viewer="False")
    assert set(started) == {"twin", "load", "monitor"}
    assert started["load"]["wait_for"] == "monitor"
    assert started["monitor"]["use_sim_time"] is True


@pytest.mark.parametrize("file", ["twin.launch.py", "car.launch.py"])
def test_a_switch_that_is_neither_on_nor_off_is_refused(file: str, tmp_path: Path) -> None:
    with pytest.raises(subprocess.CalledProcessError) as found:
        started_by(file, tmp_path, monitor="yes", follower="maybe")
    assert "monitor yes: allowed are true, false" in found.value.stderr
    assert "follower maybe" in found.value.stderr


def arguments_of(file: str) -> set[str]:
    """Names in the table of arguments of a launch file."""
    tree = ast.parse((FOLDER / file).read_text())
    (table,) = (
        node.value
        for node in tree.body
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "ARGUMENTS"
    )
    assert isinstance(table, ast.Tuple)
    return {ast.literal_eval(row.elts[0]) for row in table.elts if isinstance(row, ast.Tuple)}


def test_every_argument_of_a_car_is_given_by_the_train_so_that_no_car_has_that_of_another() -> None:
    text = (FOLDER / "train.launch.py").read_text()
    for name in arguments_of("car.launch.py"):
        assert f'"{name}"' in text, name


class Launch:
    """A launch of the stand-in, running in a test."""

    def __init__(self, graph: Graph, file: str, *words: str) -> None:
        self.graph = graph
        given = (str(graph.folder), file, "--fake-twin", *words)
        graph.processes.start("launch", "-m", "test.ros.launch_stand_in", *given)

    @property
    def log(self) -> str:
        return self.graph.processes.log("launch")

    def exits(self) -> dict[str, int]:
        """Exit codes of the nodes, when everything has ended; nothing is left behind."""
        assert self.graph.exit_code("launch") == 0, self.log
        assert "Traceback" not in self.log, self.log
        pids = {name: int(pid) for name, pid in re.findall(r"^\[launch\] (\S+) pid (\d+)$", self.log, re.M)}
        assert not [name for name, pid in pids.items() if psutil.pid_exists(pid)]
        found = {n: int(code) for n, code in re.findall(r"^\[launch\] (\S+) exit (-?\d+)$", self.log, re.M)}
        assert set(found) == set(pids)
        return found


NODES = ("twin", "load", "recorder", "monitor", "follower")


@pytest.mark.parametrize("sim_time", ["false", "true"])
def test_all_nodes_end_with_0_when_the_load_is_replayed(graph: Graph, sim_time: str) -> None:
    path = graph.folder / "run.mcap"
    launch = Launch(
        graph, "twin.launch.py", "scene:=static_5kN", "recorder:=true", "monitor:=true", "follower:=true",
        f"output:={path}", f"use_sim_time:={sim_time}",
    )  # fmt: skip
    assert launch.exits() == {f"axlebox/{name}": 0 for name in NODES}
    found = report(path)
    assert (found.missing_messages, found.gaps) == ((), ())
    for name in NODES:
        given = json.loads((graph.folder / f"axlebox.{name}.yaml").read_text(encoding="utf-8"))
        assert given[f"/axlebox/{name}"]["ros__parameters"]["use_sim_time"] is (sim_time == "true")


def test_all_nodes_end_with_0_on_sigint_and_the_file_is_closed(graph: Graph) -> None:
    path = graph.folder / "run.mcap"
    launch = Launch(
        graph, "twin.launch.py", "scene:=cup_spall", "namespace:=left", "recorder:=true", "monitor:=true",
        "follower:=true", f"output:={path}", "speed_factor:=0.1",
    )  # fmt: skip

    def blocks(part: str, key: str) -> int:
        found = graph.statuses(part, "/left")
        return int(found[-1].value(key) or 0) if found else 0

    graph.until(lambda: blocks("twin", "blocks") > 20, "20 blocks")
    graph.processes.signal("launch", signal.SIGINT)
    assert launch.exits() == {f"left/{name}": 0 for name in NODES}
    found = report(path)
    assert found.complete
    assert found.gaps == ()


def test_cars_of_a_train_have_namespaces_and_files_of_their_own_and_one_clock(graph: Graph) -> None:
    boxes = ("axle_1_left", "axle_1_right")
    launch = Launch(
        graph, "train.launch.py", f"boxes:={' '.join(boxes)}", "duration:=1.0", "speed_factor:=0.0",
        f"output:={graph.folder / 'train.mcap'}", "faulty_box:=car_2/axle_1_left",
    )  # fmt: skip
    exits = launch.exits()
    wanted = {f"train/{car}/{box}/twin" for car in ("car_1", "car_2") for box in boxes}
    wanted |= {f"train/{car}/{part}" for car in ("car_1", "car_2") for part in ("load", "recorder")}
    assert exits == dict.fromkeys(wanted, 0)
    clocks = []
    for name in sorted(wanted):
        given = json.loads((graph.folder / f"{name.replace('/', '.')}.yaml").read_text(encoding="utf-8"))
        clocks += [name] if given[f"/{name}"]["ros__parameters"].get("publish_clock") else []
    assert clocks == ["train/car_1/axle_1_left/twin"]
    for car in ("car_1", "car_2"):
        for box in boxes:
            found = report(graph.folder / f"train_{car}_{box}.mcap")
            assert found.missing_messages == ()
            assert found.end > 0.9
    assert "somebody else publishes /clock" not in launch.log


def test_every_box_of_a_car_has_a_monitor_and_a_follower_whose_words_are_recorded(graph: Graph) -> None:
    boxes = ("axle_1_left", "axle_2_right")
    launch = Launch(
        graph, "car.launch.py", f"boxes:={' '.join(boxes)}", "monitor:=true", "follower:=true",
        "duration:=2.0", "speed_factor:=2.0", f"output:={graph.folder / 'car.mcap'}",
    )  # fmt: skip
    wanted = {f"car/{box}/{name}" for box in boxes for name in ("twin", "monitor", "follower")}
    assert launch.exits() == dict.fromkeys(wanted | {"car/load", "car/recorder"}, 0)
    for box in boxes:
        found = report(graph.folder / f"car_{box}.mcap")
        topics = {each.name for each in found.topics}
        assert {f"/car/{box}/monitor/result", f"/car/{box}/follower/estimate"} <= topics


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("cars:=0",), "cars 0: allowed are 1 to 20"),
        (("cars:=x",), "cars x: allowed are 1 to 20"),
        (("faulty_box:=car_3/axle_1_left",), "give car and box, such as car_2/axle_2_left"),
        (("faulty_box:=axle_1_left",), "give car and box, such as car_2/axle_2_left"),
    ],
)
def test_a_train_that_cannot_be_is_a_sentence(graph: Graph, words: tuple[str, ...], sentence: str) -> None:
    Launch(graph, "train.launch.py", *words)
    assert graph.exit_code("launch") != 0
    assert sentence in graph.processes.log("launch")
    graph.dismiss("launch")


@pytest.mark.slow
@pytest.mark.skipif(
    importlib.util.find_spec("launch_ros") is None,
    reason="launch_ros is not installed (apt install ros-$ROS_DISTRO-launch-ros, no registry has it)",
)
@pytest.mark.parametrize("interrupted", [False, True], ids=["to the end", "interrupted"])
def test_launch_itself_ends_with_0_and_so_do_its_nodes(graph: Graph, interrupted: bool) -> None:
    path = graph.folder / "run.mcap"
    scene = "cup_spall" if interrupted else "static_5kN"
    words = (f"scene:={scene}", "tier:=lumped", "recorder:=true", "monitor:=true", f"output:={path}")
    graph.processes.start("launch", "-m", "test.ros.real_launch", "twin.launch.py", *words)
    if interrupted:

        def blocks() -> int:
            found = graph.statuses("twin")
            return int(found[-1].value("blocks") or 0) if found else 0

        graph.until(lambda: blocks() > 20, "20 blocks", timeout=300.0)
        graph.processes.signal("launch", signal.SIGINT)
    graph.until(lambda: graph.processes.exit_code("launch") is not None, "the end", timeout=300.0)
    log = graph.processes.log("launch")
    assert graph.exit_code("launch") == 0, log
    assert log.count("process has finished cleanly") == 4, log
    found = report(path)
    assert found.complete
    assert not found.missing_messages  # an interrupted recorder does not wait for the last word of the twin
