"""Twin and load on one scene: ``ros2 launch beardyn twin.launch.py scene:=cup_spall``.

At the default pace, that of the clock, a scene that names no tier gets one that keeps it. When the load is
replayed every node ends with 0, as on SIGINT; the viewer stays open. The launch ends with 1 when a node has
failed.
"""

from launch import LaunchContext, LaunchDescription, LaunchDescriptionEntity
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from beardyn_ros.launching import LISTENERS, failure_of, listeners_of, read_switches

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


SWITCHES = (*LISTENERS, "load", "viewer", "use_sim_time")


def start(context: LaunchContext) -> list[LaunchDescriptionEntity]:
    given = {name: LaunchConfiguration(name).perform(context) for name, _, _ in ARGUMENTS}
    switches = read_switches(given, *SWITCHES)

    def node(name: str, parameters: dict[str, object]) -> Node:
        return Node(
            package="beardyn",
            executable=name,
            name=name,
            namespace=given["namespace"],
            parameters=[{**parameters, "use_sim_time": switches["use_sim_time"]}],
            output="screen",
        )

    def text(value: str) -> ParameterValue:
        return ParameterValue(value, value_type=str)  # else it is read as YAML

    def of(*names: str) -> dict[str, object]:
        return {name: text(given[name]) for name in names}

    pace = {"speed_factor": float(given["speed_factor"])}
    nodes = {
        "twin": node("twin", of("scene", "tier", "effects", "mode", "publish_clock") | pace),
        "load": node("load", of("scene", "csv", "mode") | pace | {"wait_for": text(listeners_of(switches))}),
        "recorder": node("recorder", of("output")),
        "monitor": node("monitor", of("bearing")),
        "follower": node("follower", of("bearing")),
        "viewer": node("viewer", {}),
    }
    wanted = [each for name, each in nodes.items() if switches.get(name, True)]
    return [*failure_of(wanted), *wanted]


def generate_launch_description() -> LaunchDescription:
    arguments = [
        DeclareLaunchArgument(name, default_value=default, description=description)
        for name, default, description in ARGUMENTS
    ]
    return LaunchDescription([*arguments, OpaqueFunction(function=start)])
