"""Fonts of this computer that have the characters of a text, for a PDF, which carries its fonts."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

from matplotlib import font_manager
from matplotlib.ft2font import FT2Font

USUAL = "DejaVu Sans"  # comes with matplotlib
PLACEHOLDER = "□"
_NOT_FOR_TEXT = ("last resort", "lastresort", "nondisplay", "cmex", "cmsy", "cmmi", "mono", "emoji")


@dataclass(frozen=True)
class Fonts:
    """Fonts for a text."""

    families: A[tuple[str, ...], "the usual one first, then those that have what it lacks"]
    missing: A[str, "characters that no font of this computer has"]

    def shown(self, text: str) -> str:
        """Write a text with a placeholder for every character that cannot be shown."""
        return "".join(PLACEHOLDER if each in self.missing else each for each in text)


def fonts_for(text: str) -> Fonts:
    """Find fonts for all characters of a text."""
    wanted = {each for each in text if not each.isspace() and each.isprintable()}
    wanted |= {each for each in text if not each.isprintable() and not each.isspace()}
    lacking = wanted - _characters(font_manager.findfont(USUAL), wanted)
    families = [USUAL]
    for path in _other_fonts() if lacking else ():
        try:
            found = _characters(path, lacking)
        except (OSError, RuntimeError):  # a file that is damaged, or no outline font
            continue
        if found:
            families.append(_known_family(path))
            lacking -= found
        if not lacking:
            break
    return Fonts(tuple(dict.fromkeys(families)), "".join(sorted(lacking)))


def _characters(path: str, wanted: Iterable[str]) -> set[str]:
    font = FT2Font(path)
    return {each for each in wanted if font.get_char_index(ord(each))}


def _other_fonts() -> list[str]:
    """List the font files of this computer, also those that came after the list of the library was made."""
    known = {entry.fname for entry in font_manager.fontManager.ttflist}
    paths = sorted({*known, *font_manager.findSystemFonts()}, key=lambda path: (_is_bold(path), path))
    return [path for path in paths if not any(word in path.lower() for word in _NOT_FOR_TEXT)]


def _is_bold(path: str) -> bool:
    return any(word in Path(path).stem.lower() for word in ("bold", "black", "heavy", "italic", "oblique"))


def _known_family(path: str) -> str:
    if path not in {entry.fname for entry in font_manager.fontManager.ttflist}:
        font_manager.fontManager.addfont(path)
    return next(entry.name for entry in font_manager.fontManager.ttflist if entry.fname == path)
