"""Templates get every number that they name, and no other."""

from __future__ import annotations

from pathlib import Path

import pytest

from evidence.pages import render, replace_between, with_section
from evidence.tables import markdown

ROOT = Path(__file__).parent
TEMPLATE = """# Loads

Up to {{ load | as(".1f") }} kN.

| case | kN |
|---|--:|
{{ cells | rows }}
{% if note %}

{{ note }}
{% endif %}
"""


@pytest.fixture
def module(tmp_path: Path) -> Path:
    (tmp_path / "page.md").write_text(TEMPLATE, encoding="utf-8")
    return tmp_path / "page.py"


def test_numbers_and_rows_stand_in_their_places(module: Path) -> None:
    values = {"load": 2.345, "cells": [("one", 1), ("two", 2)], "note": ""}
    head = "# Loads\n\nUp to 2.3 kN.\n\n| case | kN |\n|---|--:|\n| one | 1 |\n| two | 2 |\n"
    assert render(module, values) == head
    assert render(module, {**values, "note": "Both {{ held }}."}) == f"{head}\nBoth {{{{ held }}}}.\n"


def test_a_name_without_a_number_or_a_place_is_an_error(module: Path) -> None:
    with pytest.raises(ValueError, match="cells has no value; note has no value; speed has no place"):
        render(module, {"load": 1.0, "speed": 2.0})


def test_a_number_that_a_part_of_a_value_lacks_is_an_error(module: Path) -> None:
    module.with_suffix(".md").write_text("{{ machine.name }}\n", encoding="utf-8")
    with pytest.raises(Exception, match="has no attribute 'name'"):
        render(module, {"machine": {"cores": 2}})


def test_every_template_belongs_to_a_module_of_its_room() -> None:
    templates = sorted(ROOT.rglob("*.md"))
    assert len(templates) > 20
    for template in templates:
        own = template.with_suffix(".py")
        modules = {path: path.read_text(encoding="utf-8") for path in template.parent.glob("*.py")}
        by_itself = own in modules and "(__file__, " in modules[own]
        assert by_itself or any(f'"{template.name}"' in text for text in modules.values()), template


def test_a_table_has_a_rule_for_each_column() -> None:
    assert markdown(("a", "b", "c"), [("1", 2, 3.5)], "lr") == "| a | b | c |\n|---|--:|--:|\n| 1 | 2 | 3.5 |"
    assert markdown(("a", "b"), []) == "| a | b |\n|---|---|"


def test_a_part_of_a_page_is_replaced_and_the_rest_stays() -> None:
    assert replace_between("a<b>old<e>z", "<b>", "<e>", "new") == "a<b>new<e>z"
    page = "# P\n\n## One\nx\n\n## Two\ny\n"
    assert with_section(page, "## One\n", "## One\nz\n\n", "## Two\n") == page.replace("x", "z")
    assert with_section(page, "## New\n", "## New\n\n", "## Two\n") == page.replace(
        "## Two", "## New\n\n## Two"
    )
