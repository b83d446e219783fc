"""Publishes what RViz shows of an axlebox: ``robot_description``, ``/tf_static`` and, if wanted, ``/tf``.

Late readers get description and fixed frames too (transient-local). tf2_msgs is not among the ROS 2 wheels:
without it the frames stay unpublished, which is said once, and the description is there all the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from beardyn_core.base.errors import InputError
from beardyn_core.record.description import RunDescription
from beardyn_core.record.messages import decode, decode_string, encode_string, header_stamp
from beardyn_core.record.topics import JOINTS
from beardyn_ros.description import joints_of, urdf
from beardyn_ros.parameters import NodeParameter
from beardyn_ros.poses import Pose, pose_from
from beardyn_ros.stl import mesh_folder, write_meshes
from beardyn_ros.transforms import TRANSFORMS, TurningFrames, encode_fixed
from beardyn_ros.wire import message_class

LATCHED = QoSProfile(
    depth=1,
    history=HistoryPolicy.KEEP_LAST,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)

PARENT = NodeParameter(
    "parent_frame", "", "frame that the axlebox stands in, a vehicle's for one; empty: in none"
)
POSE = NodeParameter("pose_in_parent", "", "place there: x y z roll pitch yaw, m and rad; empty: the origin")
DESCRIPTION_PARAMETERS = (
    PARENT,
    POSE,
    NodeParameter(
        "joint_tf",
        False,
        "publish /tf of cone, cages and rollers every 20 ms, where no robot_state_publisher does it",
    ),
)


class DescriptionPublisher:
    """Publishes description and frames of one axlebox from the messages of its twin.

    Parameters
    ----------
    node : rclpy.node.Node
    frame : str
        Of the axlebox.
    values : ParameterValues
        With `DESCRIPTION_PARAMETERS`.

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
