"""package.xml names what the nodes import, by keys that rosdep knows."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

from beardyn_core.record.topics import TOPICS

ROOT = Path(__file__).resolve().parents[2]
OWN = {"beardyn_core", "beardyn_ros"}
# brought by a package that is named
BROUGHT = {"pydantic_core": "pydantic", "llvmlite": "numba"}
# of an extra, or without a rosdep key: package.xml says so in a comment
FROM_PIP = {
    "mcap", "threadpoolctl", "zstandard",
    "rerun", "matplotlib", "PIL", "gmsh", "skfem", "pyuff", "zarr", "torch", "sklearn", "dask", "distributed",
}  # fmt: skip
# Keys in rosdep/python.yaml of rosdistro, read there. A new dependency is looked up before its key is added.
ROSDEP = {
    "mcap-ros2-support", "python3-colcon-common-extensions", "python3-h5py", "python3-hypothesis",
    "python3-jinja2", "python3-jsonschema", "python3-matplotlib", "python3-numba", "python3-numpy",
    "python3-paho-mqtt", "python3-pandas", "python3-psutil", "python3-pydantic", "python3-pytest",
    "python3-pytest-xdist", "python3-rosbags-pip", "python3-scipy", "python3-setuptools", "python3-sklearn",
    "python3-soundfile", "python3-tqdm", "python3-websockets", "python3-wheel", "python3-yaml",
}  # fmt: skip
# Packages in kilted/distribution.yaml of rosdistro.
ROS_PACKAGES = {
    "ament_index_python", "builtin_interfaces", "diagnostic_msgs", "geometry_msgs", "launch", "launch_ros",
    "lifecycle_msgs", "rcl_interfaces", "rclpy", "rosgraph_msgs", "sensor_msgs", "simulation_interfaces",
    "std_msgs", "std_srvs", "tf2_msgs",
}  # fmt: skip
LATER = re.compile(r"\w+_(msgs|interfaces)(\.\w+)+")
KEYS = {"rosbags": "python3-rosbags-pip"}


def named(*tags: str) -> set[str]:
    """Dependencies of package.xml."""
    package = ElementTree.parse(ROOT / "package.xml").getroot()
    return {str(each.text) for tag in tags for each in package.iter(tag)}


def modules(folder: str) -> Iterator[str]:
    """Top-level modules that the files of a folder import, or name in a string to import later."""
    for path in (ROOT / folder).rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                yield from (each.name.partition(".")[0] for each in node.names)
            elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
                yield node.module.partition(".")[0]
            elif isinstance(node, ast.Constant) and LATER.fullmatch(text := str(node.value)):
                yield text.partition(".")[0]


def test_every_key_is_one_that_rosdep_knows() -> None:
    keys = named("depend", "exec_depend", "test_depend", "build_depend")
    assert keys - ROSDEP - ROS_PACKAGES == set()


def test_every_package_that_nodes_import_is_named() -> None:
    imported = {name for folder in ("beardyn_ros", "launch") for name in modules(folder)}
    assert {"rclpy", "launch_ros", "numpy"} <= imported
    keys = named("exec_depend")
    for name in imported - OWN - FROM_PIP - set(sys.stdlib_module_names):
        assert {name, f"python3-{name}", KEYS.get(name)} & keys, f"{name} is imported and not in package.xml"


def test_every_package_that_the_core_imports_is_named_or_comes_from_pip() -> None:
    keys = named("exec_depend")
    for name in set(modules("beardyn_core")) - OWN - FROM_PIP - set(sys.stdlib_module_names):
        assert {f"python3-{BROUGHT.get(name, name)}", KEYS.get(name)} & keys, f"{name} is not in package.xml"


def test_the_package_of_every_message_is_named() -> None:
    packages = {entry.type.partition("/")[0] for entry in TOPICS}
    assert {"sensor_msgs", "diagnostic_msgs"} <= packages
    assert packages <= named("exec_depend")
