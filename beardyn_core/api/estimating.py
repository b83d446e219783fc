"""Estimate load, end play and spall from a run; train an estimator on a set of labelled runs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from beardyn_core.api.reading import heard_of
from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import file_problems
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.config import load_bearing, load_lubricant
from beardyn_core.follow import forecast as forecasting
from beardyn_core.follow import training
from beardyn_core.follow.estimator import Estimates, Estimator, read_estimator
from beardyn_core.follow.forecast import Forecast, Service
from beardyn_core.follow.growth import GrowthLaw
from beardyn_core.follow.inference import estimates_of
from beardyn_core.follow.shipped import shipped_for
from beardyn_core.population.labelled_set import LabelledSet
from beardyn_core.record.run import Run


def estimate(
    run: Run | Path | str,
    estimator: Estimator | Path | str | None = None,
    *,
    bearing: Bearing | NamePlate | str | None = None,
    sensor: str = "",
) -> Estimates:
    """Estimate load, end play and spall from vibration and shaft, each with intervals.

    Parameters
    ----------
    run : Run or Path
        A run or a recording, simulated or measured.
    estimator : Estimator or Path, optional
        That `train` has made; by default a shipped one for the bearing.
    bearing, sensor
        See `beardyn_core.monitor`.

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
        A whole one: a name plate has no rating life.
    lubricant : Lubricant or str

    Raises
    ------
    InputError
        Only the name plate of the bearing is known, or there is no such lubricant.
    """
    known: Bearing | NamePlate | str = bearing or heard_of(run, None, "")[1]
    if not isinstance(known, Bearing):  # a name plate alone has no raceways
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
    """Train an estimator on a set of labelled runs, as ``beardyn train`` does.

    Parameters
    ----------
    runs : LabelledSet or Path
        That `sweep` has made, of one bearing and one accelerometer.
    output : Path, optional
        NPZ file to write.
    calibration : sequence of LabelledSet or Path
        Sets that straighten the estimates and set the widths of the intervals, such as a small one in the
        tier `full`; by default the validation part of `runs`.
    test : LabelledSet or Path, optional
        Another set that judges the estimator; by default the test part of `runs`.
    axes : sequence of str
        Of the accelerometer that are heard.
    force : bool
        Replace the file if it exists.

    Raises
    ------
    InputError
        There are too few runs, bearings of several drawings, or the file exists.
    """
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
