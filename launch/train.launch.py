"""The axleboxes of several cars: ``ros2 launch beardyn train.launch.py cars:=2``.

Each car is a `car.launch.py` in a namespace of its own, ``/train/car_1`` and so on, with a load, twins and a
recording of its own; the first car publishes ``/clock``. Each rides as if it were the first: the distance
between cars delays nothing. At a pace above 0 the cars stay together, at 0 each is as fast as it goes. A car
that fails stops itself, and no other car; the launch ends with 1 when all have ended.
"""

from pathlib import Path

from launch import LaunchContext, LaunchDescription, LaunchDescriptionEntity
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, OpaqueFunction
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration

from beardyn_core.base.errors import InputError

MOST_CARS = 20
ARGUMENTS = (
    ("namespace", "train", "namespace of the train; those of the cars are below it"),
    ("cars", "2", f"how many cars there are, 1 to {MOST_CARS}"),
    ("boxes", "", "some of the axleboxes of every car: axle_<number>_<left or right>; empty: all of them"),
    ("scene", "smooth_run", "scene of every box and of the load, by name or path"),
    ("faulty_box", "", "box that has another scene, such as car_2/axle_2_left"),
    ("faulty_scene", "cup_spall", "scene of the faulty box"),
    ("tier", "", "tier of every twin, as in car.launch.py"),
    ("effects", "scene", "effects of every twin: a set or file, or auto; scene: the scene's own, or chosen"),
    ("csv", "", "CSV file of time, speed and force for the first wheel of each car"),
    ("duration", "0.0", "simulated time, s; 0: the scene's own"),
    ("speed_factor", "1.0", "simulated seconds per wall second, 0 is as fast as it goes"),
    ("use_sim_time", "false", "clocks of the nodes follow /clock"),
    ("monitor", "false", "start a monitor of every box"),
    ("follower", "false", "start a follower of every box"),
    ("bearing", "HS130x230", "bearing data that monitors and followers read"),
    ("recorder", "true", "record every box"),
    ("output", "train.mcap", "file of the recorders; car 1 has train_car_1.mcap, or a file a box"),
)
SAME = (
    "boxes",
    "scene",
    "faulty_scene",
    "tier",
    "effects",
    "csv",
    "duration",
    "speed_factor",
    "use_sim_time",
    "monitor",
    "follower",
    "bearing",
)


def start(context: LaunchContext) -> list[LaunchDescriptionEntity]:
    given = {name: LaunchConfiguration(name).perform(context) for name, _, _ in ARGUMENTS}
    if not (given["cars"].isdecimal() and 1 <= int(given["cars"]) <= MOST_CARS):
        raise InputError(f"cars {given['cars']}: allowed are 1 to {MOST_CARS}")
    train, output = given["namespace"].strip("/"), Path(given["output"])
    cars = [f"car_{number + 1}" for number in range(int(given["cars"]))]
    faulty_car, _, faulty_box = given["faulty_box"].rpartition("/")
    if given["faulty_box"] and faulty_car not in cars:
        raise InputError(
            f"faulty_box {given['faulty_box']}: give car and box, such as {cars[-1]}/axle_2_left"
        )
    source = PythonLaunchDescriptionSource(str(Path(__file__).with_name("car.launch.py")))
    # every argument is given: one that is left out has the value of the car before
    return [
        IncludeLaunchDescription(
            source,
            launch_arguments={
                **{name: given[name] for name in SAME},
                "namespace": f"{train}/{car}",
                "faulty_box": faulty_box if car == faulty_car else "",
                "axle_distance": "",
                "bogie_distance": "",
                "publish_clock": str(car == cars[0]).lower(),
                "output": str(output.with_stem(f"{output.stem}_{car}")),
            }.items(),
        )
        for car in cars
    ]


def generate_launch_description() -> LaunchDescription:
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=default, description=description)
                for name, default, description in ARGUMENTS
            ),
            OpaqueFunction(function=start),
        ]
    )
