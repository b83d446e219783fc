"""The draft of the paper claims nothing without a command that is there, and cites what it lists."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path

from beardyn_core.config import shipped_names

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "docs" / "paper"
TEXT = (FOLDER / "paper.md").read_text(encoding="utf-8")
ROWS = [
    [cell.strip() for cell in line.strip("|").split("|")]
    for line in TEXT.splitlines()
    if line.startswith("|") and not line.startswith(("|---", "| claim"))
]


def test_every_claim_has_a_command_of_the_repository_and_a_page() -> None:
    targets = re.findall(r"^([a-z-]+):.*## ", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    assert len(ROWS) >= 10
    for claim, command, page in ROWS:
        words = command.strip("`").split()
        if words[0] == "make":
            assert words[1] in targets, claim
        elif words[0] == "beardyn":
            assert words[1] == "trial", claim
            assert words[2] in shipped_names("trials"), claim
        elif words[0] == "python":
            assert importlib.util.find_spec(words[2]) is not None, claim
        else:
            assert words[0] == "pytest", claim
            assert (ROOT / words[1]).is_dir(), claim
        assert (ROOT / page.strip("`")).is_file(), claim


def test_every_page_that_is_named_is_there() -> None:
    for name in re.findall(r"`((?:docs|test)/[\w./]+)`", TEXT):
        assert (ROOT / name).exists(), name


def test_citations_and_references_are_the_same() -> None:
    cited = set(re.findall(r"@([A-Z]\w+\d{4})", TEXT))
    listed = set(
        re.findall(r"^@\w+\{(\w+),", (FOLDER / "paper.bib").read_text(encoding="utf-8"), re.MULTILINE)
    )
    assert cited == listed


def test_no_author_is_made_up() -> None:
    authors = TEXT.split("authors:\n")[1].split("date:")[0]
    assert re.findall(r"name: (.*)", authors) == ["beardyn developers"]
