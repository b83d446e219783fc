"""Estimate load, end play and spall from a run; train an estimator on a set of labelled runs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import file_problems

if TYPE_CHECKING:
    from beardyn_core.bearing.geometry import Bearing
    from beardyn_core.bearing.lubricant import Lubricant
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.follow.estimator import Estimates, Estimator
    from beardyn_core.follow.forecast import Forecast
    from beardyn_core.follow.growth import GrowthLaw
    from beardyn_core.follow.service import Service
    from beardyn_core.population.labelled_set import LabelledSet
    from beardyn_core.record.run import Run


def estimate(
    run: Run | Path | str,
    estimator: Estimator | Path | str | None = None,
    *,
    bearing: Bearing | NamePlate | str | None = None,
    sensor: str = "",
) -> Estimates:
    """Estimate load, end play and spall of a recording, each with an interval.

    Estimate from vibration and shaft of a recording what no sensor measures: load, end play, which part is
    spalled and how wide, with intervals of 50 and 90 %; what is not identifiable is told (with the shipped
    estimators vertical load and temperature).

    Parameters
    ----------
    run : Run or Path
        Recording to estimate from. Or a run, simulated or measured.
    estimator : Estimator or Path, optional
        That `train` has made; default a shipped one for the bearing.
    bearing : Bearing, NamePlate or str, optional
        Data of the bearing; default that of the recording.
    sensor : str, optional
        Accelerometer; default the first. See `beardyn_core.monitor`.

    Returns
    -------
    Estimates
        ``found["vertical_load"].value`` and ``.intervals`` (of 50 and 90 %), ``found.part``, and
        ``found.strangeness``: above 1 the signal is unlike all that was learnt from.

    Raises
    ------
    InputError
        No estimator fits the bearing, an axis is not measured, or the run is too short.
    """
    from beardyn_core.api.reading import heard_of
    from beardyn_core.follow.estimator import Estimator, read_estimator
    from beardyn_core.follow.inference import estimates_of
    from beardyn_core.follow.shipped import shipped_for

    heard, plate, sensor = heard_of(run, bearing, sensor)
    if estimator is None:
        estimator = shipped_for(plate)
    elif not isinstance(estimator, Estimator):
        estimator = read_estimator(Path(estimator))
    return estimates_of(heard, estimator, plate, sensor)


def forecast(
    found: Estimates,
    run: Run | Path | str,
    service: Service,
    law: GrowthLaw | None = None,
    *,
    bearing: Bearing | str | None = None,
    lubricant: Lubricant | str = "L055",
) -> Forecast:
    """Forecast what remains of the bearing of a run: mileage of a spall, share of the rating life used.

    Parameters
    ----------
    found : Estimates
        Of `estimate`.
    run : Run or Path
        Says which bearing it is, where `bearing` does not.
    service : Service
        Mileage so far, wheel, and the width at which a bearing is taken out.
    law : GrowthLaw, optional
        Of spalls; its rates are assumed, so give those of the fleet.
    bearing : Bearing or str, optional
        A whole one: bearing data alone have no rating life.
    lubricant : Lubricant or str
        Of the rating life.

    Raises
    ------
    InputError
        Only the data of the bearing is known, or there is no such lubricant.
    """
    from beardyn_core.api.reading import heard_of
    from beardyn_core.bearing.geometry import Bearing
    from beardyn_core.config import load_bearing, load_lubricant
    from beardyn_core.follow import forecast as forecasting

    known: Bearing | NamePlate | str = bearing or heard_of(run, None, "")[1]
    if not isinstance(known, Bearing):  # bearing data alone have no raceways
        known = load_bearing(known if isinstance(known, str) else known.name)
    grease = load_lubricant(lubricant) if isinstance(lubricant, str) else lubricant
    return forecasting.forecast(found, known, grease, service, law)


def train(
    runs: LabelledSet | Path | str,
    output: Path | str | None = None,
    *,
    calibration: Sequence[LabelledSet | Path | str] = (),
    test: LabelledSet | Path | str | None = None,
    axes: Sequence[str] = ("x", "y", "z"),
    force: bool = False,
) -> Estimator:
    """Train an estimator of load, end play and spall on a set of runs.

    Train an estimator on the training part of a set that `sweep` has made, for its bearing and its
    accelerometer, and judge it by the test part, whose bearings are others. `estimate` reads the file.

    Parameters
    ----------
    runs : LabelledSet or Path
        Set to train with.
    output : Path, optional
        File to write; default none. It is an NPZ file.
    calibration : sequence of LabelledSet or Path
        Another set that straightens estimates and sets the intervals, such as a small one of a truer
        tier; the validation part of the set widens them where it needs wider ones.
    test : LabelledSet or Path, optional
        Another set, all of it to judge the estimator by; default the test part of the set.
    axes : sequence of str
        Of the accelerometer that are used, such as z.
    force : bool
        Replace the file when it exists; default refuse.

    Raises
    ------
    InputError
        There are too few runs, bearings of several drawings, or the file exists.
    """
    from beardyn_core.follow import training
    from beardyn_core.population.labelled_set import LabelledSet

    if problems := file_problems(
        "output", None if output is None else Path(output), force=force, ending=".npz"
    ):
        raise InputError(problems)
    sets = [each if isinstance(each, LabelledSet) else LabelledSet(each) for each in (runs, *calibration)]
    judge = LabelledSet(test) if isinstance(test, str | Path) else test
    found = training.train(sets[0], calibration=sets[1:], test=judge, axes=tuple(axes))
    if output is not None:
        found.save(Path(output), replace=force)
    return found
