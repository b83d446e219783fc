"""Gallery and examples: every picture is there and small, every command is one, every example is listed."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from PIL import Image

from beardyn_core.cli.main import build_parser, command_names

DOCS = Path(__file__).parents[2] / "docs"
README = DOCS.parent / "README.md"
GALLERY = (DOCS / "gallery.md").read_text(encoding="utf-8")
LARGEST_MOVING = 1_000_000
SECTION = re.compile(r"^\*\*(.+?)\*\*.*?(?=^\*\*|^## |\Z)", re.MULTILINE | re.DOTALL)


def test_every_section_has_a_sentence_a_picture_and_a_command() -> None:
    sections = list(SECTION.finditer(GALLERY))
    assert len(sections) >= 10
    for each in sections:
        assert re.search(r"!\[.+?\]\(pictures/", each[0]), each[1]
        assert re.search(r"^```\n(beardyn|make) ", each[0], re.MULTILINE), each[1]


def test_every_command_of_the_gallery_is_understood() -> None:
    parser = build_parser()
    commands = [line for line in GALLERY.splitlines() if line.startswith("beardyn ")]
    assert len(commands) >= 8
    for line in commands:
        parser.parse_args(shlex.split(line, comments=True)[1:])


@pytest.mark.parametrize("name", ["crossing", "load_zone"])
def test_a_moving_picture_lasts_five_seconds_and_is_small(name: str) -> None:
    path = DOCS / "pictures" / f"{name}.gif"
    assert path.stat().st_size < LARGEST_MOVING
    lasted = 0
    with Image.open(path) as moving:
        for number in range(moving.n_frames):  # type: ignore[attr-defined]
            moving.seek(number)
            lasted += moving.info["duration"]
        assert moving.info["loop"] == 0
    assert 4_500 <= lasted <= 5_500


def test_the_readme_begins_with_a_moving_picture() -> None:
    first = re.search(r"!\[[^\]]+\]\((\S+)\)", README.read_text(encoding="utf-8"))
    assert first is not None
    assert first[1] == "docs/pictures/crossing.gif"


def test_every_example_is_listed_by_its_task() -> None:
    page = (DOCS / "examples.md").read_text(encoding="utf-8")
    listed = re.findall(r"^\| [^|]+ \| \[[^\]]+\]\(examples/([\w.]+)\) \| [^|]+ \|$", page, re.MULTILINE)
    notebooks = {path.name for path in (DOCS / "examples").glob("*.ipynb")}
    scripts = {path.name for path in (DOCS / "examples").glob("*.py")}
    assert sorted(listed) == sorted(
        notebooks | {name for name in scripts if name.replace(".py", ".ipynb") not in notebooks}
    )


def test_commands_named_in_the_readme_are_there() -> None:
    words = re.findall(r"^beardyn (\w[\w-]*)", README.read_text(encoding="utf-8"), re.MULTILINE)
    assert words
    assert set(words) <= set(command_names())
