"""The faults that outside clients found in the ROS graph, each as a scene with real processes."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

import numpy as np
import pytest

from beardyn_core.record.bag_scanning import files_of
from beardyn_core.record.messages import decode, header_stamp, time_reference
from beardyn_core.record.reading import read_run
from beardyn_core.record.reporting import report
from beardyn_core.record.topics import WRENCH
from beardyn_ros.environment import PROFILE_VARIABLES, prepare_environment
from evidence.ros import strangers
from test.ros import test_load_stream as stream
from test.ros import test_malformed as malformed
from test.ros import test_nothing_lost as lost
from test.ros import test_several_axleboxes as axleboxes
from test.ros import test_shared_parameters as shared
from test.ros import test_source_time as source
from test.ros import test_splitting as splitting
from test.ros import test_wall_time as wall
from test.ros import test_workspace as workspace
from test.ros.graph import Graph

IN_HZ, IN_AMPLITUDE_N = 45.0, 2e4


@dataclass(frozen=True)
class Fault:
    """One fault of the review."""

    number: int
    what: str
    then: A[str, "what was measured when it was found"]
    scene: A[
        Callable[[Path], str], "plays it in a folder and says what is measured now; fails with an assertion"
    ]


def _in_graph(scene: Callable[[Graph], str]) -> Callable[[Path], str]:
    def play(folder: Path) -> str:
        with Graph(folder) as graph:
            return scene(graph)

    return play


def _in_graphs(folder: Path, scenes: Sequence[Callable[[Graph], object]]) -> list[Graph]:
    """Play scenes one after the other; the graphs have what they have received."""
    graphs = []
    for number, scene in enumerate(scenes):
        place = folder / str(number)
        place.mkdir()
        with Graph(place) as graph:
            scene(graph)
        graphs.append(graph)
    return graphs


def _last(graph: Graph, key: str, part: str = "twin") -> str:
    return str(graph.statuses(part)[-1].value(key))


def _axleboxes(graph: Graph) -> str:
    axleboxes.test_the_end_of_one_axlebox_leaves_recorder_and_monitor_of_another_at_work(graph)
    run = read_run(graph.folder / "left.mcap")
    ran = float(graph.statuses("twin", "/left")[-1].value("simulated_time"))
    return (
        f"left records {run.vibration.time[-1]:.2f} of {ran:.2f} s, status {run.status}, beside two that end"
    )


def _tail(folder: Path) -> str:
    """Record without pace in a sourced ROS, as the nodes find it."""
    prepare_environment()  # AMENT_PREFIX_PATH, which a sourced ROS has
    counts, wrong = [], 0
    for number, factor in enumerate((0.0, 0.0, 4.0)):
        place = folder / str(number)
        place.mkdir()
        with ExitStack() as stack:
            environment = stack.enter_context(pytest.MonkeyPatch.context())
            for name in PROFILE_VARIABLES:
                environment.delenv(name, raising=False)
            environment.setenv("ROS_DISTRO", "kilted")
            graph = stack.enter_context(Graph(place))
            path = place / "run.mcap"
            graph.fake_twin(speed_factor=factor)
            graph.node_process("recorder", output=str(path))
            lost.is_connected(graph, "recorder")
            graph.fake_load(duration=6.0)
            code = lost.code_and_report_agree(graph, path)
            missing = report(path).missing_messages or ()
            counts.append(sum(each.count for each in missing))
            wrong += code != (lost.INCOMPLETE if missing else 0)
    assert not any(counts), f"{counts} messages missing"
    return f"messages missing in 3 runs: {counts}; codes and reports that disagree: {wrong}"


def _simulated_time(graph: Graph) -> str:
    wall.test_nodes_run_with_use_sim_time_on_and_off(graph, True)
    samples = len(read_run(graph.folder / "run.mcap").vibration)
    return f"use_sim_time: four nodes end with 0, {samples} of {50 * 512} samples recorded"


def _malformed(graph: Graph) -> str:
    malformed.test_every_node_counts_and_refuses_malformed_messages_and_goes_on(graph)
    refused = {part: _last(graph, "refused_messages", part) for part in ("recorder", "viewer", "twin")}
    end, ran = report(graph.folder / "run.mcap").end, float(_last(graph, "simulated_time"))
    told = ", ".join(f"{part} {count}" for part, count in refused.items())
    return f"refused: {told}; the file reaches {end:.2f} of {ran:.2f} s, codes 0"


def _aliases(graph: Graph) -> str:
    """Feed a sine of 45 Hz, which the sampling of the load would fold to 5 Hz."""
    graph.listen("force")
    graph.fake_twin(mode="live", max_age=5.0)
    source = stream.LiveSource(graph, IN_HZ)
    source.start()
    try:
        graph.until(lambda: len(graph.messages["force"]) > 3 * 400, "three seconds of force")
    finally:
        source.end()
    vertical = np.array([decode(WRENCH, cdr).wrench.force.z for cdr in graph.messages["force"][400:]])
    share = 0.5 * float(np.ptp(vertical)) / IN_AMPLITUDE_N
    assert share <= 0.05, f"{share:.1%} of the amplitude comes out"
    return f"{IN_HZ:g} Hz in: {share:.2%} of its amplitude comes out, at any frequency"


def _first_block(graph: Graph) -> str:
    stream.test_a_stream_whose_beginning_comes_late_is_whole(graph)
    return f"{len(graph.messages['vibration'])} of 50 blocks though block 0 came late; a lost one ends with 4"


def _bursts(graph: Graph) -> str:
    wall.test_trend_messages_are_spread_and_a_reader_with_sensor_data_quality_gets_them_all(graph)
    sent = json.loads(graph.processes.log("reader"))
    spacing = float(np.median(np.diff(sent))) * 1e-6
    return (
        f"a reader of depth 5 gets {len(sent)} of {_last(graph, 'messages force')}, {spacing:.2f} ms apart "
        f"at speed factor {_last(graph, 'speed_factor')}"
    )


def _blame(folder: Path) -> str:
    scenes = (
        stream.test_one_block_with_wild_sample_numbers_does_not_spoil_a_complete_stream,
        stream.test_one_block_from_the_far_future_is_refused_and_the_true_one_taken,
        stream.test_load_in_another_frame_is_refused_with_both_names,
        stream.test_the_warning_of_a_refusal_goes_when_all_is_well_again,
        stream.test_a_twin_that_was_told_to_stop_is_recorded_as_interrupted,
    )
    _in_graphs(folder, scenes)
    return "wild numbers, far stamps and a foreign frame refused by name, WARN goes, SIGINT is 'interrupted'"


def _two_twins(graph: Graph) -> str:
    axleboxes.test_a_second_twin_of_the_same_name_refuses_and_the_recording_of_the_first_is_whole(graph)
    run = read_run(graph.folder / "run.mcap")
    return f"the second twin ends with 2, the file of the first: {len(run.vibration)} samples, none missing"


def _packaging(graph: Graph) -> str:
    shared.test_a_file_shared_by_all_nodes_starts_them_all(graph)
    text = (Path(__file__).parents[2] / "package.xml").read_text()
    tested = [name for name in ("python3-pytest", "python3-hypothesis") if f"<test_depend>{name}" in text]
    assert len(tested) == 2, f"test dependencies in package.xml: {tested}"
    return "a /**: file starts four nodes; package.xml names " + " and ".join(tested)


def _splitting(graph: Graph) -> str:
    splitting.test_a_run_in_files_of_a_second_is_whole_and_its_index_is_followed(graph)
    folder = graph.folder / "run"
    count = len(files_of(folder))
    size = sum(path.stat().st_size for path in files_of(folder)) / 4.0 / 1e6
    return f"4 s in {count} files, {size:.1f} MB/s of this twin, read as one (memory: evidence.ros.memory)"


def _pause_and_hang(folder: Path) -> str:
    scenes = (
        wall.test_clock_and_diagnostics_go_on_while_the_twin_is_paused,
        wall.test_step_answers_when_its_block_is_published,
        wall.test_a_hung_reliable_reader_of_the_load_stalls_nobody,
    )
    said = len(_in_graphs(folder, scenes)[0].messages["/clock"])
    return f"{said} times /clock in a pause, step answers behind its block, a hung reader stalls nobody"


def _time_of_the_train(folder: Path) -> str:
    scenes = (
        source.test_live_outputs_carry_the_clock_of_the_source_and_its_events,
        source.test_a_clock_that_is_set_back_holds_the_twin_and_no_stamp_comes_twice,
        source.test_a_leap_is_no_loss_and_a_recorder_may_join_late,
    )
    reference = _in_graphs(folder, scenes)[0].messages["source_time"][0]
    ahead = 1e-9 * (header_stamp(reference) - time_reference(reference))
    return (
        f"stamps {ahead:.3f} s ahead of simulated time, on source_time; a step of load is in the force "
        "at its stamp, within two blocks; a clock that is set costs no sample"
    )


def _linked(folder: Path) -> str:
    workspace.test_setup_runs_through_a_link_as_colcon_makes_it(folder)
    return "setup.py runs through links; copied, linked and merged builds are tests"


FAULTS = (
    Fault(
        1, "axleboxes end each other's recorder and monitor",
        "left's file closed at 19.16 of 30 s, exit 0, '0 samples lost'", _in_graph(_axleboxes),
    ),
    Fault(
        2, "silent loss of the tail without pace",
        "5 of 5 files incomplete, three with '0 lost', exit 0", _tail,
    ),
    Fault(3, "use_sim_time deadlocks", "the load never sends", _in_graph(_simulated_time)),
    Fault(
        4, "one malformed cloud kills recorder and viewer",
        "traceback, exit 1, the file stops at 4.9 of 12 s", _in_graph(_malformed),
    ),
    Fault(5, "live load aliases", "45 Hz in, 5.01 Hz out", _in_graph(_aliases)),
    Fault(
        6, "a bag played at once loses its first block",
        "7.90 of 8.00 s, exit 0, nothing refused", _in_graph(_first_block),
    ),
    Fault(7, "trend topics come in bursts", "248 of 400 Hz at depth 5", _in_graph(_bursts)),
    Fault(
        8, "wrong blame",
        "far stamp: 'its source has stopped'; wild numbers: exit 4; WARN stays; SIGINT: 'vanished'", _blame,
    ),
    Fault(
        9, "two twins in one namespace go unmentioned",
        "one file, 16 479 013 'lost', exit 0", _in_graph(_two_twins),
    ),
    Fault(
        10, "packaging", "no test dependencies; a shared parameter file is fatal", _in_graph(_packaging),
    ),
    Fault(
        11, "the recorder does not split, memory grows",
        "200 GB a day in one file; monitor 224 -> 372 MB", _in_graph(_splitting),
    ),
    Fault(
        12, "pause, step and hung readers",
        "no /clock in a pause, step answers early, a hung reader stalls 5 s", _pause_and_hang,
    ),
    Fault(
        13, "one message with stamp 0 ends the recording of its topic",
        "6272 of 7987 messages of force lost, '0 samples lost'", _in_graph(strangers.stray_stamp),
    ),
    Fault(
        14, "a text of 5 kB of brackets, or 'hello', ends nodes",
        "traceback of twin, load, recorder and viewer", _in_graph(strangers.hostile_texts),
    ),
    Fault(
        15, "a foreign truth chooses the folder, splits the recording or ends the recorder",
        "a file as the truth names it; a run in two files, exit 0", _in_graph(strangers.strange_truth),
    ),
    Fault(
        16, "a device or a FIFO given as CSV", "hangs, or takes all memory", _in_graph(strangers.devices),
    ),
    Fault(17, "an integer of 6000 digits in a scene", "traceback", strangers.long_integer),
    Fault(
        18, "a file of 33 kB with a chunk of 1 GB", "report is busy for over 100 s", strangers.huge_chunk,
    ),
    Fault(
        19, "a recorder that joins in mid-run", "ends with 5 though nothing was lost after its start",
        _in_graph(strangers.late_recorder),
    ),
    Fault(
        20, "live mode loses the train's time",
        "load in epoch time, outputs from 0 on, the offset nowhere", _time_of_the_train,
    ),
    Fault(21, "colcon build --symlink-install fails", "README.md not found", _linked),
)  # fmt: skip
