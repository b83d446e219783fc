"""The forms of the issue tracker ask for what an answer needs, and name commands and pages that there are."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
import yaml

from beardyn_core.cli.main import build_parser, command_names

ROOT = Path(__file__).parents[2]
FORMS = sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("[!c]*.yml"))
KINDS = {"textarea", "checkboxes"}
ASKED = {"version", "scene", "output"}


def form(path: Path) -> dict[str, Any]:
    found: dict[str, Any] = yaml.safe_load(path.read_text(encoding="utf-8"))
    return found


def test_there_is_a_form_for_a_bug_a_wrong_answer_and_a_question() -> None:
    assert [path.stem for path in FORMS] == ["bug_report", "question", "wrong_answer"]
    page = (ROOT / "docs" / "support.md").read_text(encoding="utf-8").partition("## Where to ask")[2]
    for path in FORMS:
        assert form(path)["name"].lower() in page


@pytest.mark.parametrize("path", FORMS, ids=lambda path: path.stem)
def test_a_form_asks_for_version_scene_and_output(path: Path) -> None:
    whole = form(path)
    assert set(whole) == {"name", "description", "labels", "body"}
    fields = {each["id"]: each for each in whole["body"]}
    assert len(fields) == len(whole["body"])
    assert set(fields) >= ASKED
    assert {each["type"] for each in fields.values()} <= KINDS
    for each in fields.values():
        assert each["attributes"]["label"]
    needed = {name for name, each in fields.items() if each.get("validations", {}).get("required")}
    assert needed >= ({"version", "task"} if path.stem == "question" else ASKED)


@pytest.mark.parametrize("path", FORMS, ids=lambda path: path.stem)
def test_what_a_form_names_is_there(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    words = re.findall(r"`beardyn ([\w-]+)", text)
    assert words
    assert set(words) - {"--version"} <= set(command_names())
    assert "--version" in build_parser().format_help()
    for page in re.findall(r"docs/\w+\.md", text):
        assert (ROOT / page).is_file()
