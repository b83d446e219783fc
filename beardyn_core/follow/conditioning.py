"""A known load among the estimates of a run: checked, combined with what the vibration says."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import isfinite, log

from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.follow.estimator import Estimate, Estimates
from beardyn_core.follow.known_load import NORMAL_50, NORMAL_90, KnownLoad, combine_loads, read_load
from beardyn_core.follow.load_checks import AxleLoads, Evidence, doubts_of, vehicle_speed
from beardyn_core.follow.load_sensors import read_sensor
from beardyn_core.follow.quantities import BY_NAME

VERTICAL = "vertical_load"


def known_load_of(
    load: KnownLoad | str | float | None, sensors: Sequence[str] = (), further: Sequence[KnownLoad] = ()
) -> KnownLoad | None:
    """Combine a load that is stated, sensors in words and further sources; none of nothing.

    Parameters
    ----------
    load : KnownLoad, str or float, optional
        A number is in kN; a text is as of `read_load`; an empty one is none.
    sensors : sequence of str
        As of `read_sensor`; several in one text have ``;`` between.
    further : sequence of KnownLoad
        Such as a channel of the recording.

    Raises
    ------
    InputError
        A text makes no sense.
    """
    found = list(further)
    if isinstance(load, KnownLoad):
        found.append(load)
    elif load is not None and str(load).strip():
        found.append(read_load(str(load)))
    found += [read_sensor(each) for text in sensors for each in text.split(";") if each.strip()]
    return combine_loads(found)


def condition_estimates(
    found: Estimates,
    load: KnownLoad,
    bearing: RollerBearing | None,
    wheel_diameter: float,
    axle_loads: AxleLoads | None = None,
) -> Estimates:
    """Give the estimates of a run whose vertical load is known.

    The vertical load is the known one, combined with the estimate of the vibration where there is one. Other
    numbers stay as they are: their estimates are learnt each for itself, so that the load reveals nothing of
    them.

    Raises
    ------
    InputError
        The bearing cannot carry such a load.
    """
    vertical, lateral = (_told(found, name) for name in (VERTICAL, "lateral_load"))
    combined = load if vertical is None or vertical.source else combine_loads([load, _of_vibration(vertical)])
    assert combined is not None
    evidence = Evidence(
        None if lateral is None else lateral.intervals[-1],
        vehicle_speed(found.shaft_frequency, wheel_diameter),
        axle_loads,
    )
    checked = replace(combined, doubts=doubts_of(combined, bearing, evidence))
    stated = estimate_of(checked)
    others = [each for each in found.quantities if each.quantity.name != VERTICAL]
    return replace(found, quantities=(stated, *others), known_load=checked)


def estimate_of(load: KnownLoad) -> Estimate:
    """Give a known load in the words of an estimate."""
    ends = (load.ends(NORMAL_50), load.ends(NORMAL_90))
    words = f"known, {load.source}" + (f"; {load.assumed}" if load.assumed else "")
    return Estimate(BY_NAME[VERTICAL], load.value, ends, source=words)


def _of_vibration(estimate: Estimate) -> KnownLoad:
    low, high = estimate.intervals[-1]
    return KnownLoad(estimate.value, 0.5 * log(high / low) * estimate.value, "vibration")


def _told(found: Estimates, name: str) -> Estimate | None:
    return next(
        (each for each in found.quantities if each.quantity.name == name and isfinite(each.value)), None
    )
