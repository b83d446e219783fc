"""What RViz is told of an axlebox: URDF, meshes, frames; and in which frame each message is."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.parse import urlparse
from xml.etree import ElementTree

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.record.messages import decode
from beardyn_core.record.topics import topic
from beardyn_core.scene.defect import MissingRoller
from beardyn_ros.frames import TRANSFORMS, Pose, TurningFrames, encode_fixed, frame_of, pose_from
from beardyn_ros.robot_description import joints_of, part_meshes, sensor_places, stl_bytes, urdf, write_meshes
from test.record.synthetic_run import SHAPE, description
from test.ros.graph import Graph

SCENE_TEXT = "sensors:\n- name: axlebox_top\n  position_mm: [0, 10, 170]\n"


def facets(content: bytes) -> np.ndarray:
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    count = int(np.frombuffer(content[80:84], "<u4")[0])
    assert len(content) == 84 + 50 * count
    return np.frombuffer(content[84:], kind)


def rotation(quaternion: tuple[float, ...]) -> np.ndarray:
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_quat(quaternion).as_matrix())


# --- meshes ------------------------------------------------------------------------------------------


def test_meshes_are_small_have_the_size_of_the_bearing_and_face_outwards() -> None:
    found = part_meshes(SHAPE)
    assert set(found) == {"box", "cup", "cone", "cone_mark", "roller", "roller_mark", "cage_0", "cage_1"}
    parts = {name: facets(stl_bytes(mesh)) for name, mesh in found.items()}
    assert sum(part.nbytes for part in parts.values()) < 2_000_000
    radius = {
        name: np.hypot(part["corners"][..., 0], part["corners"][..., 2]) for name, part in parts.items()
    }
    assert radius["cup"].max() == pytest.approx(SHAPE.outer_diameter / 2, rel=1e-5)
    assert radius["cone"].min() == pytest.approx(SHAPE.bore / 2, rel=1e-5)
    assert radius["box"].min() == pytest.approx(SHAPE.outer_diameter / 2, rel=1e-5)
    assert np.ptp(parts["roller"]["corners"][..., 0]) == pytest.approx(SHAPE.roller_length, rel=1e-5)
    for part in parts.values():
        assert np.allclose(np.linalg.norm(part["normal"], axis=1), 1.0, atol=1e-5)
    outside = radius["cup"].min(axis=1) > 0.999 * SHAPE.outer_diameter / 2
    middle = parts["cup"]["corners"][outside].mean(axis=1)
    assert np.all(np.einsum("ij,ij->i", parts["cup"]["normal"][outside][:, ::2], middle[:, ::2]) > 0.0)


def test_meshes_are_written_once_and_named_after_their_content(tmp_path: Path) -> None:
    first = write_meshes(SHAPE, tmp_path / "meshes")
    before = {path: path.stat().st_mtime_ns for path in first.values()}
    assert write_meshes(SHAPE, tmp_path / "meshes") == first
    assert {path: path.stat().st_mtime_ns for path in first.values()} == before
    other = write_meshes(replace(SHAPE, bore=SHAPE.bore - 0.01), tmp_path / "meshes")
    assert other["cone"] != first["cone"]
    assert other["cup"] == first["cup"]


# --- URDF --------------------------------------------------------------------------------------------


def test_urdf_has_every_part_under_the_frame_of_the_box() -> None:
    run = replace(description(), scene_text=SCENE_TEXT)
    robot = ElementTree.fromstring(urdf(run, "car/axle_1_left", {"cone": "package://x/cone.stl"}))
    links = [link.get("name") for link in robot.iter("link")]
    assert len(set(links)) == len(links)
    assert links[0] == "car/axle_1_left"
    assert all(str(link).startswith("car/axle_1_left") for link in links)
    joints = {joint.get("name"): joint for joint in robot.iter("joint")}
    turning = {name for name, joint in joints.items() if joint.get("type") == "continuous"}
    count = SHAPE.roller_count
    assert turning == {
        "shaft",
        "cage_0",
        "cage_1",
        *(f"roller_{r}_{k}" for r in (0, 1) for k in range(count)),
    }
    assert all(joints[name].find("axis").get("xyz") == "0 1 0" for name in turning)  # type: ignore[union-attr]
    sensor = joints["sensor_axlebox_top"]
    assert sensor.find("origin").get("xyz") == "0 0.01 0.17"  # type: ignore[union-attr]
    assert [mesh.get("filename") for mesh in robot.iter("mesh")] == ["package://x/cone.stl"]


def test_a_missing_roller_is_not_drawn() -> None:
    run = replace(description(), defects=(MissingRoller(0, 3),))
    names = {joint.name for joint in joints_of(run)}
    assert "roller_0_3" not in names
    assert "roller_0_4" in names


@pytest.mark.parametrize("row", [0, 1])
@pytest.mark.parametrize("angle", [0.0, 2.0])
def test_the_large_end_of_a_roller_stands_where_the_twin_has_it(row: int, angle: float) -> None:
    joint = next(each for each in joints_of(description()) if each.name == f"roller_{row}_0")
    end = np.array(joint.drawn.xyz) + rotation(joint.drawn.quaternion) @ [SHAPE.roller_length / 2, 0.0, 0.0]
    cup = rotation(joint.drawn.quaternion) @ [0.0, 0.0, 1.0]
    turned = rotation((0.0, np.sin(angle / 2), 0.0, np.cos(angle / 2))) @ end
    side = 2.0 * row - 1.0
    radius = SHAPE.pitch_diameter / 2 + SHAPE.roller_length / 2 * np.sin(SHAPE.contact_angle)
    axial = side * (SHAPE.row_spacing / 2 + SHAPE.roller_length / 2 * np.cos(SHAPE.contact_angle))
    assert turned == pytest.approx([radius * np.sin(angle), axial, radius * np.cos(angle)], abs=1e-9)
    assert cup[2] > 0.9


def test_sensor_places_of_a_foreign_text_are_left_out() -> None:
    assert sensor_places(SCENE_TEXT) == {"axlebox_top": (0.0, 0.01, 0.17)}
    assert sensor_places("just text") == sensor_places("sensors: [3]") == {}


# --- transforms and frames ---------------------------------------------------------------------------


def test_transforms_are_what_tf2_reads() -> None:
    fixed = decode(TRANSFORMS, encode_fixed([("car", "car/box", Pose((1.0, 2.0, 3.0), (0.1, 0.2, 0.3)))]))
    (transform,) = fixed.transforms
    assert (transform.header.frame_id, transform.child_frame_id) == ("car", "car/box")
    turn = transform.transform.rotation
    from scipy.spatial.transform import Rotation

    assert Rotation.from_quat([turn.x, turn.y, turn.z, turn.w]).as_euler("xyz") == pytest.approx(
        [0.1, 0.2, 0.3]
    )
    angles = np.array([0.5, -1.0, 3.0])
    moving = decode(
        TRANSFORMS, TurningFrames("box", ("box/a", "box/bb", "box/ccc")).encode(5_000_000_007, angles)
    )
    for transform, angle in zip(moving.transforms, angles, strict=True):
        assert (transform.header.stamp.sec, transform.header.stamp.nanosec) == (5, 7)
        rotation_y = (transform.transform.rotation.y, transform.transform.rotation.w)
        assert rotation_y == pytest.approx((np.sin(angle / 2), np.cos(angle / 2)))
    assert [transform.child_frame_id for transform in moving.transforms] == ["box/a", "box/bb", "box/ccc"]


def test_frames_differ_by_namespace_unless_they_are_given() -> None:
    assert frame_of("/axlebox") == frame_of("/") == "axlebox"
    assert frame_of("/car/axle_1_left") == "car/axle_1_left"
    assert frame_of("/left", "wheelset/left") == "wheelset/left"
    assert pose_from("1 2 3 0 0 1.5") == Pose((1.0, 2.0, 3.0), (0.0, 0.0, 1.5))
    for text in ("1 2 3", "a b c d e f", "nan 0 0 0 0 0"):
        with pytest.raises(InputError, match="six numbers"):
            pose_from(text)


# --- on the graph ------------------------------------------------------------------------------------


def latched(graph: Graph, name: str) -> list[str]:
    """Texts of a latched topic, for a listener that comes late."""
    from beardyn_ros.robot_description import LATCHED
    from beardyn_ros.wire import message_class

    texts: list[str] = []
    graph.node.create_subscription(
        message_class("std_msgs/msg/String"), name, lambda message: texts.append(message.data), LATCHED
    )
    return texts


def test_a_late_reader_gets_the_description_of_every_box_with_meshes_that_exist(graph: Graph) -> None:
    graph.fake_twin(publish_clock=False)
    graph.start(
        "left", "test.ros.fake_twin", "twin", "--ros-args", "-r", "__ns:=/car/left", "-p", "scene:=fake"
    )
    graph.until(
        lambda: all(
            any(s.value("state") == "waiting for load" for s in graph.statuses("twin", namespace))
            for namespace in ("/axlebox", "/car/left")
        ),
        "both twins",
    )
    for namespace, frame in (("/axlebox", "axlebox"), ("/car/left", "car/left")):
        texts = latched(graph, f"{namespace}/robot_description")
        graph.until(texts.__len__, f"the description of {namespace}")
        robot = ElementTree.fromstring(texts[0])
        assert robot.find("link").get("name") == frame  # type: ignore[union-attr]
        files = [Path(urlparse(str(mesh.get("filename"))).path) for mesh in robot.iter("mesh")]
        assert len(set(files)) == 8
        assert all(len(facets(path.read_bytes())) > 10 for path in set(files))


def frames_on(graph: Graph, *names: str) -> dict[str, str]:
    return {
        name: decode(topic(name).type, graph.messages[name][0]).header.frame_id
        for name in names
        if graph.messages[name]
    }


@pytest.mark.parametrize(
    ("given", "frame"), [({}, "axlebox"), ({"frame_id": "wheelset/left"}, "wheelset/left")]
)
def test_every_header_is_in_a_frame_of_its_box(graph: Graph, given: dict[str, Any], frame: str) -> None:
    names = ("force", "vibration", "imu", "shaft", "joint_states", "bodies", "load/blocks")
    graph.listen(*names)
    graph.fake_twin(**given)
    graph.fake_load(duration=0.2, **given)
    assert graph.exit_code("twin") == 0
    assert frames_on(graph, *names) == {
        **dict.fromkeys(names, frame),
        **dict.fromkeys(("imu", "vibration"), f"{frame}/axlebox_top"),
    }


def test_frames_and_poses_that_tf2_does_not_take_are_refused(graph: Graph) -> None:
    graph.fake_twin("slash", frame_id="/axlebox")
    graph.fake_twin("pose", parent_frame="car", pose_in_parent="1.0 2.0")
    for name, word in (("slash", "no name of a frame"), ("pose", "six numbers")):
        assert graph.exit_code(name) == 2
        assert word in graph.processes.log(name)
        assert "Traceback" not in graph.processes.log(name)
