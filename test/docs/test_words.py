"""What users read has one word for one thing: words that were given up do not come back."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from beardyn_core.cli.main import build_parser
from beardyn_core.config import SCHEMA_KINDS, json_schema

ROOT = Path(__file__).parents[2]
GIVEN_UP = {  # and what is said instead
    r"\bsound (bearings?|scenes?|axlebox(es)?|boxes)\b": "healthy",
    r"\bname plates?\b": "bearing data",
    r"\bheard less twin\b": "measured minus twin",
    r"\bin (50|90) of 100\b": "90 % interval",
    r"\b(sensors?|accelerometers?|microphones?)( that)? (hears?|listens?)\b": "measures, receives",
    r"\bpreset `?full\b": "preset `all`",
    r"\beffects full\b": "effects all",
}
PAGES = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "docs" / "examples").glob("*")]
PURPOSES = sorted((ROOT / "config").rglob("*.yaml"))


def given_up(text: str) -> list[str]:
    """What stands in a text, with what is said instead; a line may end within the words."""
    flat = re.sub(r"\s+", " ", text)
    return [
        f"{found[0]}: {better}"
        for words, better in GIVEN_UP.items()
        for found in re.finditer(words, flat, re.I)
    ]


@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_a_page_has_no_word_that_was_given_up(page: Path) -> None:
    assert given_up(page.read_text(encoding="utf-8")) == []


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


def test_a_word_that_comes_back_is_found_across_lines() -> None:
    assert given_up("Thirty sound\nbearings, and what a sensor  hears") == [
        "sound bearings: healthy",
        "sensor hears: measures, receives",
    ]
    assert given_up("a sound one hears of the tier `full`") == []
