"""Twin, load, recorder and monitor on one scene: ``ros2 launch beardyn demo.launch.py scene:=cup_spall``."""

from pathlib import Path

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration


def generate_launch_description() -> LaunchDescription:
    twin = PythonLaunchDescriptionSource(str(Path(__file__).with_name("twin.launch.py")))
    return LaunchDescription(
        [
            DeclareLaunchArgument("scene", default_value="cup_spall", description="scene by name or path"),
            DeclareLaunchArgument("mode", default_value="lockstep", description="lockstep or live"),
            DeclareLaunchArgument("csv", default_value="", description="CSV file replayed as load"),
            DeclareLaunchArgument("output", default_value="run.mcap", description="file of the recorder"),
            DeclareLaunchArgument("use_sim_time", default_value="false", description="clocks follow /clock"),
            IncludeLaunchDescription(
                twin,
                launch_arguments={
                    "scene": LaunchConfiguration("scene"),
                    "mode": LaunchConfiguration("mode"),
                    "csv": LaunchConfiguration("csv"),
                    "output": LaunchConfiguration("output"),
                    "use_sim_time": LaunchConfiguration("use_sim_time"),
                    "speed_factor": "1.0",
                    "recorder": "true",
                    "monitor": "true",
                }.items(),
            ),
        ]
    )
