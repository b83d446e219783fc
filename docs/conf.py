"""Settings of the documentation site: ``make docs`` builds it from the pages of this folder."""

from __future__ import annotations

import builtins
import re
import sys
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Annotated, Any, get_args, get_origin, get_type_hints

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

import beardyn_core  # noqa: E402
from beardyn_core.api import making  # noqa: E402

# Rooms that are called like functions: the site describes the functions.
beardyn_core.bearing, beardyn_core.scene = making.bearing, making.scene

project = "beardyn"
author = "beardyn developers"
copyright = "beardyn developers, Apache-2.0"
version = release = re.search(r'version="([^"]+)"', (ROOT / "setup.py").read_text(encoding="utf-8"))[1]

extensions = ["sphinx.ext.autodoc", "sphinx.ext.napoleon", "myst_nb"]
exclude_patterns = ["paper/*", "site"]
html_theme = "furo"
html_title = f"beardyn {version}"
html_copy_source = False

myst_heading_anchors = 4
nb_execution_mode = "off"  # outputs are those that `python docs/write_notebook.py --run` has kept

autodoc_member_order = "bysource"
autodoc_typehints = "none"
add_module_names = False
napoleon_google_docstring = False
napoleon_use_ivar = True

linkcheck_anchors = False


OUTSIDE = {"README.md": "readme.md", "CHANGELOG.md": "changelog.md", "CONTRIBUTING.md": "contributing.md"}
OUTSIDE |= {"SECURITY.md": "security.md"}


def whole_pages(app: Any, name: str, source: list[str]) -> None:
    """Put the pages of the repository's first folder in, and let links to them stay in the site."""

    def whole(found: re.Match[str]) -> str:
        page = (ROOT / found[1]).read_text(encoding="utf-8")
        return re.sub(r"\]\((?!#|docs/|[a-z]+:)", "](../", page).replace("](docs/", "](")

    text = re.sub(r"^<!-- the text of (\S+) -->\n", whole, source[0], flags=re.MULTILINE)
    for file, page in OUTSIDE.items():
        text = text.replace(f"](../{file}", f"]({page}")
    source[0] = text


class _Anything:
    """A type that is known to a type checker alone; of anything, too."""

    def __class_getitem__(cls, _of: Any) -> type[_Anything]:
        """Give the same."""
        return cls


class _ForTypesAlone(dict[str, Any]):
    """What a module imports for its types alone, which is nothing at run time."""

    def __init__(self, there: dict[str, Any]) -> None:
        self.there = there

    def __missing__(self, name: str) -> Any:
        """Take any type for a name that is neither in the module nor built in."""
        if name in self.there or hasattr(builtins, name):
            raise KeyError(name)
        return _Anything


def words_of_fields(app: Any, what: str, name: str, found: Any, options: Any, lines: list[str]) -> None:
    """List the fields of a dataclass with the words of their annotations, where no docstring has them."""
    if what != "class" or not is_dataclass(found) or any(line.strip() == "Attributes" for line in lines):
        return
    there: dict[str, Any] = {}
    for base in found.__mro__:  # a field may come from the module of a base
        there |= vars(sys.modules[base.__module__])
    hints = get_type_hints(found, localns=_ForTypesAlone(there), include_extras=True)
    words = {
        field.name: next((each for each in get_args(hints[field.name])[1:] if isinstance(each, str)), "")
        for field in fields(found)
        if get_origin(hints[field.name]) is Annotated
    }
    if words:
        lines += ["", "Attributes", "----------"]
        for field, text in words.items():
            lines += [field, f"    {text[:1].upper()}{text[1:]}."]


def setup(app: Any) -> None:
    """Connect what is above; words of fields before napoleon reads the docstring."""
    app.connect("source-read", whole_pages)
    app.connect("autodoc-process-docstring", words_of_fields, priority=100)
