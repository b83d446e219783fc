"""Follow one bearing over a run, or over several."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal
from typing import Annotated as A

from beardyn_core.base.errors import InputError

if TYPE_CHECKING:
    from beardyn_core.base.arrays import Float
    from beardyn_core.bearing.lubricant import Lubricant
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.follow.estimator import Estimator
    from beardyn_core.follow.following import Followed
    from beardyn_core.follow.growth import GrowthLaw
    from beardyn_core.follow.known_load import KnownLoad
    from beardyn_core.follow.life_assumptions import LifeAssumptions
    from beardyn_core.follow.mounting import LastingMounting
    from beardyn_core.follow.residual import Residual
    from beardyn_core.follow.service import Service
    from beardyn_core.record.run import Run
    from beardyn_core.scene.scene import Scene


@dataclass(frozen=True)
class Following:
    """What following a bearing has come to."""

    steps: A[tuple[Followed, ...], "after every stretch"]
    residual: A[Residual | None, "measured minus twin at the end; none without a twin"]
    recordings: A[int, "that were followed"] = 1
    mountings: A[
        tuple[LastingMounting, ...],
        "of the sensor that would make a strange signal familiar, in most of the recordings",
    ] = ()

    @property
    def sentences(self) -> list[str]:
        """List everything, a line each."""
        from beardyn_core.follow.mounting import check_mounting

        lines = [each.sentence for each in self.steps]
        last = self.steps[-1]
        lines += ["at the end:", *last.estimates.sentences]
        if self.mountings:
            lines.append(check_mounting([each.sentence_of(self.recordings) for each in self.mountings]))
        lines += [] if last.remains is None else last.remains.sentences
        if self.residual is not None:
            lines.append(f"twin: {100 * self.residual.explained:.0f} % of the third octaves explained")
            lines += self.residual.sentences
        return lines


def follow(
    runs: Run | Path | str | Sequence[Run | Path | str],
    estimator: Estimator | Path | str | None = None,
    *,
    bearing: RollerBearing | NamePlate | str | None = None,
    sensor: str = "",
    service: Service | None = None,
    mileages: Sequence[float] | None = None,
    law: GrowthLaw | None = None,
    lubricant: Lubricant | str = "L055",
    twin: Scene | Path | str | None = None,
    tier: Literal["lumped", "quasistatic"] = "quasistatic",
    load_kn: KnownLoad | str | float | Sequence[KnownLoad | str | float] | None = None,
    load_sensor: str | Sequence[str] = (),
    axle_load_t: str = "",
    temperature_C: tuple[float, float] | None = None,
    assumptions: LifeAssumptions | None = None,
) -> Following:
    """Follow load, end play and spall of a bearing over its recordings.

    Follow one bearing over its recordings in the order of time: a filter puts together the estimates of each
    stretch of load, end play and spall, lets loads wander and spalls grow, and reports what it does not
    explain. Where signals are unlike all that was learnt from, it looks for a sensor that is mounted
    otherwise than stated, and reports a finding that most of the recordings have.

    Parameters
    ----------
    runs : Run, Path or sequence of them
        Recordings of one axlebox, in the order of time. Or runs. Loads, end play and temperature are learnt
        anew in each.
    estimator, bearing, sensor
        See `beardyn_core.estimate`.
    service : Service, optional
        Mileage at the first run, wheel, and the width at which a bearing is taken out.
    mileages : sequence of float, optional
        Since the first run, at the begin of each, [m]; by default each goes on where the one before ended.
    law : GrowthLaw, optional
        Of spalls, before anything is known of this one.
    lubricant : Lubricant or str
        Of the rating life.
    twin : Scene or Path, optional
        Healthy scene of this axlebox on its track: runs at the state that is known at the end, and its third
        octaves are compared with the measured ones; default no twin.
    tier : str
        Of the twin. ``lumped`` or ``quasistatic``.
    load_kn : KnownLoad, str or float, or sequence of them, optional
        Known vertical load on this journal, kN, VALUE or VALUE:UNCERTAINTY as of estimate, one for all
        recordings or one for each; default not known.
    load_sensor : str or sequence of str, optional
        Sensor of the train that gives the vertical load, as of estimate, one for all recordings or one for
        each, several of a recording with ; between; default none.
    axle_load_t, temperature_C, assumptions
        See `beardyn_core.estimate` and `beardyn_core.rating_life`.

    Raises
    ------
    InputError
        No estimator fits, an axis is not measured, the runs are too short, or mileages fall.
    """
    import numpy as np

    from beardyn_core.api.estimating import kelvin_of, known_load_in
    from beardyn_core.api.making import scene as make_scene
    from beardyn_core.api.run_sources import resolve_source
    from beardyn_core.api.twin_residual import residual_beside
    from beardyn_core.follow.estimator_choice import estimator_of_run
    from beardyn_core.follow.load_checks import read_axle_loads
    from beardyn_core.follow.mounting import lasting_mountings
    from beardyn_core.follow.mounting_search import search_mountings
    from beardyn_core.follow.run_stretches import follower_of, stretches_followed
    from beardyn_core.record.run import Run
    from beardyn_core.scene.scene import Scene

    several = [runs] if isinstance(runs, Run | Path | str) else list(runs)
    if mileages is not None and len(mileages) != len(several):
        raise InputError(f"mileages: has {len(mileages)} of them for {len(several)} runs; give one a run")
    for before, after in pairwise(mileages or ()):
        if after < before:
            raise InputError(
                f"mileages: {after:g} m comes after {before:g} m; give them in the order of time"
            )
    stated = one_each("load_kn", load_kn, len(several))
    sensors = one_each("load_sensor", load_sensor or None, len(several))
    received, plate, place = resolve_source(several[0], bearing, sensor)
    if estimator is None:
        estimator = estimator_of_run(received, plate, place)
    follower = follower_of(
        plate, estimator, service=service, law=law, lubricant=lubricant,
        axle_loads=read_axle_loads(axle_load_t, "axle_load_t"), assumptions=assumptions,
        temperature=kelvin_of(temperature_C),
    )  # fmt: skip
    steps: list[Followed] = []
    rows: list[Float] = []
    mountings = []
    time = distance = 0.0
    for k, run in enumerate(several):
        if k:
            received, plate, place = resolve_source(run, bearing, sensor)
            follower.begin()
        follower.know_load(known_load_in(received, stated[k], sensors[k] or ()))
        begin = distance if mileages is None else mileages[k]
        powers: list[Float] = []
        for each in stretches_followed(received, follower, plate, place):
            rows.append(each.descriptors)
            powers += [] if each.powers is None else [each.powers]
            steps.append(follower.take(each.descriptors, time + each.end, begin + each.distance))
        mountings.append(search_mountings(powers, follower.estimator))
        time, distance = (steps[-1].time, steps[-1].distance) if steps else (0.0, begin)
    if not steps:
        raise InputError(f"{received.label}: has no stretch of {follower.estimator.stretch:.2f} s to follow")
    residual = None
    if twin is not None:
        base = twin if isinstance(twin, Scene) else make_scene(twin)
        residual = residual_beside(follower.estimator, np.stack(rows), steps[-1].estimates, base, tier)
    return Following(tuple(steps), residual, len(several), lasting_mountings(mountings))


def one_each(name: str, given: Any, count: int) -> list[Any]:
    """Give one of something for each run, of one for all or of one each; None of nothing.

    Raises
    ------
    InputError
        There are neither one nor as many as runs.
    """
    several = list(given) if isinstance(given, list | tuple) else [given]
    if len(several) == 1:
        return several * count
    if len(several) != count:
        raise InputError(f"{name}: has {len(several)} for {count} runs; give one for all, or one for each")
    return several
