"""What users read has one word for one thing: phrases that were given up do not come back.

Read are README, pages, reports, their templates, help, schemas, purposes of shipped files, messages (texts in
the code that are no docstrings) and the docstrings of the names of `beardyn_core`.
"""

from __future__ import annotations

import ast
import inspect
import json
import re
from pathlib import Path

import pytest

import beardyn_core as bd
from beardyn_core.cli.main import build_parser
from beardyn_core.config import SCHEMA_KINDS, json_schema

ROOT = Path(__file__).parents[2]
GIVEN_UP = {  # and what is said instead
    r"\bsound(?! Vib)(?<!theory of sound)\b": "healthy",
    r"\b(hears?|heard)\b": "measures, receives, sees",
    r"\b(sensors?|accelerometers?|monitors?|estimators?)( that)? listens?\b": "measures, receives",
    r"\b(tells|told)\b": "reports, states, prints",
    r"\b(says|said)\b(?!\.\*)": "states, reports, names",
    r"\bbeside\b": "next to, with, compared with",
    r"\bname plates?\b": "bearing data",
    r"\bheard less twin\b": "measured minus twin",
    r"\bin \d+ of 100\b": "90 % interval",
    r"\bpreset `?full\b": "preset `all`",
    r"\beffects(=\")? ?full\b": "effects all",
    r"\bexpected errors?\b": "differs from the full model by at most",
    r"\ban accuracy of \d+ %": "within 5 % of the full model",
    r"\bof its variance is explained\b": "not identifiable from these sensors",
    r"\bon trial\b": "benchmark, tried",
    r"\bof before\b": "older, earlier",
}
PAGES = [
    *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md")),
    *sorted((ROOT / "docs").rglob("*.md")),
    *sorted((ROOT / "docs" / "examples").glob("*.py")),
]
TEMPLATES = sorted((ROOT / "evidence").rglob("*.md"))
PURPOSES = sorted((ROOT / "config").rglob("*.yaml"))
SOURCES = sorted(
    path for room in ("beardyn_core", "beardyn_ros", "launch") for path in (ROOT / room).rglob("*.py")
)
KEYS = {"says"}
"""Texts of the code that are keys of JSON and no sentences."""


def given_up(text: str) -> list[str]:
    """What stands in a text, with what is said instead; a line may end within the words."""
    flat = re.sub(r"\s+", " ", text)
    return [
        f"{found[0]}: {better}"
        for words, better in GIVEN_UP.items()
        for found in re.finditer(words, flat, re.I)
    ]


def messages(source: str) -> list[str]:
    """Texts of a module but its docstrings; parts of a formatted one are put together."""
    tree = ast.parse(source)
    docstrings = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef)
        and node.body
        and isinstance(node.body[0], ast.Expr)
    }
    return [
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
        if id(node) not in docstrings and node.value not in KEYS
    ]


def without_names(template: str) -> str:
    """A template without what it fills in."""
    return re.sub(r"\{\{.*?\}\}|\{%.*?%\}", "", template, flags=re.DOTALL)


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_a_page_has_no_phrase_that_was_given_up(page: Path) -> None:
    assert given_up(page.read_text(encoding="utf-8")) == []


def test_templates_have_none() -> None:
    found = {path: given_up(without_names(path.read_text(encoding="utf-8"))) for path in TEMPLATES}
    assert {path.name: words for path, words in found.items() if words} == {}


def test_schemas_and_purposes_have_none() -> None:
    schemas = {kind: given_up(json.dumps(json_schema(kind))) for kind in SCHEMA_KINDS}
    assert {kind: found for kind, found in schemas.items() if found} == {}
    purposes = {
        path.name: given_up(line)
        for path in PURPOSES
        for line in path.read_text(encoding="utf-8").splitlines()
        if line.startswith("purpose:")
    }
    assert {name: found for name, found in purposes.items() if found} == {}


def test_help_has_none() -> None:
    whole = build_parser()
    commands = next(each.choices for each in whole._actions if isinstance(each.choices, dict))
    assert {name: found for name, each in commands.items() if (found := given_up(each.format_help()))} == {}


def test_messages_have_none() -> None:
    found = {
        path.relative_to(ROOT).as_posix(): words
        for path in SOURCES
        if (words := [one for text in messages(path.read_text(encoding="utf-8")) for one in given_up(text)])
    }
    assert found == {}


ROOMS_IN_PLAIN_WORDS = ("physics", "bearing")
OLD_FASHIONED = {  # in docstrings and comments of these rooms, as well as what is given up above
    r"\b(tell|tells|told) (whether|which|how|numba)\b": "check, find, measure",
    r"\b(say|says) (where|why|that|how|of)\b": "state, report",
    r"\b(do|does) not know\b": "is independent of, leaves out",
    r"\b(is|temperature) wanted\b": "given, requested",
    r"\bhastened\b": "accelerated",
}


@pytest.mark.parametrize("room", ROOMS_IN_PLAIN_WORDS)
def test_docstrings_of_the_physics_have_plain_words(room: str) -> None:
    found = {}
    for path in sorted((ROOT / "beardyn_core" / room).rglob("*.py")):
        nodes = ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        kinds = ast.Module | ast.ClassDef | ast.FunctionDef
        texts = [ast.get_docstring(node) or "" for node in nodes if isinstance(node, kinds)]
        whole = re.sub(r"`+[^`]*`+", "", " ".join(texts))  # without names
        odd = [one[0] for words in OLD_FASHIONED for one in re.finditer(words, whole, re.I)]
        if odd := [*odd, *given_up(whole)]:
            found[path.name] = odd
    assert found == {}


def test_the_interface_has_none() -> None:
    names = {name: given_up(inspect.getdoc(getattr(bd, name)) or "") for name in bd.__all__}
    assert {name: found for name, found in names.items() if found} == {}


def test_a_phrase_that_comes_back_is_found_across_lines() -> None:
    assert given_up("Thirty sound\nbearings, and a lever\nof  before") == [
        "sound: healthy",
        "of before: older, earlier",
    ]
    assert given_up("J. Sound Vib. 222; The theory of sound, art. 233; `measured.files[].says.*`") == []
    source = '"""It says so."""\nraise ValueError(f"{path}: nothing says which "\n    "box it is of")\n'
    assert [given_up(text) for text in messages(source)] == [["says: states, reports, names"]]
