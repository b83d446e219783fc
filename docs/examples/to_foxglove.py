# to_foxglove.py [PORT]: topics of one axlebox to Foxglove, served as foxglove_bridge serves them
import sys
from importlib import import_module

import foxglove
import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosbags.typesys import Stores, get_typestore

from beardyn_core.record.topics import TOPICS

definitions = get_typestore(Stores.ROS2_KILTED)
server = foxglove.start_server(name="beardyn", port=int(sys.argv[1]) if len(sys.argv) > 1 else 8765)
rclpy.init()
node = rclpy.create_node("to_foxglove")
for entry in TOPICS:
    text, _ = definitions.generate_msgdef(entry.type, ros_version=2)
    schema = foxglove.Schema(name=entry.type, encoding="ros2msg", data=text.encode())
    channel = foxglove.Channel(entry.path(), schema=schema, message_encoding="cdr")
    package, _, kind = entry.type.split("/")
    qos = QoSProfile(
        depth=entry.depth or 1000,
        reliability=ReliabilityPolicy[entry.reliability.upper()],
        durability=DurabilityPolicy[entry.durability.upper()],
    )
    node.create_subscription(
        getattr(import_module(f"{package}.msg"), kind), entry.path(), channel.log, qos, raw=True
    )
rclpy.spin(node)
