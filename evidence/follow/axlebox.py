"""Judge estimators of one axlebox, trained after a calibration, in docs/evidence/estimator.md.

``python -m evidence.follow.axlebox FOLDER [--box A]`` plays the boxes of `evidence.calibration.page`,
calibrates a scene to 5 s of each, trains an estimator for it, and judges it by rides of that box in `full`
that were never learnt from; what the folder has is not done again. Some 20 min of one core for each box.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import yaml

import beardyn_core as bd
from beardyn_core.base.edge import write_noun
from beardyn_core.config import load_bearing
from beardyn_core.follow.estimator import Estimator, read_estimator
from beardyn_core.follow.labelled import Described, describe_runs
from beardyn_core.population.labelled_set import LabelledSet
from beardyn_core.population.training_sweep import TRUER, compose_sweep
from evidence.calibration.hidden import BASE, BOXES, Hidden, found_of
from evidence.follow.boxes import COLUMNS, SHIPPED, row_of
from evidence.pages import REPORTS, with_section

PAGE = REPORTS / "estimator.md"
TITLE, NEXT = "## After a calibration\n", "## By size, speed, noise and box\n"
RIDES, SEED = 40, 71
HEAD = f"""{TITLE}
Written by `python -m evidence.follow.axlebox FOLDER`: {RIDES} rides in `full` in a box whose numbers were
hidden (the boxes of [the calibration](../estimate.md#a-scene-of-one-axlebox)), other loads, speeds, tracks,
bearings of the lot and spalls, judged by the shipped estimator and by one of `beardyn train --scene` for the
scene that `beardyn calibrate` has fitted to one healthy recording of 5 s whose load is not known. Columns as
above.

| {" | ".join(("box, estimator", *COLUMNS[1:]))} |
|---{"|--:" * (len(COLUMNS) - 1)}|
"""


def true_scene(box: Hidden) -> dict[str, Any]:
    """Give the keys of the scene of a hidden box."""
    keys: dict[str, Any] = write_noun(bd.scene(BASE))
    structure: dict[str, Any] = {"kind": "modes", "table": "high_speed"}
    structure |= {"stiffness_factor": box.frequency**2, "damping_factor": box.damping}
    background = {**keys["background"], "amplitude_factor": box.background}
    sensor = {**keys["sensors"][0], "noise_density_m_per_s2_per_sqrt_Hz": box.noise}
    lot = {**keys["scatter"], "seed": box.lot}
    keys |= {"scene": f"box_{box.name}", "end_play_mm": box.end_play, "scatter": lot}
    return keys | {
        "effects": {"preset": "auto", "structure": structure},
        "background": background,
        "sensors": [sensor],
    }


def rides_of(box: Hidden, folder: Path) -> LabelledSet:
    """Simulate rides of a box in `full`; what the folder has is not done again."""
    done = folder / f"{box.name}_rides"
    if (done / "runs.parquet").is_file():
        return LabelledSet(done)
    scene = folder / f"{box.name}_true.yaml"
    scene.write_text(yaml.safe_dump(true_scene(box), sort_keys=False), encoding="utf-8")
    keys = compose_sweep(load_bearing("HS130x230"), scene=str(scene)).of_part(TRUER)
    keys["vary"] = [each for each in keys["vary"] if each.get("per") != "bearing"]
    keys |= {"seed": SEED + BOXES.index(box), "runs": RIDES, "sweep": f"rides of box {box.name}"}
    return bd.sweep(keys, done, workers=1, progress=True)


def estimator_of(box: Hidden, folder: Path) -> Estimator:
    """Calibrate a scene to a recording of a box, and train an estimator for it."""
    scene, file = (folder / f"{box.name}{ending}" for ending in (".yaml", ".npz"))
    if file.is_file():
        return read_estimator(file)
    found_of(box, folder)
    made = bd.make_estimators(scene=scene, output=file, axes=["xyz"], workers=1, progress=True)
    return made[0].estimator


def row(words: str, estimator: Estimator, runs: Described) -> str:
    """Write the row of an estimator."""
    found = [estimator.estimates(each[None]) for each in runs.descriptors]
    return row_of(words, runs, found, np.ones(len(found), bool))


def section(boxes: Sequence[Hidden], folder: Path) -> str:
    """Judge boxes and write the section."""
    text = HEAD
    for box in boxes:
        own = estimator_of(box, folder)
        runs = describe_runs(rides_of(box, folder), None)
        text += row(f"{box.name}, shipped", read_estimator(SHIPPED), runs)
        text += row(f"{box.name}, its own", own, runs)
    return f"{text}\n"


def main(words: Sequence[str] | None = None) -> int:
    """Write the section of the page."""
    parser = argparse.ArgumentParser(prog="python -m evidence.follow.axlebox", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="keeps what is done")
    parser.add_argument("--box", choices=[each.name for each in BOXES], action="append", help="default all")
    args = parser.parse_args(words)
    args.folder.mkdir(exist_ok=True)
    chosen = [each for each in BOXES if args.box is None or each.name in args.box]
    text = with_section(PAGE.read_text(encoding="utf-8"), TITLE, section(chosen, args.folder), NEXT)
    PAGE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
