"""What RViz shows of an axlebox: ``robot_description`` as URDF with its meshes, ``/tf_static`` and ``/tf``.

Joints are called as in ``joint_states``: ``shaft`` turns the cone, ``cage_<row>`` and ``roller_<row>_<k>`` go
round with it. Links are called as their frames, below the frame of the box, so that several boxes stand in
one view. Meshes are STL files, computed from the dimensions of the bearing.

Late readers get description and fixed frames too (transient-local). tf2_msgs is not among the ROS 2 wheels:
without it the frames stay unpublished, which is said once, and the description is there all the same.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import atan2, cos, pi, sin
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from beardyn_core.base.cache_root import cache_root
from beardyn_core.base.errors import InputError
from beardyn_core.config.yaml_text import read_mapping
from beardyn_core.physics.thermal import NODES
from beardyn_core.record import meshes
from beardyn_core.record.description import BearingShape, RunDescription
from beardyn_core.record.encoding import orbit_joints
from beardyn_core.record.meshes import CUT_OPEN, ROW_SIDE, Mesh
from beardyn_core.record.messages import decode, decode_string, encode_string, header_stamp
from beardyn_core.record.topics import JOINTS
from beardyn_ros.frames import ORIGIN, TRANSFORMS, Pose, TurningFrames, encode_fixed, pose_from
from beardyn_ros.wire import message_class

COLOURS = {
    "box": "0.35 0.42 0.50 1",
    "cup": "0.59 0.64 0.72 1",
    "cone": "0.48 0.53 0.63 1",
    "cage": "0.25 0.59 0.55 1",
    "roller": "0.85 0.86 0.88 1",
    "mark": "0.15 0.16 0.18 1",
}
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_DARK = 0.6
HOUSING_WALL = 0.15  # of the outer diameter of the bearing
LATCHED = QoSProfile(
    depth=1,
    history=HistoryPolicy.KEEP_LAST,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)


@dataclass(frozen=True)
class Joint:
    """A frame below that of the box, with what is seen there.

    Parameters
    ----------
    name : str
        As in ``joint_states`` where it turns.
    child : str
        Frame below that of the box.
    turns : bool
        About +y of the box; otherwise it is fixed.
    origin : Pose
        Of the child in the frame of the box.
    part : str
        Mesh, '' for none.
    drawn : Pose
        Place of the mesh in the child.
    """

    name: str
    child: str
    turns: bool
    origin: Pose = ORIGIN
    part: str = ""
    drawn: Pose = ORIGIN


def joints_of(run: RunDescription) -> tuple[Joint, ...]:
    """List the frames of an axlebox below its own.

    Parameters
    ----------
    run : RunDescription

    Returns
    -------
    tuple of Joint
        Cup, sensors and the other parts that ``temperature`` names, which are fixed, then what turns.
    """
    shape, absent = run.shape, run.absent_bodies
    places = sensor_places(run.scene_text)
    found = [Joint("cup", "cup", False, part="cup")]
    found += [
        Joint(f"sensor_{name}", name, False, Pose(places.get(name, (0.0, 0.0, 0.0))))
        for name in run.sensor_names
    ]
    taken = {"cup", "cone", *run.sensor_names}
    found += [Joint(f"part_{node}", node, False) for node in NODES if node not in taken]
    found.append(Joint("shaft", "cone", True, part="cone"))
    middle = shape.row_spacing / 2.0
    for name in orbit_joints(shape.roller_count):
        if name in absent or name == "shaft":
            continue
        kind, row = name.split("_")[0], int(name.split("_")[1])
        if kind == "cage":
            drawn, part = Pose((0.0, ROW_SIDE[row] * middle, 0.0)), name
        else:
            drawn, part = _roller_pose(run, row), "roller"
        found.append(Joint(name, name, True, part=part, drawn=drawn))
    return tuple(found)


def _roller_pose(run: RunDescription, row: int) -> Pose:
    """Place a roller at the top: mid-length on the pitch circle, x to the large end, z to the cup."""
    shape, side = run.shape, ROW_SIDE[row]
    tilt = shape.contact_angle
    x = (0.0, side * cos(tilt), sin(tilt))
    z = (0.0, -side * sin(tilt), cos(tilt))
    y = (z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0])
    yaw, pitch, roll = atan2(x[1], x[0]), atan2(-x[2], (x[0] ** 2 + x[1] ** 2) ** 0.5), atan2(y[2], z[2])
    return Pose((0.0, side * shape.row_spacing / 2.0, shape.pitch_diameter / 2.0), (roll, pitch, yaw))


def sensor_places(scene_text: str) -> dict[str, tuple[float, float, float]]:
    """Read where the accelerometers of a scene are, from its resolved text.

    Parameters
    ----------
    scene_text : str
        YAML.

    Returns
    -------
    dict of str to tuple of float
        From the bearing centre, [m]; without sensors that the text says nothing of.
    """
    try:
        scene = read_mapping(scene_text, "the scene of the truth")
    except InputError:
        return {}
    sensors = scene.get("sensors")
    found = {}
    for sensor in sensors if isinstance(sensors, list) else ():
        if isinstance(sensor, dict) and "name" in sensor and "position_mm" in sensor:
            with suppress(TypeError, ValueError, OverflowError):
                x, y, z = (float(value) * 1e-3 for value in sensor["position_mm"])
                found[str(sensor["name"])] = (x, y, z)
    return found


def urdf(run: RunDescription, frame: str, mesh_files: Mapping[str, Path | str]) -> str:
    """Write the URDF of an axlebox.

    Parameters
    ----------
    run : RunDescription
    frame : str
        Of the box, the root link; the others are called ``<frame>/<name>``.
    mesh_files : mapping of str to Path or str
        Files or addresses by part; a part without one is not drawn.

    Returns
    -------
    str
    """
    robot = ElementTree.Element("robot", name=frame.replace("/", "_"))
    for name, colour in COLOURS.items():
        ElementTree.SubElement(
            ElementTree.SubElement(robot, "material", name=f"{frame}/{name}"), "color", rgba=colour
        )
    _add_link(robot, frame, frame, "box", ORIGIN, mesh_files)
    for joint in joints_of(run):
        child = f"{frame}/{joint.child}"
        _add_link(robot, frame, child, joint.part, joint.drawn, mesh_files)
        kind = "continuous" if joint.turns else "fixed"
        element = ElementTree.SubElement(robot, "joint", name=joint.name, type=kind)
        ElementTree.SubElement(element, "parent", link=frame)
        ElementTree.SubElement(element, "child", link=child)
        _add_origin(element, joint.origin)
        if joint.turns:
            ElementTree.SubElement(element, "axis", xyz="0 1 0")
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode", xml_declaration=True) + "\n"


def _add_link(
    robot: ElementTree.Element,
    frame: str,
    name: str,
    part: str,
    drawn: Pose,
    mesh_files: Mapping[str, Path | str],
) -> None:
    link = ElementTree.SubElement(robot, "link", name=name)
    for mesh in (part, f"{part}_mark"):
        if mesh not in mesh_files:
            continue
        colour = "mark" if mesh.endswith("_mark") else part.split("_")[0]
        file = mesh_files[mesh]
        visual = ElementTree.SubElement(link, "visual")
        _add_origin(visual, drawn)
        address = file.as_uri() if isinstance(file, Path) else file
        ElementTree.SubElement(ElementTree.SubElement(visual, "geometry"), "mesh", filename=address)
        ElementTree.SubElement(visual, "material", name=f"{frame}/{colour}")


def _add_origin(element: ElementTree.Element, pose: Pose) -> None:
    words = {key: " ".join(f"{value:.9g}" for value in getattr(pose, key)) for key in ("xyz", "rpy")}
    ElementTree.SubElement(element, "origin", words)


def mesh_folder() -> Path:
    """Name the folder of meshes."""
    return cache_root() / "meshes"


def part_meshes(shape: BearingShape) -> dict[str, Mesh]:
    """Build the meshes of a bearing and its box; ``<part>_mark`` is what shows that it turns.

    Parameters
    ----------
    shape : BearingShape

    Returns
    -------
    dict of str to Mesh
        Each in its own axes; see `beardyn_core.record.meshes`.
    """
    found: dict[str, Mesh] = {"box": housing(shape), "cup": meshes.cup(shape)}
    for name, mesh in (
        ("cone", meshes.cone(shape)),
        ("roller", meshes.roller(shape)),
        ("cage_0", meshes.cage(shape, 0)),
        ("cage_1", meshes.cage(shape, 1)),
    ):
        dark = mesh.shades[mesh.triangles].mean(axis=(1, 2)) < _DARK
        found[name] = _part(mesh, ~dark)
        if dark.any():
            found[f"{name}_mark"] = _part(mesh, dark)
    return found


def housing(shape: BearingShape) -> Mesh:
    """Build the box as a ring around the cup, cut open where the cup is."""
    half, inner = 0.55 * shape.width, shape.outer_diameter / 2.0
    outer = inner + HOUSING_WALL * shape.outer_diameter
    profile = np.array([(-half, outer), (half, outer), (half, inner), (-half, inner), (-half, outer)])
    return meshes.join_meshes(
        meshes.revolve(profile, np.linspace(CUT_OPEN[1], CUT_OPEN[0] + 2.0 * pi, 73)),
        meshes.section(profile, CUT_OPEN[1], -1.0),
        meshes.section(profile, CUT_OPEN[0], 1.0),
    )


def _part(mesh: Mesh, chosen: np.ndarray) -> Mesh:
    return Mesh(mesh.vertices, mesh.normals, mesh.triangles[chosen], mesh.shades)


def stl_bytes(mesh: Mesh) -> bytes:
    """Write a mesh as binary STL, [m], every facet with its corners counterclockwise seen from outside.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    bytes
    """
    corners = mesh.vertices[mesh.triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inwards = np.einsum("ij,ij->i", normal, mesh.normals[mesh.triangles].sum(axis=1)) < 0.0
    corners[inwards] = corners[inwards][:, ::-1]
    normal[inwards] *= -1.0
    size = np.linalg.norm(normal, axis=1)
    whole = size > 0.0
    facets = np.zeros(int(whole.sum()), _FACET)
    facets["normal"], facets["corners"] = normal[whole] / size[whole, None], corners[whole]
    return b"beardyn".ljust(80) + np.uint32(len(facets)).tobytes() + facets.tobytes()


def write_meshes(shape: BearingShape, folder: Path) -> dict[str, Path]:
    """Write the meshes of a bearing into a folder, named after their content; what is there stays.

    Parameters
    ----------
    shape : BearingShape
    folder : Path
        Is made when it does not exist.

    Returns
    -------
    dict of str to Path
        Absolute, by part.

    Raises
    ------
    OSError
        The folder cannot be written.
    """
    folder = folder.expanduser().resolve()
    folder.mkdir(parents=True, exist_ok=True)
    files = {}
    for name, mesh in part_meshes(shape).items():
        content = stl_bytes(mesh)
        path = folder / f"{name}_{hashlib.sha256(content).hexdigest()[:12]}.stl"
        if not path.is_file():
            # several twins may write the same file at once
            draft = path.with_suffix(f".{os.getpid()}")
            draft.write_bytes(content)
            draft.replace(path)
        files[name] = path
    return files


class DescriptionPublisher:
    """Publishes description and frames of one axlebox from the messages of its twin.

    Parameters
    ----------
    node : rclpy.node.Node
    frame : str
        Of the axlebox.
    values : ParameterValues
        With the pose, and whether there is ``/tf``.

    Raises
    ------
    InputError
        The pose is none.
    """

    def __init__(self, node: Any, frame: str, values: Any) -> None:
        self._node, self._frame = node, frame
        pose = pose_from(values.pose_in_parent)
        self._above: list[tuple[str, str, Pose]] = []
        if values.parent_frame:
            self._above = [(values.parent_frame, frame, pose)]
        self._turning: TurningFrames | None = None
        self._names: list[str] = []
        self._description = node.create_publisher(
            message_class("std_msgs/msg/String"), "robot_description", LATCHED
        )
        self._fixed_tf: Any = None
        self._turning_tf: Any = None
        try:
            kind = message_class(TRANSFORMS)
        except ImportError:
            node.get_logger().info("tf2_msgs is not installed: /tf_static and /tf are not published")
            return
        self._fixed_tf = node.create_publisher(kind, "/tf_static", LATCHED)
        if values.joint_tf:
            self._turning_tf = node.create_publisher(kind, "/tf", 100)

    def follow(self, messages: Sequence[tuple[str, bytes]]) -> None:
        """Take what the twin publishes: its truth describes the bearing, its joint states turn it.

        Parameters
        ----------
        messages : sequence of (topic, bytes)
        """
        latest = None
        for name, cdr in messages:
            if name == "truth":
                self._describe(cdr)
            elif name == "joint_states":
                latest = cdr
        if latest is not None and self._turning_tf is not None and self._turning is not None:
            self._turn(latest)

    def _describe(self, truth: bytes) -> None:
        try:
            run = RunDescription.from_json(decode_string(truth))
        except InputError as error:
            self._node.get_logger().warning(f"no robot_description: {error}")
            return
        try:
            files = write_meshes(run.shape, mesh_folder())
        except OSError as error:
            self._node.get_logger().warning(f"robot_description is without meshes: {error}")
            files = {}
        self._description.publish(encode_string(urdf(run, self._frame, files)))
        joints = joints_of(run)
        if self._fixed_tf is not None:
            below = [
                (self._frame, f"{self._frame}/{joint.child}", joint.origin)
                for joint in joints
                if not joint.turns
            ]
            self._fixed_tf.publish(encode_fixed([*self._above, *below]))
        self._names = [joint.name for joint in joints if joint.turns]
        children = [f"{self._frame}/{joint.child}" for joint in joints if joint.turns]
        self._turning = TurningFrames(self._frame, children)

    def _turn(self, joint_states: bytes) -> None:
        assert self._turning is not None
        message = decode(JOINTS, joint_states)
        angles = dict(zip(message.name, message.position, strict=True))
        turned = np.array([angles[name] for name in self._names])
        self._turning_tf.publish(self._turning.encode(header_stamp(joint_states), turned))
