"""Libraries that are imported by name, which `lint-imports` does not see, stay where they belong as well."""

from __future__ import annotations

import ast
import tomllib
from collections.abc import Iterator
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[1]
FUNCTIONS = {"library", "import_module"}
# what nobody imports otherwise; the contracts in pyproject.toml have the rest
HOMES = {
    "cma": {
        "beardyn_core.calibration",
        "beardyn_core.api.calibrating",
    },  # the latter asks whether it is there
    "h5py": {"beardyn_core.record", "beardyn_core.measured", "beardyn_core.population"},
    "pyarrow": {"beardyn_core.record", "beardyn_core.measured", "beardyn_core.population"},
    "pandas": {"beardyn_core.record", "beardyn_core.population"},
    "xarray": {"beardyn_core.record", "beardyn_core.population"},
    "asammdf": {"beardyn_core.measured"},
    "nptdms": {"beardyn_core.measured"},
    "soundfile": {"beardyn_core.measured"},
    "pyuff": {"beardyn_core.measured"},
}
ASKS = {
    "beardyn_ros.viewer_node": {"rerun"}
}  # whether it is there, before a viewer starts in its own process


def protected() -> dict[str, set[str]]:
    """Who may import a library, by its name."""
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))
    contracts = project["tool"]["importlinter"]["contracts"]
    return HOMES | {
        name: set(each["allowed_importers"])
        for each in contracts
        if each["type"] == "protected"
        for name in each["protected_modules"]
    }


def named_libraries(text: str) -> Iterator[str]:
    """Names of modules in calls of `library` and `import_module`."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call) and node.args and isinstance(node.args[0], ast.Constant):
            called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            if called in FUNCTIONS:
                yield str(node.args[0].value).split(".")[0]


def strays(module: str, text: str) -> list[str]:
    """Libraries that a module of the project takes by name though it may not."""
    homes = protected()
    return [
        name
        for name in named_libraries(text)
        if name in homes
        and name not in ASKS.get(module, set())
        and not any(f"{module}.".startswith(f"{home}.") for home in homes[name])
    ]


def test_a_library_that_is_imported_by_name_stays_in_its_package() -> None:
    found = {}
    for root in ("beardyn_core", "beardyn_ros"):
        for path in (REPOSITORY / root).rglob("*.py"):
            module = ".".join(path.relative_to(REPOSITORY).with_suffix("").parts)
            found[module] = strays(module, path.read_text(encoding="utf-8"))
    assert {module: names for module, names in found.items() if names} == {}


def test_a_stray_is_found() -> None:
    text = 'import importlib\nlibrary("cma", "a run", "x")\nimportlib.import_module("zarr.storage")\n'
    assert strays("beardyn_core.sensors.block", text) == ["cma", "zarr"]
    assert strays("beardyn_core.calibration.search", text) == ["zarr"]
    assert strays("beardyn_core.population.table", text) == ["cma"]
