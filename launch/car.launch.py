"""The axleboxes of a scene, or the eight of a car: ``ros2 launch beardyn car.launch.py scene:=bogie``.

A scene with ``axleboxes`` says which there are, which are faulty and how far apart: node `car_twin` has the
twins of all in one process, and one recorder writes one file. Any other scene is that of every box of a car,
each a twin in a process of its own, and a file each. Namespaces are ``/car/axle_1_left`` and so on; right
boxes are mirrored, each has another bearing of the lot. Whatever ends first ends the others in order:
after the load the twins finish what they have, after the twins the recorder closes its files, and the
monitors and followers of the boxes, where they are asked for, say their last words. A node that
fails, or goes before it is done, is told, load and twins are stopped, and the recorder closes its files after
them; the launch then ends with 1.
"""

import signal
from dataclasses import replace

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

from beardyn_core.base.errors import InputError
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.scene.axleboxes import Box
from beardyn_ros.launching import LISTENERS, failure_of, listeners_of, read_switches
from beardyn_ros.rig import CAR, axleboxes_of, boxes_named, place_of

PATIENCE_S, GRACE_S = 20.0, 5.0

ARGUMENTS = (
    ("namespace", "car", "namespace of the car; those of the boxes are below it"),
    ("boxes", "", "some of the axleboxes: axle_<number>_<left or right>, axle 1 leads; empty: all of them"),
    ("scene", "smooth_run", "scene of every box and of the load, by name or path"),
    ("faulty_box", "", "box that has another scene, such as axle_2_left; not with a scene with axleboxes"),
    (
        "faulty_scene",
        "cup_spall",
        "scene of the faulty box: its bearing and defects; the load stays the car's",
    ),
    (
        "tier",
        "",
        "tier of every twin: lumped, quasistatic, full; scene: the scene's own; empty: lumped, of a scene "
        "with axleboxes its own",
    ),
    ("effects", "scene", "effects of every twin: a set or file, or auto; scene: the scene's own, or chosen"),
    ("csv", "", "CSV file of time, speed and force for the first wheel; empty: the scene's operation"),
    ("duration", "0.0", "simulated time, s; 0: the scene's own"),
    ("speed_factor", "0.0", "simulated seconds per wall second, 0 is as fast as it goes"),
    ("axle_distance", "", "between the axles of a bogie, m; empty: 2.5; not with a scene with axleboxes"),
    (
        "bogie_distance",
        "",
        "between the centres of the bogies, m; empty: 17.5; not with a scene with axleboxes",
    ),
    ("publish_clock", "true", "publish /clock; one car of several"),
    ("use_sim_time", "false", "clocks of the nodes follow /clock; the results do not depend on it"),
    ("monitor", "false", "start a monitor of every box"),
    ("follower", "false", "start a follower of every box"),
    ("bearing", "HS130x230", "bearing data that monitors and followers read"),
    ("recorder", "true", "record every box"),
    (
        "output",
        "car.mcap",
        "file of the recorder; of a scene without axleboxes it has one a box, car_<box>.mcap",
    ),
)
SAID_BY_AXLEBOXES = ("faulty_box", "axle_distance", "bogie_distance")


def process(executable: str, name: str, namespace: str, **parameters: object) -> Node:
    return Node(
        package="beardyn",
        executable=executable,
        name=name,
        namespace=namespace,
        parameters=[parameters],
        output="screen",
    )


def twins_of_the_scene(car: str, given: dict[str, str], **of_all: object) -> list[Node]:
    """Make the one process that takes the axleboxes of the scene as they are."""
    if said := [name for name in SAID_BY_AXLEBOXES if given[name]]:
        raise InputError(
            f"scene {given['scene']}: its axleboxes set what {', '.join(said)} would; leave that out, or "
            "change the scene"
        )
    words = {name: given[name] for name in ("scene", "boxes")}
    return [process("car_twin", "twin", car, **words, tier=given["tier"] or "scene", **of_all)]


def twins_of_a_car(
    car: str,
    given: dict[str, str],
    boxes: tuple[Box, ...],
    distances: dict[str, float],
    clock: bool,
    **of_all: object,
) -> list[Node]:
    """Make a process for each box, with the place of that box; one of them perhaps has another scene."""
    return [
        process(
            "twin",
            "twin",
            f"{car}/{box.name}",
            scene=given["faulty_scene" if box.name == given["faulty_box"] else "scene"],
            box=box.name,
            tier=given["tier"] or "lumped",
            publish_clock=clock and box is boxes[0],
            parent_frame=car,
            pose_in_parent=place_of(replace(CAR, **distances), box),
            **of_all,
        )
        for box in boxes
    ]


def start(context: LaunchContext) -> list[LaunchDescriptionEntity]:
    given = {name: LaunchConfiguration(name).perform(context) for name, _, _ in ARGUMENTS}
    car = given["namespace"].strip("/")
    switches = read_switches(given, *LISTENERS, "publish_clock", "use_sim_time")
    clocks = {"use_sim_time": switches["use_sim_time"]}
    of_all = {"effects": given["effects"], "speed_factor": float(given["speed_factor"]), **clocks}
    of_load: dict[str, object] = {"csv": given["csv"], "duration": float(given["duration"]), **clocks}
    clock = switches["publish_clock"]
    # the nodes check the scene; this looks only whether axleboxes are there
    if read_file(find("scenes", given["scene"])).get("axleboxes") is not None:
        twins = twins_of_the_scene(car, given, publish_clock=clock, **of_all)
        boxes = boxes_named(given["boxes"], axleboxes_of(given["scene"]) or CAR)
    else:
        distances = {name: float(given[name]) for name in ("axle_distance", "bogie_distance") if given[name]}
        boxes = boxes_named(given["boxes"])
        twins = twins_of_a_car(car, given, boxes, distances, clock, **of_all)
        of_load |= {"wheel_defects_on": boxes[0].name, **distances}
    words = {name: given[name] for name in ("scene", "boxes")}
    load = process("car_load", "load", car, **words, **of_load, wait_for=listeners_of(switches))
    recorder = process("car_recorder", "recorder", car, **words, **clocks, output=given["output"])
    recorders = [recorder] if switches["recorder"] else []
    judges = [
        process(name, name, f"{car}/{box.name}", bearing=given["bearing"], **clocks)
        for name in ("monitor", "follower")
        if switches[name]
        for box in boxes
    ]
    running = [*twins, load]
    everything = [*running, *recorders, *judges]
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
    return [*failure_of(everything), *handlers, *twins, *recorders, *judges, load]


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
