"""Pages from templates and numbers, where they and their pictures go, and how pictures are made small.

The prose of a page stands in a Markdown template (Jinja2) with the name of the module that works the numbers
out. In it ``{{ load }}`` is a number by name, ``{{ load | as(".1f") }}`` the same in a format of Python,
``{{ cells | rows }}`` the rows of a table whose head is in the template, and ``{% for %}`` and ``{% if %}``
repeat and leave out.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from jinja2 import Environment, StrictUndefined
from jinja2.meta import find_undeclared_variables
from PIL import Image

from beardyn_core.base.outputs import write_whole
from evidence.stamps import AT_START, command_of_this_process, png_text
from evidence.tables import joined_rows

DOCS = Path(__file__).resolve().parents[1] / "docs"
PICTURES, REPORTS = DOCS / "pictures", DOCS / "evidence"
_TEMPLATES = Environment(
    undefined=StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
    autoescape=False,
)
_TEMPLATES.filters |= {"as": format, "rows": joined_rows}


def render(module: str | Path, values: Mapping[str, Any]) -> str:
    """Fill the template of a module.

    Parameters
    ----------
    module : str or Path
        ``__file__`` of the module, or the template itself: the file of the same name that ends in ``.md``.
    values : mapping
        By the names of the template.

    Raises
    ------
    ValueError
        A name of the template has no value, or a value no place in the template.
    """
    template = Path(module).with_suffix(".md")
    text = template.read_text(encoding="utf-8")
    names = find_undeclared_variables(_TEMPLATES.parse(text))
    problems = [f"{name} has no value" for name in sorted(names - values.keys())]
    problems += [f"{name} has no place" for name in sorted(values.keys() - names)]
    if problems:
        raise ValueError(f"{template}: {'; '.join(problems)}")
    return _TEMPLATES.from_string(text).render(values)


def write_page(module: str | Path, target: Path, values: Mapping[str, Any]) -> None:
    """Fill the template of a module and write the page, whole or not at all; see `render`."""
    write_whole(target, render(module, values))


def save_small(source: Path, target: Path, colours: int) -> None:
    """Save a picture as a PNG of one byte a pixel that says which command and code it is of.

    Parameters
    ----------
    source, target : Path
        May be the same file.
    colours : int
        Size of the palette, at most 256.
    """
    with Image.open(source) as picture:
        small = picture.convert("RGB").quantize(colours, Image.Quantize.MAXCOVERAGE)
    small.save(target, optimize=True, pnginfo=png_text(command_of_this_process(), AT_START))


def replace_between(page: str, begin: str, end: str, written: str) -> str:
    """Put a text in the place of the one between two marks of a page."""
    start = page.index(begin) + len(begin)
    return page[:start] + written + page[page.index(end, start) :]


def with_section(page: str, title: str, written: str, before: str) -> str:
    """Put a section in the place of the one of its title, or before another where there is none yet.

    Parameters
    ----------
    page : str
    title : str
        Line with which the section begins.
    written : str
        The section, title and blank line at its end included.
    before : str
        Line before which a section that is not there yet is put.
    """
    if title not in page:
        start = end = page.index(before)
    else:
        start = page.index(title)
        end = page.find("\n## ", start + len(title)) + 1 or len(page)
    return page[:start] + written + page[end:]


def write_section(target: Path, title: str, written: str, before: str) -> None:
    """Put a section into the file of a page; see `with_section`."""
    write_whole(target, with_section(target.read_text(encoding="utf-8"), title, written, before))
