"""Twin and load on one scene: ``ros2 launch beardyn twin.launch.py scene:=cup_spall``.

At the default pace, that of the clock, a scene that names no tier gets one that keeps it. When the load is
replayed every node ends with 0, as on SIGINT; the viewer stays open. The launch ends with 1 when a node has
failed.
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from beardyn_ros.launching import failure_of

ARGUMENTS = (
    ("namespace", "axlebox", "namespace of the axlebox; several twins live side by side"),
    ("scene", "cup_spall", "shipped scene by name, or path of a scene file"),
    ("tier", "scene", "lumped, quasistatic or full; scene: the scene's own"),
    ("effects", "scene", "set or file of effects, or auto; scene: the scene's own, or chosen"),
    ("mode", "lockstep", "lockstep or live: how twin and load talk to each other"),
    ("csv", "", "CSV file of time, speed and force for the load node; empty: the scene's operation"),
    ("speed_factor", "1.0", "simulated seconds per wall second, 0 is as fast as it goes (live: 1)"),
    ("publish_clock", "auto", "true or false: publish /clock; auto: not in live mode, where a train has one"),
    ("load", "true", "start the load node too; false: the load comes from elsewhere"),
    ("recorder", "false", "start the recorder too"),
    ("output", "", "file of the recorder; empty: <scene>_<date>.mcap"),
    ("monitor", "false", "start the monitor too"),
    ("follower", "false", "start the follower too"),
    ("bearing", "HS130x230", "bearing data that monitor and follower read"),
    ("viewer", "false", "open a rerun window too"),
    ("use_sim_time", "false", "clocks of the nodes follow /clock; the results do not depend on it"),
)


def generate_launch_description() -> LaunchDescription:
    namespace = LaunchConfiguration("namespace")

    def text(name: str) -> ParameterValue:
        return ParameterValue(LaunchConfiguration(name), value_type=str)

    def flag(name: str) -> ParameterValue:
        return ParameterValue(LaunchConfiguration(name), value_type=bool)

    def node(name: str, parameters: dict[str, ParameterValue], wanted: str | None = None) -> Node:
        return Node(
            package="beardyn",
            executable=name,
            name=name,
            namespace=namespace,
            parameters=[{**parameters, "use_sim_time": flag("use_sim_time")}],
            condition=IfCondition(LaunchConfiguration(wanted)) if wanted else None,
            output="screen",
        )

    pace = ParameterValue(LaunchConfiguration("speed_factor"), value_type=float)
    twin = {
        "scene": text("scene"),
        "tier": text("tier"),
        "effects": text("effects"),
        "mode": text("mode"),
        "speed_factor": pace,
        "publish_clock": text("publish_clock"),
    }
    nodes = [
        node("twin", twin),
        node(
            "load",
            {"scene": text("scene"), "csv": text("csv"), "mode": text("mode"), "speed_factor": pace},
            "load",
        ),
        node("recorder", {"output": text("output")}, "recorder"),
        node("monitor", {"bearing": text("bearing")}, "monitor"),
        node("follower", {"bearing": text("bearing")}, "follower"),
        node("viewer", {}, "viewer"),
    ]
    arguments = [
        DeclareLaunchArgument(name, default_value=default, description=description)
        for name, default, description in ARGUMENTS
    ]
    return LaunchDescription([*arguments, *failure_of(nodes), *nodes])
