"""The reference page says what the declarations say, of every key there is."""

from __future__ import annotations

import importlib
import re
import sys
from pathlib import Path

import pytest

from beardyn_core.config import SCHEMA_KINDS, json_schema

sys.path.insert(0, str(Path(__file__).parents[2] / "docs"))
write_reference = importlib.import_module("write_reference")
sys.path.pop(0)


def test_the_page_is_that_of_the_declarations() -> None:
    assert write_reference.main(["--check"]) == 0


def test_a_stale_page_is_found(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    stale = tmp_path / "reference.md"
    stale.write_text(write_reference.page().replace("`end_play_mm`", "`end_play`"))
    monkeypatch.setattr(write_reference, "PAGE", stale)
    assert write_reference.main(["--check"]) == 1


def test_every_key_of_every_file_is_on_the_page() -> None:
    page = write_reference.page()
    for kind in SCHEMA_KINDS:
        schema = json_schema(kind)
        for model in (schema, *schema.get("$defs", {}).values()):
            for key in model.get("properties", {}):
                assert f"| `{key}` |" in page, f"{kind}: {key}"


def test_every_link_leads_to_a_heading() -> None:
    page = write_reference.page()
    headings = {
        write_reference._anchor(line.lstrip("# ")) for line in page.splitlines() if line.startswith("#")
    }
    links = set(re.findall(r"\]\(#([^)]+)\)", page))
    assert links
    assert links <= headings
