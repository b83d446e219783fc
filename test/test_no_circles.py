"""No file leads back to itself by its imports, those inside functions included."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = ("beardyn_core", "beardyn_ros")
# (from, to): a method of a noun that asks what is built on it; none at import
ASKED = {
    ("beardyn_core.population.torch_data", "beardyn_core.population.labelled_set"),
}


def modules() -> dict[str, Path]:
    paths = [path for package in PACKAGES for path in (ROOT / package).rglob("*.py")]
    return {
        ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__"): path
        for path in paths
    }


def imported(text: str, known: set[str]) -> Iterator[str]:
    """Modules of the project that a file imports, but for types alone."""
    tree = ast.parse(text)
    typed = {
        id(node)
        for block in ast.walk(tree)
        if isinstance(block, ast.If) and "TYPE_CHECKING" in ast.unparse(block.test)
        for node in ast.walk(block)
    }
    for node in ast.walk(tree):
        if id(node) in typed:
            continue
        if isinstance(node, ast.Import):
            yield from (each.name for each in node.names if each.name in known)
        elif isinstance(node, ast.ImportFrom) and node.module in known:
            for each in node.names:
                inner = f"{node.module}.{each.name}"
                yield inner if inner in known else node.module


def circle(files: dict[str, str], allowed: set[tuple[str, str]]) -> list[str]:
    """The first circle there is, empty when there is none."""
    graph = {
        name: {each for each in imported(text, set(files)) if each != name and (name, each) not in allowed}
        for name, text in files.items()
    }
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        found: list[str] = error.args[1]
        return found
    return []


def test_no_file_leads_back_to_itself() -> None:
    files = {name: path.read_text(encoding="utf-8") for name, path in modules().items()}
    assert circle(files, ASKED) == []


@pytest.mark.parametrize("asked", sorted(ASKED))
def test_what_is_allowed_is_needed(asked: tuple[str, str]) -> None:
    files = {name: path.read_text(encoding="utf-8") for name, path in modules().items()}
    assert circle(files, ASKED - {asked}) != []


def test_a_circle_is_found_also_inside_of_a_function() -> None:
    files = {"a": "from b import f\n", "b": "def f():\n    import c\n", "c": "from a import g\n"}
    assert set(circle(files, set())) == {"a", "b", "c"}
    assert circle({**files, "c": "if TYPE_CHECKING:\n    from a import g\n"}, set()) == []
