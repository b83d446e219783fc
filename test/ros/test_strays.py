"""Stray messages beside a run: whatever their stamp, truth or sender, the run is recorded whole."""

from __future__ import annotations

import json
from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beardyn_core.base.errors import InputError
from beardyn_core.record.checking import MessageChecker
from beardyn_core.record.clouds import encode_points
from beardyn_core.record.description import RunDescription
from beardyn_core.record.encoding import force_template
from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.messages import Diagnostic, encode_diagnostics, encode_string
from beardyn_core.record.published import published_before
from beardyn_core.record.topics import topic
from beardyn_ros.diagnostics import Namesakes
from beardyn_ros.live_load import encode_wrench
from beardyn_ros.message_guard import Sources
from beardyn_ros.recording import Recording, free_name, plain_name
from beardyn_ros.run_file import RunFile
from beardyn_ros.scenario import says_paused
from test.examples import examples
from test.record.synthetic_run import description

NO_BODIES = np.zeros(0, dtype=[("sample", "<u4")])
STEPS = {"force": 2_500_000, "bodies": 20_000_000}
FORCE, MARK = np.ones(6), np.full(6, 7.0)
LATEST_NS = (2**31 - 1) * 10**9
anywhere = st.sampled_from([0, 1, 10**9, 10**18, -(10**9), LATEST_NS]) | st.integers(-(10**18), LATEST_NS)


def message(name: str, stamp: int, stray: bool = False) -> bytes:
    if name == "force":
        return encode_wrench(MARK if stray else FORCE, stamp)
    return encode_points(NO_BODIES, stamp, "stray" if stray else "axlebox")


class Recorded:
    """A recording in a folder, and what it refuses."""

    def __init__(self, folder: Path) -> None:
        self.refused = 0
        self.recording = Recording(
            lambda _scene, number: free_name(folder / "run.mcap", number), "/axlebox", refuse=self._refuse
        )

    def _refuse(self, _name: str, _sentence: str) -> None:
        self.refused += 1

    def truth(self, run_id: str) -> None:
        self.recording.add(topic("truth"), encode_string(json.dumps({"scene": "x", "run_id": run_id})))

    def add(self, name: str, stamp: int, stray: bool = False) -> None:
        self.recording.add(topic(name), message(name, stamp, stray))

    def true_messages(self, name: str) -> list[list[int]]:
        """Stamps of the true messages of every file."""
        self.recording.close("")
        wanted = message(name, 0)
        found = []
        for path in self.recording.paths:
            own = [m for m in McapScan(path).messages() if m.topic == f"/axlebox/{name}"]
            found.append([m.log_time for m in own if m.cdr[12:] == wanted[12:]])
        return found


@pytest.mark.parametrize("name", STEPS)
@settings(max_examples=examples(60), deadline=None)
@given(strays=st.lists(st.tuples(st.integers(0, 39), anywhere), max_size=40))
def test_strays_of_any_stamp_cost_no_message_of_their_topic(
    name: str, strays: list[tuple[int, int]], tmp_path_factory: pytest.TempPathFactory
) -> None:
    recorded = Recorded(tmp_path_factory.mktemp("strays"))
    recorded.truth("one-0")
    for number in range(40):
        for place, stamp in strays:
            if place == number and abs(stamp - STEPS[name] * number) > 10 * STEPS[name]:
                recorded.add(name, stamp, stray=True)
        recorded.add(name, STEPS[name] * number)
    wanted = [STEPS[name] * number for number in range(40)]
    (found,) = recorded.true_messages(name)
    assert sorted(found) == wanted


@pytest.mark.parametrize("stamp", [0, 10**18, -5, LATEST_NS])
def test_one_stray_in_the_middle_is_refused_and_counted(stamp: int, tmp_path: Path) -> None:
    recorded = Recorded(tmp_path)
    recorded.truth("one-0")
    for number in range(400):
        recorded.add("force", STEPS["force"] * number)
        if number == 200:
            recorded.add("force", stamp, stray=True)
    found = recorded.true_messages("force")
    assert len(found[0]) == 400
    assert recorded.refused == 1


def test_alternating_strays_neither_lose_nor_split_a_run_and_a_reset_still_begins_a_file(
    tmp_path: Path,
) -> None:
    recorded = Recorded(tmp_path)
    for run_id in ("one-0", "one-1"):
        recorded.truth(run_id)
        for number in range(200):
            recorded.add("force", STEPS["force"] * number)
            if number:
                recorded.add("force", (0, 10**18)[number % 2], stray=True)
    assert [len(each) for each in recorded.true_messages("force")] == [200, 200]


def test_a_hole_longer_than_any_step_does_not_end_a_topic(tmp_path: Path) -> None:
    recorded = Recorded(tmp_path)
    recorded.truth("one-0")
    stamps = [*range(50), *range(4000, 4100)]
    for number in stamps:
        recorded.add("force", STEPS["force"] * number)
    assert recorded.true_messages("force") == [[STEPS["force"] * number for number in stamps]]


def test_a_few_messages_between_two_holes_are_kept(tmp_path: Path) -> None:
    """The publisher that is followed goes on, however few of its messages come through."""
    recorded = Recorded(tmp_path)
    recorded.truth("one-0")
    stamps = [*range(50), *range(2000, 2003), *range(4000, 4100)]
    for number in stamps:
        recorded.recording.add(
            topic("force"), message("force", STEPS["force"] * number, False), source=b"twin"
        )
    assert recorded.true_messages("force") == [[STEPS["force"] * number for number in stamps]]
    assert recorded.refused == 0


@pytest.mark.parametrize(
    "scene", ["../../etc/x", "/etc/x", "a/b", "..", ".hidden", "", "x\0y", "é" * 300, "a" * 5000, "con\n"]
)
def test_a_truth_chooses_no_folder(scene: str) -> None:
    name = plain_name(scene)
    assert Path(name).name == name
    assert name.isascii()
    assert not name.startswith(".")
    assert 0 < len(name) <= 60


CHANGES = st.sampled_from(
    ["scene", "scene_text", "shape", "body_names", "sensor_names", "defects", "sensor_rates_Hz"]
)
NONSENSE: st.SearchStrategy[object] = st.sampled_from(
    [None, 3, "x", [], {}, [[]], ["a/b"], ["a", "a"], [3], {"x": 1}, [{"on": 3}], True]
)


@settings(max_examples=examples(200), deadline=None)
@given(key=CHANGES, value=NONSENSE)
def test_a_truth_of_nonsense_is_a_description_or_a_sentence(key: str, value: object) -> None:
    content = json.loads(description().to_json())
    content["description"][key] = value
    with suppress(InputError):
        found = RunDescription.from_json(json.dumps(content))
        assert all(isinstance(name, str) for name in (*found.body_names, *found.sensor_names))
        assert found.shape.cup_angle > 0.0


@pytest.mark.parametrize("value", [10**9, -1, 0, 1.5, "14", None, float("nan")])
def test_a_truth_with_an_impossible_bearing_is_a_sentence(value: object) -> None:
    content = json.loads(description().to_json())
    content["description"]["shape"]["roller_count"] = value
    with pytest.raises(InputError, match="does not describe a beardyn run"):
        RunDescription.from_json(json.dumps(content))


@pytest.mark.parametrize("name", ["truth", "load/truth", "follower/estimate", "follower/residual"])
@pytest.mark.parametrize("text", ["[" * 5000, '{"a":' * 5000, "hello", "3", "null", '{"x": "\\udfff"}'])
def test_a_text_topic_takes_only_an_object_of_few_levels(name: str, text: str) -> None:
    assert MessageChecker().problem(topic(name), encode_string(text))
    assert not says_paused(text)


def test_what_a_late_recorder_could_not_receive_is_not_missing_but_a_lost_beginning_is() -> None:
    blocks = dict.fromkeys(("force_waveform", "vibration", "bodies", "contacts"), 40_000_000)
    late = published_before({**blocks, "force": 42_500_000, "temperature": 420_000_000}, parts=6)
    assert late == {**dict.fromkeys(blocks, 2), "force": 17, "temperature": 12}
    assert published_before({**blocks, "force": 42_500_000, "bodies": 5_000_000}) == {}


@pytest.mark.parametrize(
    ("status", "named"),
    [
        (Diagnostic("axlebox/recorder", 1, "followed is /axlebox/twin", (("x", "axlebox/twin"),)), False),
        (Diagnostic("axlebox/twin", 0, "running", (("instance", "0badcafe"),)), True),
        (Diagnostic("axlebox/twin", 0, "running", ()), True),
        (Diagnostic("left/axlebox/twin", 0, "running", (("instance", "0badcafe"),)), False),
    ],
)
def test_a_sentence_about_the_twin_is_not_the_status_of_another_twin(status: Diagnostic, named: bool) -> None:
    assert Namesakes("axlebox/twin").is_named_in(encode_diagnostics(0, "axlebox", [status])) == named


class GraphNode:
    """A node that knows who publishes on a topic."""

    def __init__(self, *names: str) -> None:
        self.names = list(names)

    def get_namespace(self) -> str:
        return "/axlebox"

    def resolve_topic_name(self, name: str) -> str:
        return f"/axlebox/{name}"

    def count_publishers(self, _name: str) -> int:
        return len(self.names)

    def get_publishers_info_by_topic(self, _name: str) -> list[SimpleNamespace]:
        return [
            SimpleNamespace(endpoint_gid=name.encode(), node_namespace="/axlebox", node_name=name)
            for name in self.names
        ]


@pytest.mark.parametrize(
    ("before", "then", "counts"),
    [
        (["twin", "stranger"], ["stranger"], (1, 0)),
        (["twin"], ["twin"], (1, 1)),
        (["twin"], [], (1, 0)),
        (["my_twin"], ["my_twin", "stranger"], (1, 2)),
        (["stranger"], ["stranger", "twin"], (1, 1)),
    ],
)
def test_a_stranger_on_truth_does_not_stand_for_a_twin_that_has_gone(
    before: list[str], then: list[str], counts: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    now = 0.0
    monkeypatch.setattr("beardyn_ros.message_guard.time.monotonic", lambda: now)
    node = GraphNode(*before)
    sources = Sources(node)
    first = sources.count("truth")
    now, node.names = 2.0, then
    assert (first, sources.count("truth")) == counts


def test_the_start_of_a_late_recording_is_known_before_its_first_block(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    file = RunFile(path, "/axlebox", None, McapWriter(path, "/axlebox"))
    stamps = np.array([5_000_000_000], np.int64)
    (row,) = force_template("axlebox").rows(stamps, wrench=np.zeros((1, 6)))
    file.add(topic("force"), row.tobytes())
    assert file.begin_s == 5.0
    file.close("")
