"""Where pages and their pictures go, and how pictures are made small."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

from evidence.stamps import AT_START, command_of_this_process, png_text

DOCS = Path(__file__).resolve().parents[1] / "docs"
PICTURES = DOCS / "pictures"


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
