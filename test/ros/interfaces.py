"""Builds ROS interface packages that no registry has: tf2_msgs, simulation_interfaces and beardyn_msgs.

The wheels hold rosidl's generators and headers; gcc does the rest. Only what a test needs is defined here.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import sysconfig
from collections.abc import Mapping
from pathlib import Path

TF2_MSGS = {"msg/TFMessage.msg": "geometry_msgs/TransformStamped[] transforms\n"}
SIMULATION_INTERFACES = {
    "msg/Result.msg": "uint8 RESULT_FEATURE_UNSUPPORTED=0\nuint8 RESULT_OK=1\nuint8 RESULT_NOT_FOUND=2\n"
    "uint8 RESULT_INCORRECT_STATE=3\nuint8 RESULT_OPERATION_FAILED=4\nuint8 result\nstring error_message\n",
    "msg/SimulationState.msg": "uint8 STATE_STOPPED=0\nuint8 STATE_PLAYING=1\nuint8 STATE_PAUSED=2\n"
    "uint8 STATE_QUITTING=3\nuint8 STATE_NO_WORLD=4\nuint8 STATE_LOADING_WORLD=5\nuint8 state\n",
    "msg/SimulatorFeatures.msg": "uint8 SIMULATION_RESET=20\nuint8 SIMULATION_STATE_GETTING=24\n"
    "uint8 SIMULATION_STATE_SETTING=25\nuint8 SIMULATION_STATE_PAUSE=26\nuint8 STEP_SIMULATION_SINGLE=31\n"
    "uint8 STEP_SIMULATION_MULTIPLE=32\nuint16[] features\nstring[] spawn_formats\nstring custom_info\n",
    "srv/GetSimulatorFeatures.srv": "---\nSimulatorFeatures features\n",
    "srv/GetSimulationState.srv": "---\nSimulationState state\nResult result\n",
    "srv/SetSimulationState.srv": "SimulationState state\n---\nuint8 ALREADY_IN_TARGET_STATE=101\n"
    "uint8 STATE_TRANSITION_ERROR=102\nuint8 INCORRECT_TRANSITION=103\nResult result\n",
    "srv/StepSimulation.srv": "uint64 steps 1\n---\nResult result\n",
    "srv/ResetSimulation.srv": "uint8 SCOPE_DEFAULT=0\nuint8 SCOPE_TIME=1\nuint8 SCOPE_STATE=2\n"
    "uint8 SCOPE_SPAWNED=4\nuint8 SCOPE_ALL=255\nuint8 scope\n---\nResult result\n",
}
OWN = Path(__file__).resolve().parents[2] / "interfaces/beardyn_msgs"
BEARDYN_MSGS = {
    path.relative_to(OWN).as_posix(): path.read_text(encoding="utf-8")
    for path in sorted((OWN / "msg").glob("*.msg"))
}
PACKAGES = {
    "tf2_msgs": TF2_MSGS,
    "simulation_interfaces": SIMULATION_INTERFACES,
    "beardyn_msgs": BEARDYN_MSGS,
}
TYPE_SUPPORT = "rosidl_typesupport_c"
FAST = "rosidl_typesupport_fastrtps_c"


def can_build() -> bool:
    """Check whether compiler and headers are there."""
    return shutil.which("g++") is not None and (Path(sys.prefix) / "include" / "rosidl_runtime_c").is_dir()


def build(package: str, definitions: Mapping[str, str], folder: Path) -> None:
    """Generate and compile a package into ``folder/python``, which then belongs on PYTHONPATH."""
    import rosidl_generator_c
    import rosidl_generator_py
    import rosidl_generator_type_description
    import rosidl_typesupport_c
    import rosidl_typesupport_fastrtps_c
    from rosidl_adapter import convert_to_idl
    from rosidl_cli.command.helpers import generate_visibility_control_file

    folder, python = folder / package, folder / "python" / package
    source, made = folder / "source", folder / "made" / package
    prefix = Path(sys.prefix)
    (source).mkdir(parents=True)
    (source / "package.xml").write_text(f"<package format='3'><name>{package}</name></package>")
    tuples = []
    for name, text in definitions.items():
        (source / name).parent.mkdir(exist_ok=True)
        (source / name).write_text(text)
        convert_to_idl(source, package, Path(name), made)
        tuples.append(str(Path(name).with_suffix(".idl")))
    known = [share for share in (prefix / "share").iterdir() if (share / "msg").is_dir()]

    def arguments(generator: str, output: Path) -> str:
        file = folder / f"{generator}.json"
        content = {
            "package_name": package,
            "output_dir": str(output),
            "template_dir": str(prefix / "share" / generator / "resource"),
            "idl_tuples": [f"{made}:{each}" for each in tuples],
            "ros_interface_files": [str(source / name) for name in definitions],
            "include_paths": [f"{share.name}:{share}" for share in known],
            "target_dependencies": [],
            "type_description_tuples": [f"{each}:{(made / each).with_suffix('.json')}" for each in tuples],
        }
        file.write_text(json.dumps(content))
        return str(file)

    for generator in ("rosidl_generator_c", FAST):
        name = f"{generator}__visibility_control.h"
        template = prefix / "share" / generator / "resource" / f"{name}.in"
        generate_visibility_control_file(
            package_name=package, template_path=template, output_path=made / "msg" / name
        )
    rosidl_generator_type_description.generate_type_hash(arguments("rosidl_generator_type_description", made))
    rosidl_generator_c.generate_c(arguments("rosidl_generator_c", made))
    rosidl_typesupport_fastrtps_c.generate_typesupport_fastrtps_c(arguments(FAST, made))
    rosidl_typesupport_c.generate_c(arguments(TYPE_SUPPORT, made), [FAST])
    rosidl_generator_py.generate_py(arguments("rosidl_generator_py", python), [TYPE_SUPPORT])
    _compile(package, folder, made, python, prefix)


def _compile(package: str, folder: Path, made: Path, python: Path, prefix: Path) -> None:
    """Compile everything into the one extension that rclpy imports."""
    import numpy as np

    includes = [
        made.parent,
        prefix / "include",
        sysconfig.get_path("include"),
        np.get_include(),
        *(prefix / "include").iterdir(),
    ]
    libraries = sorted((prefix / "lib").glob("lib*__rosidl_*_c.so"))
    libraries += sorted((prefix / "lib").glob("lib*__rosidl_generator_py.so"))
    libraries += sorted((prefix / "lib").glob("librosidl_*.so"))
    libraries += sorted((prefix / "lib").glob("libfastcdr.so")) + sorted(
        (prefix / "lib").glob("librcutils.so")
    )
    objects: list[Path] = []
    for path in (*sorted(made.rglob("*.c")), *sorted(made.rglob("*.cpp")), *sorted(python.rglob("*.c"))):
        target = folder / f"{len(objects)}.o"
        compiler = ["gcc"] if path.suffix == ".c" else ["g++", "-std=c++17"]
        words = [*compiler, "-c", "-fPIC", "-O0", "-w", str(path), "-o", str(target)]
        subprocess.run([*words, *(f"-I{each}" for each in includes)], check=True)
        objects.append(target)
    (python / "__init__.py").touch()
    extension = python / f"{package}_s__{TYPE_SUPPORT}{sysconfig.get_config_var('EXT_SUFFIX')}"
    link = ["g++", "-shared", "-o", str(extension), *map(str, objects), *map(str, libraries)]
    subprocess.run([*link, f"-Wl,-rpath,{prefix / 'lib'}"], check=True)


if __name__ == "__main__":
    build(sys.argv[1], PACKAGES[sys.argv[1]], Path(sys.argv[2]))
