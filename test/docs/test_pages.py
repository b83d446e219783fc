"""Pages lead somewhere: every link, every page in the site, every name of the interface; the site builds."""

from __future__ import annotations

import importlib
import re
import subprocess
import sys
from pathlib import Path

import pytest

import beardyn_core as bd

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
OUTSIDE = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md")]
PAGES = sorted([*DOCS.glob("*.md"), *DOCS.glob("tutorial/*.md"), *DOCS.glob("evidence/*.md"), *OUTSIDE])
LINK = re.compile(r"(?<!\\)\[[^\]\n]*\]\(([^)\s]+)\)")


def load(name: str) -> object:
    sys.path.insert(0, str(DOCS))
    try:
        return importlib.import_module(name)
    finally:
        sys.path.pop(0)


def anchors(path: Path) -> set[str]:
    """Anchors that Markdown gives the headings of a page."""
    lines = re.sub(
        r"^```.*?^```", "", path.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE
    ).splitlines()
    found: set[str] = set()
    for line in lines:
        if match := re.match(r"#+ (.*)", line):
            text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", match[1]).lower()
            anchor = "".join(letter for letter in text if letter.isalnum() or letter in " _-").replace(
                " ", "-"
            )
            found.add(anchor)
    return found


def test_every_link_between_pages_leads_to_a_file_and_a_heading() -> None:
    problems, count = [], 0
    for page in PAGES:
        for target in LINK.findall(
            re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.S | re.M)
        ):
            if re.match(r"[a-z+]+:", target):
                continue
            count += 1
            name, _, anchor = target.partition("#")
            path = (page.parent / name).resolve() if name else page
            if not path.exists():
                problems.append(f"{page.name}: {target}: no such file")
            elif anchor and path.suffix == ".md" and anchor not in anchors(path):
                problems.append(f"{page.name}: {target}: no such heading")
    assert count > 100
    assert not problems


def test_every_page_is_in_the_site_once() -> None:
    text = (DOCS / "index.md").read_text(encoding="utf-8")
    trees = re.findall(r"^```\{toctree\}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    listed = [line for tree in trees for line in tree.splitlines() if line and not line.startswith(":")]
    kinds = ("*.md", "tutorial/*.md", "evidence/*.md", "examples/*.ipynb")
    files = [path for kind in kinds for path in DOCS.glob(kind)]
    there = {path.relative_to(DOCS).with_suffix("").as_posix() for path in files} - {"index"}
    assert sorted(listed) == sorted(there)


def test_no_formula_needs_a_program_of_another_server() -> None:
    for page in PAGES:
        text = re.sub(r"^```.*?^```|`[^`]*`", "", page.read_text(encoding="utf-8"), flags=re.S | re.M)
        assert not re.search(r"\$[^$\n]+\$|\\frac|\{math\}", text), f"{page.name}: write formulas without TeX"


def test_the_interface_page_has_every_name() -> None:
    text = (DOCS / "api.md").read_text(encoding="utf-8")
    listed = re.findall(r"^\.\. auto\w+:: beardyn_core\.(\w+)$", text, re.MULTILINE)
    assert sorted(listed) == sorted(name for name in bd.__all__ if name != "plot")
    plots = re.findall(r"^\.\. autofunction:: beardyn_core\.plot\.(\w+)$", text, re.MULTILINE)
    assert sorted(plots) == sorted(bd.plot.__all__)


def test_the_page_of_commands_is_that_of_the_parsers() -> None:
    assert load("write_commands").main(["--check"]) == 0  # type: ignore[attr-defined]


def test_the_tutorial_shows_an_answer_to_every_command_that_is_to_be_read() -> None:
    for page in (DOCS / "tutorial").glob("*.md"):
        text = page.read_text(encoding="utf-8")
        assert "```text\n```" not in text, f"{page.name}: run python docs/write_tutorials.py"
        assert (
            len(re.findall("^```bash", text, re.MULTILINE))
            + len(re.findall("^```python", text, re.MULTILINE))
            >= 2
        )


@pytest.mark.slow
@pytest.mark.usefixtures("shipped_configuration")  # what a user has who follows it
def test_every_command_of_the_tutorial_runs() -> None:
    assert load("write_tutorials").main(["--check"]) == 0  # type: ignore[attr-defined]


@pytest.mark.slow
def test_the_site_builds_without_a_warning(tmp_path: Path) -> None:
    pytest.importorskip("sphinx")
    pytest.importorskip("myst_nb")
    words = [
        sys.executable,
        "-m",
        "sphinx",
        "--fail-on-warning",
        "--keep-going",
        "--quiet",
        str(DOCS),
        str(tmp_path / "html"),
    ]
    done = subprocess.run(words, capture_output=True, text=True, timeout=1200, check=False)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "html" / "searchindex.js").stat().st_size > 100_000
    for page in (tmp_path / "html").rglob("*.html"):  # an archive is read without a connection
        text = page.read_text(encoding="utf-8")
        assert not re.search(r'<(script|link)[^>]*(src|href)="(https?:)?//', text), page
