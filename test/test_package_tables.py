"""The table in every package's docstring names each of its modules once, and nothing else."""

from __future__ import annotations

import ast
import re
import tomllib
from collections import Counter
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[1]
ROOTS = ("beardyn_core", "beardyn_ros", "evidence")
PACKAGES = sorted(path.parent for root in ROOTS for path in (REPOSITORY / root).rglob("__init__.py"))
BAR = re.compile(r"(=+) +=+")


def rows_of(docstring: str) -> list[tuple[str, str]]:
    """Module names and responsibilities between the second and the third bar of a table."""
    lines = docstring.splitlines()
    bars = [(number, match) for number, line in enumerate(lines) if (match := BAR.fullmatch(line.strip()))]
    if len(bars) != 3:
        return []
    (_, first), (start, _), (end, _) = bars
    width = len(first[1])
    return [(line[:width].strip(), line[width:].strip()) for line in lines[start + 1 : end]]


def modules_of(package: Path) -> set[str]:
    """Modules and packages inside a package; tests and entry points speak for themselves."""
    modules = {path.stem for path in package.glob("*.py") if not path.name.startswith(("__", "test_"))}
    return modules | {path.parent.name for path in package.glob("*/__init__.py")}


def problems(package: Path) -> list[str]:
    docstring = ast.get_docstring(ast.parse((package / "__init__.py").read_text(encoding="utf-8"))) or ""
    rows = rows_of(docstring)
    if not rows:
        return ["no table of modules: three lines of === with `module  responsibility` between the first two"]
    named, modules = Counter(name for name, _ in rows), modules_of(package)
    return [
        *(f"{name} is not in the table" for name in sorted(modules - set(named))),
        *(f"{name} is in the table and does not exist" for name in sorted(set(named) - modules)),
        *(f"{name} is in the table {count} times" for name, count in named.items() if count > 1),
        *(f"{name} has no responsibility" for name, text in rows if not text),
    ]


@pytest.mark.parametrize("package", PACKAGES, ids=lambda path: path.relative_to(REPOSITORY).as_posix())
def test_table_names_every_module_once_and_nothing_else(package: Path) -> None:
    assert problems(package) == []


def test_every_kind_of_mistake_is_found(tmp_path: Path) -> None:
    for name in ("present", "forgotten", "__main__", "test_present"):
        (tmp_path / f"{name}.py").touch()
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner" / "__init__.py").touch()
    table = "======= ====\nmodule  responsibility\n======= ====\n{}\n======= ===="
    rows = "present is here\npresent twice\ngone    was here\nempty"
    (tmp_path / "__init__.py").write_text(f'"""A package.\n\n{table.format(rows)}\n"""\n')
    (tmp_path / "empty.py").touch()
    assert problems(tmp_path) == [
        "forgotten is not in the table",
        "inner is not in the table",
        "gone is in the table and does not exist",
        "present is in the table 2 times",
        "empty has no responsibility",
    ]
    (tmp_path / "__init__.py").write_text('"""A package without a table."""\n')
    assert len(problems(tmp_path)) == 1


def test_the_table_of_the_core_is_in_the_order_of_imports() -> None:
    core = REPOSITORY / "beardyn_core" / "__init__.py"
    docstring = ast.get_docstring(ast.parse(core.read_text(encoding="utf-8"))) or ""
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))
    layers = project["tool"]["importlinter"]["contracts"][0]["layers"]
    height = {
        name.removeprefix("beardyn_core."): -number
        for number, layer in enumerate(layers)
        for name in re.split(r" [|:] ", layer)
    }
    heights = [height[name] for name, _ in rows_of(docstring)]
    assert heights == sorted(heights)


FOLDERS = sorted(path.parent for path in (REPOSITORY / "evidence").glob("*/__init__.py"))


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda path: path.name)
def test_every_page_has_its_run_its_writer_and_its_test_in_one_folder(folder: Path) -> None:
    assert list(folder.glob("test_*.py"))
    # what is tried with nodes goes into README and docs/evidence/ros.md, which are written by hand
    assert folder.name == "ros" or (folder / "page.py").is_file()


CONTRIBUTING = (REPOSITORY / "CONTRIBUTING.md").read_text(encoding="utf-8")


def first_cells(heading: str) -> set[str]:
    """Names in the first column of the table under a heading."""
    section = CONTRIBUTING.split(f"## {heading}\n")[1].split("\n## ")[0]
    cells = [line.split("|")[1] for line in section.splitlines() if line.startswith("| `")]
    return {name for cell in cells for name in re.findall(r"`([^`]+)`", re.sub(r"\(.*\)", "", cell))}


def test_contributing_names_every_package_and_every_folder_of_tests() -> None:
    rooms = {path.parent.name for path in (REPOSITORY / "beardyn_core").glob("*/__init__.py")}
    folders = {f"test/{path.name}" for path in (REPOSITORY / "test").iterdir() if any(path.glob("test_*.py"))}
    where, tests = first_cells("Where things are"), first_cells("Tests")
    assert rooms | {"beardyn_ros", "evidence", "benchmarks"} <= where
    assert tests == folders | {"evidence/*/test_*.py"}
    for name in where:
        assert any((REPOSITORY / root / name).exists() for root in (".", "beardyn_core")), name
