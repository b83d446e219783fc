"""The bearing in its box as URDF: links, joints and frames, from the description of a run.

Joints are called as in ``joint_states``: ``shaft`` turns the cone, ``cage_<row>`` and ``roller_<row>_<k>`` go
round with it. Links are called as their frames, below the frame of the box, so that several boxes stand in
one view.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from math import atan2, cos, sin
from pathlib import Path
from xml.etree import ElementTree

from beardyn_core.base.errors import InputError
from beardyn_core.config.yaml_text import read_mapping
from beardyn_core.physics.thermal import NODES
from beardyn_core.record.description import RunDescription
from beardyn_core.record.encoding import orbit_joints
from beardyn_core.record.meshes import ROW_SIDE
from beardyn_ros.poses import ORIGIN, Pose

COLOURS = {
    "box": "0.35 0.42 0.50 1",
    "cup": "0.59 0.64 0.72 1",
    "cone": "0.48 0.53 0.63 1",
    "cage": "0.25 0.59 0.55 1",
    "roller": "0.85 0.86 0.88 1",
    "mark": "0.15 0.16 0.18 1",
}


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
