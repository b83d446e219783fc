"""Every effect has its file, its entry in the catalogue and its place on the page."""

from __future__ import annotations

import runpy
from dataclasses import fields
from pathlib import Path

import pytest

from beardyn_core.effects import EffectSet
from beardyn_core.effects.catalogue import Entry, catalogue

ROOT = Path(__file__).parents[2]


def test_every_member_of_an_effect_set_is_in_the_catalogue() -> None:
    assert {entry.member for entry in catalogue()} == {field.name for field in fields(EffectSet)}


@pytest.mark.parametrize("entry", catalogue(), ids=lambda entry: entry.options.__name__)
def test_entry_says_everything(entry: Entry) -> None:
    about = entry.about
    assert about.cost in ("none", "low", "medium", "high")
    for text in (about.adds, about.states, about.validity, about.source):
        assert text
    assert entry.options.__module__.startswith("beardyn_core.effects.")


def test_page_is_written_from_the_current_catalogue() -> None:
    written = runpy.run_path(str(ROOT / "docs" / "write_effects.py"))["page"]()
    assert (ROOT / "docs" / "effects.md").read_text(encoding="utf-8") == written, (
        "run python docs/write_effects.py"
    )
