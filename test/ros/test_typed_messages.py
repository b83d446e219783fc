"""The package beardyn_msgs: it builds, and its messages carry what the topics of the table carry."""

from __future__ import annotations

import importlib.util
import json
import math
import re
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from beardyn_core.record.clouds import cloud_to_arrays
from beardyn_core.record.messages import (
    decode_diagnostics,
    decode_string,
    decode_told,
    header_frame,
    header_stamp,
)
from beardyn_core.record.plot_values import CODES
from beardyn_core.study.monitored_recording import Finding
from test.ros.graph import Graph

PACKAGE = Path(__file__).resolve().parents[2] / "interfaces/beardyn_msgs"
CLOUDS = {
    "vibration": ("Waveform", ("ax", "ay", "az"), ("m/s^2",) * 3),
    "force_waveform": ("Waveform", ("fx", "fy", "fz", "mx", "my", "mz"), ("N",) * 3 + ("N m",) * 3),
    "load/blocks": ("LoadBlock", ("fx", "fy", "fz", "mx", "my", "mz", "shaft_speed", "ux", "uy", "uz"), ()),
}


def definition(name: str) -> list[tuple[str, str, str]]:
    """Type, name and value of the members of a message; constants have a value."""
    lines = (PACKAGE / f"msg/{name}.msg").read_text(encoding="utf-8").splitlines()
    words = [line.partition("#")[0].split() for line in lines]
    return [(each[0], *each[1].partition("=")[::2]) for each in words if each]


def test_cmake_builds_every_message_and_the_manifest_names_what_they_need() -> None:
    cmake = (PACKAGE / "CMakeLists.txt").read_text(encoding="utf-8")
    messages = sorted(path.name for path in (PACKAGE / "msg").glob("*.msg"))
    assert re.findall(r'"msg/(\w+\.msg)"', cmake) == messages
    root = ElementTree.parse(PACKAGE / "package.xml").getroot()
    found = {tag: {str(each.text) for each in root.iter(tag)} for tag in ("buildtool_depend", "depend")}
    wanted = set(re.findall(r"find_package\((\w+) REQUIRED\)", cmake))
    assert found["buildtool_depend"] | found["depend"] == wanted
    assert root.findtext("name") == PACKAGE.name
    assert root.findtext("member_of_group") == "rosidl_interface_packages"
    assert root.findtext("version") == ElementTree.parse(PACKAGE.parents[1] / "package.xml").findtext(
        "version"
    )
    own = {path.stem for path in (PACKAGE / "msg").glob("*.msg")}
    for name in own:
        for kind, _, _ in definition(name):
            base = re.sub(r"\[.*\]$", "", kind)
            assert base in {*own, "std_msgs/Header", "string", "bool"} or re.fullmatch(
                r"u?int\d+|float\d+", base
            )


def test_a_verdict_has_every_field_of_a_finding_and_the_codes_of_the_numbers() -> None:
    members = {name for _, name, value in definition("Verdict") if not value}
    stated = {each.name for each in fields(Finding)} - {"time"}
    assert stated <= members
    for message in ("Verdict", "Estimate"):
        constants = {name.lower(): int(value) for _, name, value in definition(message) if value}
        assert constants.pop("unknown") not in CODES.values()
        assert constants.items() <= CODES.items()


def header_of(message: Any) -> tuple[int, str]:
    stamp = message.header.stamp
    return stamp.sec * 10**9 + stamp.nanosec, message.header.frame_id


def is_same(told: Any, number: float) -> bool:
    return math.isnan(number) if told is None else told == number


@pytest.mark.ros
@pytest.mark.parametrize("built_interfaces", ["beardyn_msgs"], indirect=True)
def test_typed_messages_arrive_and_are_equal_to_those_of_the_table(
    built_interfaces: None, graph: Graph
) -> None:
    import beardyn_msgs.msg as types

    typed = subscribe(graph, types)
    graph.listen(*typed)
    graph.fake_twin(speed_factor=2.0)
    graph.node_process("monitor", interval=0.5)
    graph.node_process("follower")
    for name in ("monitor", "follower"):
        graph.until(
            lambda name=name: any(each.value("connected") == "true" for each in graph.statuses(name)),  # type: ignore[misc]
            f"the connection of {name}",
        )
    for name in set(typed) - {"load/blocks"}:
        graph.until(
            lambda name=name: graph.node.count_publishers(f"/axlebox/typed/{name}"),  # type: ignore[misc]
            f"typed/{name}",
        )
    graph.fake_load(duration=4.0)
    for name in ("monitor", "follower", "twin", "load"):
        assert graph.exit_code(name) == 0
        assert "Traceback" not in graph.processes.log(name)
    table = graph.messages
    for name in ("vibration", "force_waveform", "monitor/result", "follower/estimate"):
        graph.until(
            lambda name=name: len(typed[name]) == len(table[name]) > 0,  # type: ignore[misc]
            f"every message of typed/{name}",
        )
    assert len(typed["vibration"]) == 200
    for name, (_, columns, units) in CLOUDS.items():
        check_clouds(typed[name], table[name], columns, units)
    check_verdicts(typed["monitor/result"], table["monitor/result"])
    check_estimates(typed["follower/estimate"], table["follower/estimate"])
    truth = typed["truth"][0]
    assert truth.json == decode_string(table["truth"][0])
    told = json.loads(truth.json)
    assert truth.run_id
    assert (truth.run_id, truth.scene, truth.seed) == (told["run_id"], told["scene"], told["seed"])
    assert (list(truth.effects), truth.bpfo) == (told["effects"], told["fault_frequencies_per_rev"]["BPFO"])
    assert [(each.part, each.row) for each in truth.defects] == [
        (each["on"], each["row"]) for each in told["faults"]
    ]


def subscribe(graph: Graph, types: Any) -> Mapping[str, list[Any]]:
    """Subscribe to every typed topic; what comes is in the lists."""
    from rclpy.qos import DurabilityPolicy, QoSProfile

    kinds = {name: kind for name, (kind, *_) in CLOUDS.items()}
    kinds |= {"monitor/result": "Verdict", "follower/estimate": "Estimate", "truth": "Truth"}
    found: dict[str, list[Any]] = {name: [] for name in kinds}
    for name, kind in kinds.items():
        latched = name == "truth"
        profile = QoSProfile(
            depth=1000,
            durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
        )
        keep: Callable[[Any], None] = found[name].append
        graph.node.create_subscription(getattr(types, kind), f"typed/{name}", keep, profile)
    return found


def check_clouds(
    typed: list[Any], table: list[bytes], columns: tuple[str, ...], units: tuple[str, ...]
) -> None:
    by_stamp = {(header_stamp(cdr), len(cloud_to_arrays(cdr)) > 0): cdr for cdr in table}
    assert len(typed) > 5
    for message in typed:
        stamp, frame = header_of(message)
        cdr = by_stamp[stamp, len(message.sample) > 0]  # the empty block that ends the load has stamp 0 too
        points = cloud_to_arrays(cdr)
        assert frame == header_frame(cdr)
        np.testing.assert_array_equal(message.sample, points["sample"])
        np.testing.assert_array_equal(message.t, points["t"])
        if units:
            assert [(each.name, each.unit) for each in message.channels] == list(
                zip(columns, units, strict=True)
            )
            for each in message.channels:
                np.testing.assert_array_equal(each.data, points[each.name])
        else:
            for name in columns:
                np.testing.assert_array_equal(getattr(message, name), points[name])


def check_verdicts(typed: list[Any], table: list[bytes]) -> None:
    assert len(typed) == len(table) > 2
    for message, cdr in zip(typed, table, strict=True):
        stamp, (status, *_) = decode_diagnostics(cdr)
        finding = Finding.from_diagnostic(status)
        assert finding is not None
        assert header_of(message) == (stamp, "axlebox")
        assert message.code == CODES[finding.verdict]
        for each in fields(Finding):
            if each.name != "time":
                told = getattr(finding, each.name)
                told = list(told) if isinstance(told, tuple) else told
                is_nan = isinstance(told, float) and math.isnan(told)
                assert is_same(None if is_nan else told, getattr(message, each.name)), each.name
    assert [message.last_word for message in typed] == [False] * (len(typed) - 1) + [True]
    assert typed[-1].analyses >= typed[-1].agreeing > 0


def check_estimates(typed: list[Any], table: list[bytes]) -> None:
    assert len(typed) == len(table) == 3  # of 1.5 and 3 s, and the last word
    for message, cdr in zip(typed, table, strict=True):
        told = decode_told(cdr)
        assert header_of(message) == (round(1e9 * told["time_s"]), "axlebox")
        assert message.last_word == told["final"]
        assert (message.health, message.code) == (told["health"], CODES[told["health"]])
        assert (list(message.doubts), list(message.names)) == (told["doubts"], told["names"])
        assert is_same(told["strangeness"], message.strangeness)
        size = len(told["names"])
        np.testing.assert_array_equal(np.reshape(message.covariance, (size, size)), told["covariance"])
        assert [f"{each.name}_{each.unit}" for each in message.quantities] == list(told["estimates"])
        for each, number in zip(message.quantities, told["estimates"].values(), strict=True):
            assert is_same(number["value"], each.value)
            assert each.reason == number["reason"]
            for level in ("interval_50", "interval_90"):
                ends = number[level] or [None, None]
                assert all(is_same(*pair) for pair in zip(ends, getattr(each, level), strict=True))
        assert message.has_forecast == (told["forecast"] is not None)
        if told["forecast"] is not None:
            assert is_same(told["forecast"]["widest_m"], message.widest)


@pytest.mark.ros
@pytest.mark.parametrize("built_interfaces", ["beardyn_msgs"], indirect=True)
def test_typed_topics_are_left_out_as_the_parameter_says(built_interfaces: None, graph: Graph) -> None:
    graph.fake_twin(typed=False)
    graph.fake_load(typed=False, duration=0.5, exit_when_done=False)
    graph.until_state("finished")
    names = {name for name, _ in graph.node.get_topic_names_and_types()}
    assert "/axlebox/vibration" in names
    assert not any("/typed/" in name for name in names)


@pytest.mark.ros
def test_without_the_package_there_is_no_typed_topic(graph: Graph) -> None:
    graph.fake_twin(exit_when_done=False)
    graph.fake_load(duration=0.5, exit_when_done=False)
    graph.until_state("finished")
    names = {name for name, _ in graph.node.get_topic_names_and_types()}
    assert "/axlebox/vibration" in names
    assert not any("/typed/" in name for name in names)


@pytest.mark.skipif(
    any(importlib.util.find_spec(f"colcon_{part}") is None for part in ("package_information", "ros")),
    reason="colcon is not installed (pip install colcon-package-information colcon-ros)",
)
def test_colcon_finds_the_package_next_to_the_nodes_as_the_page_says(tmp_path: Path) -> None:
    page = (PACKAGE.parents[1] / "docs/nodes.md").read_text(encoding="utf-8")
    (folders,) = re.findall(r"^colcon build --base-paths (.+)$", page, re.MULTILINE)
    (tmp_path / "src").mkdir()
    (tmp_path / "src/beardyn").symlink_to(PACKAGE.parents[1])
    main = "import sys; from colcon_core.command import main; sys.exit(main())"
    command = [sys.executable, "-c", main, "list", "--base-paths", *folders.split()]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=100, check=False)
    assert done.returncode == 0, done.stderr
    found = {line.split()[0]: line.split()[-1] for line in done.stdout.splitlines()}
    assert found == {"beardyn": "(ros.ament_python)", "beardyn_msgs": "(ros.ament_cmake)"}
