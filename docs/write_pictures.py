"""Make the pictures of the README from a demo run: ``python docs/write_pictures.py DEMO_FOLDER``.

DEMO_FOLDER is what ``make demo`` or ``beardyn demo`` wrote; its rerun picture needs a display or Xvfb.
"""

from __future__ import annotations

import sys
from pathlib import Path

from PIL import Image

FOLDER = Path(__file__).with_name("pictures")
PICTURES = {"view.png": ("demo_view.png", 1400), "summary.png": ("demo_summary.png", 1200)}
COLOURS = 128


def shrink(source: Path, target: Path, width: int) -> None:
    """Scale a picture to a width and a small palette."""
    picture = Image.open(source).convert("RGB")
    height = round(picture.height * width / picture.width)
    small = picture.resize((width, height), Image.Resampling.LANCZOS)
    small.quantize(COLOURS).save(target, optimize=True)


def main() -> None:
    """Shrink both pictures into docs/pictures."""
    if len(sys.argv) != 2:
        sys.exit(str(__doc__))
    demo = Path(sys.argv[1])
    FOLDER.mkdir(exist_ok=True)
    for name, (target, width) in PICTURES.items():
        if not (demo / name).exists():
            sys.exit(f"{demo / name} is missing: run the demo with a display or Xvfb first")
        shrink(demo / name, FOLDER / target, width)


if __name__ == "__main__":
    main()
