"""Runs a launch file with `launch` and `launch_ros` themselves.

``python -m test.ros.real_launch FILE name:=value``
"""

from __future__ import annotations

import importlib.util
import sys
import types
from collections.abc import Sequence
from importlib import import_module
from typing import Any

from beardyn_ros.environment import prepare_environment
from test.ros.launch_stand_in import FOLDER


def main(words: Sequence[str]) -> int:
    """Run a file of the launch folder; gives the exit code of ``ros2 launch``."""
    prepare_environment()
    if importlib.util.find_spec("composition_interfaces") is None:
        # launch_ros imports it for containers of components, which no launch file here has
        package, services = (types.ModuleType(f"composition_interfaces{end}") for end in ("", ".srv"))
        services.LoadNode = types.SimpleNamespace(Request=object, Response=object)  # type: ignore[attr-defined]
        package.srv = services  # type: ignore[attr-defined]
        sys.modules |= {package.__name__: package, services.__name__: services}
    launch: Any = import_module("launch")
    include: Any = import_module("launch.actions").IncludeLaunchDescription
    source: Any = import_module("launch.launch_description_sources").PythonLaunchDescriptionSource
    file, *given = words
    arguments = [tuple(word.split(":=", 1)) for word in given]
    service = launch.LaunchService()
    service.include_launch_description(
        launch.LaunchDescription([include(source(str(FOLDER / file)), launch_arguments=arguments)])
    )
    return int(service.run())


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
