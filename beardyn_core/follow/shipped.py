"""Estimators that are shipped, found by the bearing."""

from __future__ import annotations

from pathlib import Path

from beardyn_core.base.config_folder import config_folder
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.config import load_bearing, shipped_names
from beardyn_core.follow.estimator import Estimator, read_estimator
from beardyn_core.follow.inference import doubt_of


def list_shipped() -> list[Path]:
    """List the files of the shipped estimators."""
    return sorted((config_folder() / "estimators").glob("*.npz"))


def shipped_for(bearing: Bearing | NamePlate) -> Estimator:
    """Read the shipped estimator of a bearing, that of the most axes.

    Raises
    ------
    InputError
        There is none, with those that there are, or the bearing is of a kind that has none.
    """
    if bearing.name in shipped_names("bearings"):
        load_bearing(bearing.name)
    known = [read_estimator(path) for path in list_shipped()]
    if fitting := [each for each in known if not doubt_of(each, bearing)]:
        return max(fitting, key=lambda each: len(each.axes))
    names = ", ".join(sorted({each.plate.name for each in known})) or "none"
    raise InputError(f"no estimator is shipped for {bearing.name}; there are those of {names}")
