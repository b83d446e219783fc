"""Launch files: launch_ros is in no package registry, so they are read, not run."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from beardyn_ros.__main__ import PROGRAMS
from beardyn_ros.node_parameters import PARAMETERS

FOLDER = Path(__file__).parents[2] / "launch"


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.launch.py")), ids=lambda path: path.name)
def test_launch_file_compiles_and_describes_a_launch(path: Path) -> None:
    tree = ast.parse(path.read_text(), str(path))
    compile(tree, str(path), "exec")
    assert "generate_launch_description" in [
        node.name for node in tree.body if isinstance(node, ast.FunctionDef)
    ]


def test_twin_launch_starts_existing_nodes_with_declared_parameters() -> None:
    tree = ast.parse((FOLDER / "twin.launch.py").read_text())
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    started = {}
    for call in calls:
        if isinstance(call.func, ast.Name) and call.func.id == "node":
            parameters = call.args[1]
            name = ast.literal_eval(call.args[0])
            keys = parameters.keys if isinstance(parameters, ast.Dict) else []
            started[name] = {ast.literal_eval(key) for key in keys if key is not None}
    assert set(started) == {"twin", "load", "recorder", "monitor", "viewer"} <= set(PROGRAMS)
    for name, given in started.items():
        declared = {parameter.name for parameter in PARAMETERS[name]}
        assert given <= declared
