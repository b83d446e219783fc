"""Which estimator is for a bearing: one that the user has made, or a shipped one; else how to make it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from beardyn_core.base.data_root import data_root
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.config import load_any_bearing
from beardyn_core.config.folders import shipped_names
from beardyn_core.follow.descriptors import AXES
from beardyn_core.follow.estimator import Estimator, read_estimator
from beardyn_core.follow.inference import alike, doubt_of, measured_axes
from beardyn_core.follow.shipped import list_shipped
from beardyn_core.record.run import Run

ENDING = ".npz"
USUAL_AXES = ("xyz", "z")
"""Axes of the estimators that are made of a bearing where nothing else is asked for."""


def own_folder() -> Path:
    """Name the folder of the estimators that a user has made; `estimate` and `follow` look there first."""
    return data_root() / "estimators"


def list_own() -> list[Path]:
    """List the files of the user's own estimators, the newest first."""
    return sorted(own_folder().glob(f"*{ENDING}"), key=lambda path: -path.stat().st_mtime)


def readable_estimators() -> Iterator[Estimator]:
    """Read the user's own and the shipped estimators; files of other versions of beardyn are passed over."""
    for path in list_own():
        try:
            yield read_estimator(path)
        except InputError:  # made by another version, or no estimator: the user's folder is theirs
            continue
    yield from map(read_estimator, list_shipped())


def estimator_for(
    bearing: RollerBearing | NamePlate,
    axes: Sequence[str] = AXES,
    recording: str = "",
    known: Iterable[Estimator] | None = None,
) -> Estimator:
    """Choose the estimator of a bearing that takes most of the axes that are measured; the user's own first.

    Commands, Python, the fleet and the follower node all choose by it.

    Parameters
    ----------
    bearing : RollerBearing or NamePlate
    axes : sequence of str, optional
        Of the accelerometer that are measured.
    recording : str, optional
        Path of the recording that has the bearing.
    known : iterable of Estimator, optional
        To choose from, of equals the first; default `readable_estimators`.

    Raises
    ------
    InputError
        There is none, with the command that makes one.
    """
    several = readable_estimators() if known is None else known
    # sorting keeps the order of equals, in which the user's own come before the shipped ones
    fitting = sorted(
        (each for each in several if not doubt_of(each, bearing)), key=lambda each: -len(each.axes)
    )
    taken = next((each for each in fitting if set(each.axes) <= set(axes)), None)
    if taken is not None:
        return taken
    if fitting:
        others = " and of ".join(dict.fromkeys(", ".join(each.axes) for each in fitting))
        what = f"has estimators of the axes {others}; measured are {', '.join(axes)}"
    else:
        what = "has no estimator yet"
    raise InputError(f"{bearing.name} {what}: {how_to_train(bearing, axes, recording)}")


def estimator_of_run(run: Run, bearing: RollerBearing | NamePlate, sensor: str = "") -> Estimator:
    """Read the estimator of the bearing and of the measured axes of a run; see `estimator_for`."""
    return estimator_for(bearing, measured_axes(run, sensor), "" if run.path is None else str(run.path))


def how_to_train(bearing: RollerBearing | NamePlate, axes: Sequence[str] = AXES, recording: str = "") -> str:
    """Say which command makes an estimator of a bearing, that is found without further options."""
    one = "".join(each for each in AXES if each in axes)
    option = f" --axes {one}" if one not in ("", *USUAL_AXES) else ""
    if bearing.name in shipped_names("bearings") and alike(bearing, load_any_bearing(bearing.name)):
        named = bearing.name
    elif isinstance(bearing, RollerBearing):
        named = recording or "FILE.yaml"
    else:
        return (
            "estimators are for tapered, cylindrical and spherical roller bearings of two rows; if it is "
            "one, describe the whole bearing in a file (`beardyn new FR130x230x150 -o FILE.yaml` writes one "
            f"to start from), then `beardyn train --bearing FILE.yaml{option}` makes one"
        )
    return f"`beardyn train --bearing {named}{option}` makes one, in 30 to 90 min of one core"
