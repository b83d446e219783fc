"""Where the product is described in a sentence, every kind of bearing that a twin runs is named, or none."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from beardyn_core.bearing.roller_bearing import KINDS
from beardyn_core.cli.main import build_parser

ROOT = Path(__file__).resolve().parents[2]
PLACES = {  # file: what comes before its description, and after
    "README.md": ("# beardyn\n", "\n\nIt runs"),
    "CITATION.cff": ("abstract: >-\n", "with faults"),
    "docs/paper/paper.md": ("# Summary\n", "It has faults"),
    "package.xml": ("<description>", "</description>"),
    "setup.py": ('description="', '"'),
    "beardyn_core/record/meshes.py": ('"""', "\n\n"),
}


def check(text: str) -> None:
    assert "bearing" in text
    named = [kind for kind in KINDS if re.search(rf"\b{kind}\b", text)]
    assert named in ([], list(KINDS)), text


@pytest.mark.parametrize("file", PLACES)
def test_a_description_names_all_kinds_that_run(file: str) -> None:
    before, after = PLACES[file]
    text = (ROOT / file).read_text(encoding="utf-8").split(before, 1)[1]
    check(text.split(after, 1)[0])


def test_the_help_names_all_kinds_that_run() -> None:
    check(build_parser().description or "")
