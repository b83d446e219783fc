"""Where pages and their pictures go, and how pictures are made small."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

DOCS = Path(__file__).resolve().parents[1] / "docs"
PICTURES = DOCS / "pictures"


def save_small(source: Path, target: Path, colours: int) -> None:
    """Save a picture as a PNG of one byte a pixel.

    Parameters
    ----------
    source, target : Path
        May be the same file.
    colours : int
        Size of the palette, at most 256.
    """
    with Image.open(source) as picture:
        small = picture.convert("RGB").quantize(colours, Image.Quantize.MAXCOVERAGE)
    small.save(target, optimize=True)
