"""Make the pictures of README and first run from a demo run: ``python docs/write_pictures.py DEMO_FOLDER``.

DEMO_FOLDER is what ``make demo`` or ``beardyn demo`` wrote; its rerun picture needs a display or Xvfb. Of it
the bearing is taken: messages of the viewer pop up over the plots beside it.
"""

from __future__ import annotations

import sys
from pathlib import Path

from PIL import Image

FOLDER = Path(__file__).with_name("pictures")
WHOLE = (0.0, 0.0, 1.0, 1.0)
BEARING = (0.0, 0.065, 0.535, 0.935)  # left, top, right, bottom, of the picture
PICTURES = {
    "view.png": ("demo_view.png", BEARING, 800),
    "summary.png": ("demo_summary.png", WHOLE, 1200),
}
COLOURS = 128


def shrink(source: Path, target: Path, part: tuple[float, float, float, float], width: int) -> None:
    """Scale a part of a picture to a width and a small palette."""
    picture = Image.open(source).convert("RGB")
    left, top, right, bottom = part
    wide, high = picture.size
    picture = picture.crop((round(left * wide), round(top * high), round(right * wide), round(bottom * high)))
    height = round(picture.height * width / picture.width)
    small = picture.resize((width, height), Image.Resampling.LANCZOS)
    small.quantize(COLOURS).save(target, optimize=True)


def main() -> None:
    """Shrink both pictures into docs/pictures."""
    if len(sys.argv) != 2:
        sys.exit(str(__doc__))
    demo = Path(sys.argv[1])
    FOLDER.mkdir(exist_ok=True)
    for name, (target, part, width) in PICTURES.items():
        if not (demo / name).exists():
            sys.exit(f"{demo / name} is missing: run the demo with a display or Xvfb first")
        shrink(demo / name, FOLDER / target, part, width)


if __name__ == "__main__":
    main()
