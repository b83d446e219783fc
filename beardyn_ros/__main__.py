"""Start a node without ``ros2``: ``python -m beardyn_ros twin --ros-args -p scene:=smooth_run``."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module

from beardyn_ros.environment import MISSING_ROS, missing_requirements, prepare_environment, ros_available
from beardyn_ros.runtime import EXIT_BAD_INPUT, EXIT_CODES, leave

# where the main function of each is, and what it is for
PROGRAMS = {
    "twin": ("twin_node.main", "simulate the bearing and publish what its sensors read"),
    "load": ("load_node.main", "replay a scene's operation or a CSV as load of the twin"),
    "recorder": ("recorder_node.main", "record every topic into a crash-safe MCAP file"),
    "viewer": ("viewer_node.main", "live view in rerun"),
    "monitor": ("monitor_node.main", "monitoring algorithm on vibration, shaft, load and temperature"),
    "follower": (
        "follower_node.main",
        "load, end play and spall from vibration and shaft, with a twin to compare",
    ),
    "car_twin": ("car.run_twins", "the twins of all axleboxes of a scene, or of a car, in one process"),
    "car_load": ("car.run_loads", "the load of each of these axleboxes from one scenario, all in step"),
    "car_recorder": (
        "car.run_recorders",
        "record each of these axleboxes: one file for those of a scene, else a file each",
    ),
    "demo": ("demo.main", "all of them as separate processes on one scene"),
}


def main(argv: Sequence[str] | None = None) -> int:
    """Run one of `PROGRAMS`; gives the exit code."""
    words = list(sys.argv[1:] if argv is None else argv)
    if not words or words[0] in ("-h", "--help"):
        print(usage())
        return 0 if words else EXIT_BAD_INPUT
    name, rest = words[0], words[1:]
    if name not in PROGRAMS:
        print(f"beardyn: there is no node '{name}', choose one of {', '.join(PROGRAMS)}", file=sys.stderr)
        return EXIT_BAD_INPUT
    prepare_environment()
    if not ros_available():
        print(MISSING_ROS, file=sys.stderr)
        return EXIT_BAD_INPUT
    missing = missing_requirements()
    if missing:
        for sentence in missing:
            print(f"beardyn: {sentence}", file=sys.stderr)
        return EXIT_BAD_INPUT
    if {"-h", "--help"} & set(rest) and name != "demo":
        print(node_help(name))
        return 0
    module, _, function = PROGRAMS[name][0].rpartition(".")
    return int(getattr(import_module(f"beardyn_ros.{module}"), function)(rest))


def usage() -> str:
    """Write the overview of the programs."""
    lines = ["usage: python -m beardyn_ros NODE [--ros-args -p NAME:=VALUE ... --params-file FILE]", ""]
    lines += [f"  {name:12} {purpose}" for name, (_, purpose) in PROGRAMS.items()]
    lines += ["", "exit codes:", *(f"  {code:<9} {meaning}" for code, meaning in EXIT_CODES.items())]
    return "\n".join([*lines, "", "`python -m beardyn_ros NODE --help` lists a node's parameters."])


def node_help(name: str) -> str:
    """Describe the parameters of a node, from its table."""
    from beardyn_ros.node_parameters import PARAMETERS

    lines = [f"{name}: {PROGRAMS[name][1]}", "", "parameters (--ros-args -p NAME:=VALUE):"]
    for parameter in PARAMETERS[name]:
        notes = [parameter.type_name, f"default {parameter.default!r}"]
        if parameter.choices:
            notes.append("one of " + ", ".join(parameter.choices))
        elif parameter.allowed_range != "no range":
            notes.append(parameter.allowed_range)
        elif parameter.unit:
            notes.append(parameter.unit)
        lines.append(f"  {parameter.name:16} {parameter.description} ({'; '.join(notes)})")
    return "\n".join(lines)


if __name__ == "__main__":
    leave(main())
