"""Make the pictures of README and gallery: ``python docs/write_pictures.py``; needs a display or Xvfb.

They are the moving pictures of `SCENE` that ``beardyn view --gif`` writes, and its view as ``beardyn view``
opens it, whole, at the beginning; with ``--moving`` the former alone. With the folder that ``make demo`` or
``beardyn demo`` wrote, the summary of the demo as well.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from PIL import Image

import beardyn_core as bd
from beardyn_core.record.rerun_view import save
from beardyn_core.record.viewer import take_picture
from beardyn_core.study.animation import SUBJECTS
from beardyn_core.study.animation.picture_file import moving_picture, write_gif

sys.path.insert(0, str(Path(__file__).parents[1]))
from evidence.stamps import stamp

FOLDER = Path(__file__).with_name("pictures")
SCENE, TIER, SECONDS = "cup_spall", "quasistatic", 2.0
MOVING = {"duration": 0.7, "snapshot_rate": 6400}  # a roller in the spall: the load falls for a millisecond
SUMMARY = "summary.png"
WIDTH = 1200
COLOURS = 256


def shrink(source: Path, target: Path) -> None:
    """Scale a picture to `WIDTH` and a palette."""
    picture = Image.open(source).convert("RGB")
    small = picture.resize((WIDTH, round(picture.height * WIDTH / picture.width)), Image.Resampling.LANCZOS)
    small.quantize(COLOURS, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(target, optimize=True)
    stamp(target)


def main(arguments: list[str]) -> None:
    """Draw moving pictures and the view, and shrink the summary of a demo that is given."""
    FOLDER.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as place:
        fine = bd.simulate(SCENE, tier=TIER, **MOVING)
        for subject in SUBJECTS:
            path = FOLDER / f"{subject}.gif"
            write_gif(moving_picture(fine, subject), path)
            stamp(path)
        if "--moving" not in arguments:
            run = bd.simulate(SCENE, tier=TIER, duration=SECONDS, record=Path(place) / "cup_spall.mcap")
            view = save(run, Path(place) / "cup_spall.rrd")
            shrink(take_picture(view, Path(place) / "view.png"), FOLDER / "demo_view.png")
    for folder in arguments:
        if folder != "--moving":
            shrink(Path(folder) / SUMMARY, FOLDER / "demo_summary.png")


if __name__ == "__main__":
    main(sys.argv[1:])
