"""Runs whose descriptors follow from load, end play and spall by a law that is known, with noise."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.config import load_plate
from beardyn_core.follow.descriptors import AXES, names_of
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.labelled import Described
from beardyn_core.follow.learning import calibrate_intervals, train_estimator
from beardyn_core.follow.quantities import QUANTITIES

PLATE = load_plate("HS130x230")
NAMES = names_of(AXES)
RATE, STRETCH = 25_600.0, 1.5


def drawn(count: int, seed: int, shift: float = 0.0, noise: float = 1.0) -> Described:
    """Draw runs; `shift` is on the levels, as another tier has it, [dB]."""
    random = np.random.default_rng(seed)
    load = np.exp(random.uniform(np.log(3e4), np.log(9e4), count))
    play = random.uniform(0.0, 2.5e-4, count)
    condition = random.choice(["healthy", "cup", "cone"], count)
    width = np.exp(random.uniform(np.log(2e-3), np.log(16e-3), count))
    return received(random, load, play, condition, width, shift, noise)


def received(
    random: np.random.Generator,
    load: Float,
    play: Float,
    condition: NDArray[np.str_],
    width: Float,
    shift: float = 0.0,
    noise: float = 1.0,
    length: Float | None = None,
) -> Described:
    """Hear runs whose truth is given."""
    count, sound = len(load), condition == "healthy"
    width = np.where(sound, np.nan, width)
    length = np.where(sound, np.nan, random.uniform(10e-3, 40e-3, count) if length is None else length)
    depth = np.where(sound, np.nan, random.uniform(5e-5, 2.5e-4, count))
    rows = random.normal(0.0, 1.0, (count, len(NAMES)))
    wide = 1e3 * np.nan_to_num(width)
    law = {
        "band_z_250": 20.0 * np.log10(load / 5e4) + shift,
        "passing_1_level_z": 1e5 * play + 10.0 * np.log10(load / 5e4) + shift,
        "way_cup": np.where(condition == "cup", wide, 0.0),
        "way_cone": np.where(condition == "cone", wide, 0.0),
        "score_cup": np.where(condition == "cup", 10.0, 0.0),
        "score_cone": np.where(condition == "cone", 10.0, 0.0),
        "kurtosis": wide,
        "crest": 1e3 * np.nan_to_num(length),
    }
    for name, values in law.items():
        rows[:, NAMES.index(name)] = values + 0.5 * noise * random.normal(size=count)
    truth = {each.name: np.full(count, np.nan) for each in QUANTITIES}
    truth |= {"vertical_load": load, "end_play": play, "width": width, "length": length, "depth": depth}
    return Described(rows, truth, np.array([f"b{k}" for k in range(count)]), condition)


@cache
def train_once(runs: int = 240) -> Estimator:
    """Train on runs without a shift; nothing has set the intervals yet."""
    plate = PLATE if isinstance(PLATE, NamePlate) else NamePlate.of(PLATE)
    return train_estimator(drawn(runs, 1), plate, AXES, RATE, STRETCH)


def taught(calibration: Described, straightened: bool = False, runs: int = 240) -> Estimator:
    """Train on runs without a shift, and set the intervals by others."""
    return calibrate_intervals(train_once(runs), calibration, straightened=straightened)


@cache
def standard_estimator() -> Estimator:
    """The estimator that most claims are about: its intervals are set by 200 runs like those learnt from."""
    return taught(drawn(200, 2))
