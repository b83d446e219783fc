"""What is stated of estimates in JSON: the same keys in commands and on topics, explained in docs/json.md."""

from __future__ import annotations

from math import isfinite
from typing import Any

from beardyn_core.base.plain_json import keyed_fields
from beardyn_core.follow.conformal import LEVELS
from beardyn_core.follow.estimator import Estimate, Estimates
from beardyn_core.follow.following import Followed
from beardyn_core.follow.forecast import Forecast
from beardyn_core.follow.known_load import KnownLoad
from beardyn_core.follow.mounting import GAIN, TURNED, LastingMounting, Mounting
from beardyn_core.follow.rated_life import RatedLife
from beardyn_core.follow.residual import Residual


def forecast_object(remains: Forecast) -> dict[str, Any]:
    """Give what JSON has of a forecast."""
    return {
        **keyed_fields(remains, without=("condition", "rated"), other_laws="other_laws_m"),
        "rating": None if remains.rated is None else rating_object(remains.rated),
    }


def load_object(load: KnownLoad) -> dict[str, Any]:
    """Give what JSON has of a load that is known."""
    return {
        "value_N": load.value,
        "interval_90_N": load.interval,
        "source": load.source,
        "assumed": load.assumed,
        "doubts": load.doubts,
    }


def rating_object(rated: RatedLife) -> dict[str, Any]:
    """Give what JSON has of the rating life under a known load; triples are 5, 50 and 95 of 100."""
    without = ("load", "assumptions")
    return {
        **keyed_fields(rated, without=without),
        "assumed": keyed_fields(rated.assumptions, temperature="temperature_K"),
    }


def estimates_object(found: Estimates) -> dict[str, Any]:
    """Give what JSON has of the estimates."""
    names = [f"{100 * level:.0f}" for level in LEVELS]
    part = found.part
    return {
        "condition": None
        if part is None
        else {
            "name": part.condition,
            "probability": part.probability,
            **{f"set_{name}": each for name, each in zip(names, part.sets, strict=True)},
        },
        "estimates": {
            f"{each.quantity.name}_{each.quantity.unit}": {
                "value": each.value,
                **{f"interval_{name}": _interval_object(each, k) for k, name in enumerate(names)},
                "at_least": each.at_least,
                "reason": each.reason,
                "source": each.source,
            }
            for each in found.quantities
        },
        "known_load": None if found.known_load is None else load_object(found.known_load),
        "strangeness": found.strangeness,
        "mountings": [mounting_object(each) for each in found.mountings],
        "stretches": found.stretches,
        "shaft_frequency_Hz": found.shaft_frequency,
    }


def _interval_object(estimate: Estimate, level: int) -> tuple[float, float | None] | None:
    """Give an interval; its upper end is open where the number is at least so large."""
    if not estimate.intervals:
        return None
    low, high = estimate.intervals[level]
    return low, None if isfinite(estimate.at_least) else high


def mounting_object(mounting: Mounting) -> dict[str, Any]:
    """Give what JSON has of a mounting of the sensor that is not as stated."""
    return {
        "kind": mounting.kind,
        "axes": mounting.axes,
        "angle_deg": mounting.amount if mounting.kind == TURNED else None,
        "gain_dB": mounting.amount if mounting.kind == GAIN else None,
        "strangeness": mounting.strangeness,
    }


def lasting_object(lasting: LastingMounting) -> dict[str, Any]:
    """Give what JSON has of a mounting that is found in several recordings."""
    return {**mounting_object(lasting.mounting), "recordings": lasting.recordings}


def step_object(step: Followed) -> dict[str, Any]:
    """Give what JSON has of one stretch."""
    estimates = estimates_object(step.estimates)
    del estimates["mountings"]  # of a whole recording alone
    return {
        "time_s": step.time,
        "distance_m": step.distance,
        "health": step.health,
        "doubts": step.doubts,
        "changed": step.changed,
        "surprise": step.surprise,
        **estimates,
        "growth_m2_per_m": step.rate[0],
        "growth_factor_90": step.rate[1],
        "names": step.names,
        "covariance": step.covariance,
        "forecast": None if step.remains is None else forecast_object(step.remains),
    }


def residual_object(residual: Residual) -> dict[str, Any]:
    """Give what JSON has of measured levels and twin."""
    return {
        **keyed_fields(residual, middles="frequency_Hz"),
        "explained": residual.explained,
        "sentences": residual.sentences,
    }
