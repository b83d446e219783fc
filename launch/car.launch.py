"""Eight axleboxes of a car, one load, one recorder: ``ros2 launch beardyn car.launch.py scene:=smooth_run``.

Each box is a twin in a namespace and a process of its own, ``/car/axle_1_left`` to ``/car/axle_4_right``, the
right ones mirrored, each with another bearing of the lot; `car_twin` has them in one process. Whatever ends
first ends the others in order: after the load the twins finish what they have, after the twins the recorder
closes its files. A node that fails, or goes before it is done, is told, load and twins are stopped, and the
recorder closes its files after them; the launch then ends with 1.
"""

import signal

from launch import LaunchContext, LaunchDescription, LaunchDescriptionEntity
from launch.actions import (
    DeclareLaunchArgument,
    EmitEvent,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
    Shutdown,
    TimerAction,
)
from launch.event_handlers import OnProcessExit
from launch.events import matches_action
from launch.events.process import SignalProcess
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

from beardyn_ros.launching import failure_of

BOXES = " ".join(f"axle_{axle}_{side}" for axle in range(1, 5) for side in ("left", "right"))
HALF_AXLE_M, AXLE_HEIGHT_M = 1.0, 0.46
PATIENCE_S, GRACE_S = 20.0, 5.0

ARGUMENTS = (
    ("namespace", "car", "namespace of the car; those of the boxes are below it"),
    ("boxes", BOXES, "axleboxes: axle_<1 to 4>_<left or right>, axle 1 leads"),
    ("scene", "smooth_run", "scene of every box and of the load, by name or path"),
    ("faulty_box", "", "box that has another scene, such as axle_2_left"),
    (
        "faulty_scene",
        "cup_spall",
        "scene of the faulty box: its bearing and defects; the load stays the car's",
    ),
    ("tier", "lumped", "tier of every twin: lumped, quasistatic, full; scene: the scene's own"),
    ("effects", "scene", "effects of every twin: a set or file, or auto; scene: the scene's own, or chosen"),
    ("csv", "", "CSV file of time, speed and force for the first wheel; empty: the scene's operation"),
    ("duration", "0.0", "simulated time, s; 0: the scene's own"),
    ("speed_factor", "0.0", "simulated seconds per wall second, 0 is as fast as it goes"),
    ("axle_distance", "2.5", "between the axles of a bogie, m"),
    ("bogie_distance", "17.5", "between the centres of the bogies, m"),
    ("recorder", "true", "record every box, a file each"),
    ("output", "car.mcap", "files of the recorder: car_<box>.mcap"),
)


def place_of(box: str, axle_distance: float, bogie_distance: float) -> str:
    """Place of a box in the car: below its middle, x forwards, y left, z up from the top of the rail."""
    axle, left = int(box.split("_")[1]), box.endswith("left")
    bogie, wheel = divmod(axle - 1, 2)
    x = (0.5 - bogie) * bogie_distance + (0.5 - wheel) * axle_distance
    return f"{x:g} {HALF_AXLE_M if left else -HALF_AXLE_M:g} {AXLE_HEIGHT_M:g} 0 0 0"


def start(context: LaunchContext) -> list[LaunchDescriptionEntity]:
    given = {name: LaunchConfiguration(name).perform(context) for name, _, _ in ARGUMENTS}
    car, boxes = given["namespace"].strip("/"), given["boxes"].replace(",", " ").split()
    distances = {name: float(given[name]) for name in ("axle_distance", "bogie_distance")}

    def twin(box: str) -> Node:
        faulty = box == given["faulty_box"]
        return Node(
            package="beardyn",
            executable="twin",
            name="twin",
            namespace=f"{car}/{box}",
            parameters=[
                {
                    "scene": given["faulty_scene" if faulty else "scene"],
                    "box": box,
                    "tier": given["tier"],
                    "effects": given["effects"],
                    "speed_factor": float(given["speed_factor"]),
                    "publish_clock": box == boxes[0],
                    "parent_frame": car,
                    "pose_in_parent": place_of(box, **distances),
                }
            ],
            output="screen",
        )

    twins = [twin(box) for box in boxes]
    load = Node(
        package="beardyn",
        executable="car_load",
        name="load",
        namespace=car,
        parameters=[
            {
                "boxes": " ".join(boxes),
                "wheel_defects_on": boxes[0],
                "scene": given["scene"],
                "csv": given["csv"],
                "duration": float(given["duration"]),
                **distances,
            }
        ],
        output="screen",
    )
    recorder = Node(
        package="beardyn",
        executable="car_recorder",
        name="recorder",
        namespace=car,
        parameters=[{"boxes": " ".join(boxes), "output": given["output"]}],
        output="screen",
    )
    recorders = [recorder] if given["recorder"] == "true" else []
    running = [*twins, load]
    everything = [*running, *recorders]
    ended: set[Node] = set()
    timers: list[TimerAction] = []

    def later(period: float, *actions: LaunchDescriptionEntity) -> TimerAction:
        timers.append(TimerAction(period=period, actions=list(actions)))
        return timers[-1]

    def stop(sentence: str) -> list[LaunchDescriptionEntity]:
        """Interrupt load and twins; the recorder closes its files when they have ended."""
        interrupts = [
            EmitEvent(event=SignalProcess(signal_number=signal.SIGINT, process_matcher=matches_action(node)))
            for node in running
            if node not in ended
        ]
        told = LogInfo(msg=f"{sentence}: the car is stopped")
        return [told, *interrupts, later(PATIENCE_S, Shutdown(reason=sentence))]

    def stop_unrecorded(_context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Stop the twins that go on after the recorder."""
        return [] if ended.issuperset(running) else stop("the recorder has ended before the twins")

    def on_exit(event: object, _context: LaunchContext) -> list[LaunchDescriptionEntity]:
        ended.add(event.action)
        if ended.issuperset(everything):
            for timer in timers:
                timer.cancel()
        elif event.returncode and not timers:
            return stop(f"{event.process_name} has ended with {event.returncode}")
        elif event.action is recorder and not timers:
            # it closes its files on the last word of the twins, which have yet to end
            return [later(GRACE_S, OpaqueFunction(function=stop_unrecorded))]
        return []

    handlers = [
        RegisterEventHandler(OnProcessExit(target_action=node, on_exit=on_exit)) for node in everything
    ]
    return [*failure_of(everything), *handlers, *twins, *recorders, load]


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
