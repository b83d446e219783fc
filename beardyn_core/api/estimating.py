"""Estimate load, end play and spall from a run; train an estimator on a set of labelled runs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import file_problems
from beardyn_core.base.units import ZERO_CELSIUS

if TYPE_CHECKING:
    from beardyn_core.bearing.lubricant import Lubricant
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.follow.estimator import Estimates, Estimator
    from beardyn_core.follow.forecast import Forecast
    from beardyn_core.follow.growth import GrowthLaw
    from beardyn_core.follow.known_load import KnownLoad
    from beardyn_core.follow.life_assumptions import LifeAssumptions
    from beardyn_core.follow.rated_life import RatedLife
    from beardyn_core.follow.service import Service
    from beardyn_core.population.labelled_set import LabelledSet
    from beardyn_core.record.run import Run


def estimate(
    run: Run | Path | str,
    estimator: Estimator | Path | str | None = None,
    *,
    bearing: RollerBearing | NamePlate | str | None = None,
    sensor: str = "",
    load_kn: KnownLoad | str | float | None = None,
    load_sensor: str | Sequence[str] = (),
    axle_load_t: str = "",
    wheel_diameter: float | None = None,
) -> Estimates:
    """Estimate load, end play and spall of a recording, each with an interval.

    Estimate from vibration and shaft of a recording what no sensor measures: load, end play, which part is
    spalled and how wide, with intervals of 50 and 90 %; what these sensors do not identify is named (with the
    shipped estimators temperature, and vertical load but for freight).

    Parameters
    ----------
    run : Run or Path
        Recording to estimate from. Or a run, simulated or measured.
    estimator : Estimator or Path, optional
        That `train` has made; default one of the user or a shipped one for the bearing and the axes that are
        measured. Where there is none, the command that makes one is named.
    bearing : Bearing, NamePlate or str, optional
        Data of the bearing; default that of the recording.
    sensor : str, optional
        Accelerometer; default the first. See `beardyn_core.monitor`.
    load_kn : KnownLoad, str or float, optional
        Known vertical load on this journal, kN, VALUE or VALUE:UNCERTAINTY, half of its 90 % interval, such
        as 80:3 or 80:5%; default not known. An uncertainty that is not given is 10 %. A channel of the load
        that measured files were imported with is known as well.
    load_sensor : str or sequence of str, optional
        Sensor of the train that gives the vertical load, KIND KEY=NUMBER and so on: air_spring, spring or
        weighing; default none. Several give one load, and must agree. See docs/estimate.md.
    axle_load_t : str
        EMPTY:FULL, axle loads that the vehicle can have, t, against which a known load is checked; default
        none.
    wheel_diameter : float, optional
        Running diameter, for the speed against which a known load is checked, [m]; default 0.92.

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
    from beardyn_core.api.run_sources import resolve_source
    from beardyn_core.follow.conditioning import condition_estimates
    from beardyn_core.follow.estimator import Estimator, read_estimator
    from beardyn_core.follow.estimator_choice import estimator_of_run
    from beardyn_core.follow.inference import estimates_of
    from beardyn_core.follow.load_checks import read_axle_loads
    from beardyn_core.follow.run_stretches import whole_bearing
    from beardyn_core.follow.service import Service

    received, plate, sensor = resolve_source(run, bearing, sensor)
    if estimator is None:
        estimator = estimator_of_run(received, plate, sensor)
    elif not isinstance(estimator, Estimator):
        estimator = read_estimator(Path(estimator))
    known = known_load_in(received, load_kn, load_sensor)
    axles = read_axle_loads(axle_load_t, "axle_load_t")
    found = estimates_of(received, estimator, plate, sensor)
    if known is None:
        return found
    wheel = wheel_diameter or Service().wheel_diameter
    return condition_estimates(found, known, whole_bearing(plate), wheel, axles)


def known_load_in(
    run: Run, load_kn: KnownLoad | str | float | None, load_sensor: str | Sequence[str]
) -> KnownLoad | None:
    """Combine what is stated of the vertical load with the channel of it that a measured run has.

    Parameters
    ----------
    run : Run
    load_kn, load_sensor
        See `estimate`.
    """
    from beardyn_core.follow.conditioning import known_load_of
    from beardyn_core.follow.known_load import load_of_channel

    sensors = [load_sensor] if isinstance(load_sensor, str) else load_sensor
    channel = run.measured.get("load")
    return known_load_of(load_kn, sensors, () if channel is None else (load_of_channel(channel),))


def rating_life(
    found: Estimates,
    run: Run | Path | str,
    service: Service | None = None,
    *,
    bearing: RollerBearing | str | None = None,
    lubricant: Lubricant | str = "L055",
    temperature_C: tuple[float, float] | None = None,
    assumptions: LifeAssumptions | None = None,
) -> RatedLife:
    """Rate the life of the bearing of a run under a vertical load that is known, with intervals.

    Parameters
    ----------
    found : Estimates
        Of `estimate` with a known load.
    run, bearing, lubricant
        See `forecast`.
    service : Service, optional
        Mileage so far, for the share that is used, and wheel.
    temperature_C : 2 floats, optional
        Of the lubricant, ends of its 90 % interval; default assumed, 40 to 85.
    assumptions : LifeAssumptions, optional
        What no recording holds of the service, and is varied.

    Raises
    ------
    InputError
        No load is known, or only the data of the bearing is.
    """
    from beardyn_core.config import load_lubricant
    from beardyn_core.follow.life_assumptions import LifeAssumptions
    from beardyn_core.follow.rated_life import LifeCounter
    from beardyn_core.follow.service import Service

    if found.known_load is None:
        raise InputError("the vertical load is not known; estimate with load_kn or load_sensor")
    whole = _bearing_of(run, bearing)
    served = service or Service()
    grease = load_lubricant(lubricant) if isinstance(lubricant, str) else lubricant
    counter = LifeCounter(whole, grease, served.wheel_diameter, assumptions or LifeAssumptions())
    warm = kelvin_of(temperature_C)
    rated = counter.rate(found.known_load, found, served.mileage, warm)
    if rated is None:
        raise InputError("the shaft stands; a rating life needs one that turns")
    return rated


def kelvin_of(temperature_C: tuple[float, float] | None) -> tuple[float, float] | None:
    """Convert both ends of a temperature in degrees Celsius to kelvin."""
    if temperature_C is None:
        return None
    low, high = temperature_C
    return low + ZERO_CELSIUS, high + ZERO_CELSIUS


def forecast(
    found: Estimates,
    run: Run | Path | str,
    service: Service,
    law: GrowthLaw | None = None,
    *,
    bearing: RollerBearing | str | None = None,
    lubricant: Lubricant | str = "L055",
    temperature_C: tuple[float, float] | None = None,
    assumptions: LifeAssumptions | None = None,
) -> Forecast:
    """Forecast what remains of the bearing of a run: mileage of a spall, share of the rating life used.

    Parameters
    ----------
    found : Estimates
        Of `estimate`.
    run : Run or Path
        Names the bearing, where `bearing` does not.
    service : Service
        Mileage so far, wheel, and the width at which a bearing is taken out.
    law : GrowthLaw, optional
        Of spalls; its rates are assumed, so give those of the fleet.
    bearing : RollerBearing or str, optional
        A whole one: bearing data alone have no rating life.
    lubricant : Lubricant or str
        Of the rating life.
    temperature_C, assumptions
        See `rating_life`; of the life under a load that is known.

    Raises
    ------
    InputError
        Only the data of the bearing is known, or there is no such lubricant.
    """
    from beardyn_core.config import load_lubricant
    from beardyn_core.follow import forecast as forecasting

    whole = _bearing_of(run, bearing)
    grease = load_lubricant(lubricant) if isinstance(lubricant, str) else lubricant
    rated = None
    if found.known_load is not None:
        rated = rating_life(
            found, run, service, bearing=whole, lubricant=grease, temperature_C=temperature_C,
            assumptions=assumptions,
        )  # fmt: skip
    return forecasting.forecast(found, whole, grease, service, law, rated)


def _bearing_of(run: Run | Path | str, bearing: RollerBearing | str | None) -> RollerBearing:
    """Find the whole bearing of a run, or the one that is named."""
    from beardyn_core.api.run_sources import resolve_source
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.config import load_any_bearing

    known: RollerBearing | NamePlate | str = bearing or resolve_source(run, None, "")[1]
    if isinstance(known, RollerBearing):
        return known
    # bearing data alone have no raceways
    return load_any_bearing(known if isinstance(known, str) else known.name)


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
        tier; the parts of the set that neither teach nor judge widen them where these need wider ones.
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
