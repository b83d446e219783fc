"""Descriptors: what an estimator reads of a stretch of vibration; all can be had of a measured axlebox."""

from __future__ import annotations

from math import isfinite, log10, nan

import numpy as np
from scipy.fft import rfft

from beardyn_core.base.arrays import Float, Int
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow import entry_exit_features, event_order, passage_profile
from beardyn_core.monitor.chain import FAULTS, REFERENCE, MonitorSettings, Stretch
from beardyn_core.monitor.passage_order import find_passage_order
from beardyn_core.monitor.severity import narrow_width

AXES = ("x", "y", "z")
RACEWAYS = ("cup", "cone")
THIRDS = tuple(1000.0 * 2.0 ** (k / 3.0) for k in range(-16, 11))  # middles of third octaves, 25 Hz to 10 kHz
FINE = tuple(300.0 * 2.0 ** (k / 12.0) for k in range(40))  # where the box rings on its bearing
LEVEL_FLOOR = 1e-6  # below which no level is distinguished from silence, [m/s^2]
_PASSINGS = (1, 2, 3)  # multiples of the rollers' passing
_TURNS = (1, 2)  # multiples of the shaft
_BESIDE = 0.35  # of an order: how far the lines lie that a line is compared with


LEVELS_OF_BOX = ("band_", "fine_")
"""Beginnings of the names of levels, which box and sensor place change most."""
_LINES_OF_BOX = ("passing_", "turn_", "strongest_level")
_OF_PASSAGES = (*entry_exit_features.NAMES, *passage_profile.NAMES)
_PROFILE = (*passage_profile.NAMES, *event_order.NAMES)


def places_of(axes: tuple[str, ...], family: str) -> Int:
    """List the places of descriptors of a family.

    ``box`` are levels of the bands in which a box rings on its bearing; ``passages`` is what repeats with
    the passages of a fault; ``shape`` is everything that has no level in it, so that a box changes it
    little; ``levels`` is all but the profile of the passages and the order of its events.
    """
    wanted = {
        "box": lambda name: name.startswith("fine_"),
        "passages": lambda name: name in _OF_PASSAGES,
        "shape": lambda name: not name.startswith((*LEVELS_OF_BOX, *_LINES_OF_BOX, *event_order.CONTRASTS)),
        "levels": lambda name: name not in _PROFILE,
    }[family]
    return np.array([k for k, name in enumerate(names_of(axes)) if wanted(name)], np.int64)


def names_of(axes: tuple[str, ...]) -> tuple[str, ...]:
    """Name the descriptors of a sensor with these axes, in their order."""
    lines = [f"passing_{k}" for k in _PASSINGS] + [f"turn_{k}" for k in _TURNS]
    return (
        "shaft",
        *(f"score_{part}" for part in FAULTS),
        *("score", "kurtosis", "crest", "strongest_level"),
        *(f"way_{part}" for part in RACEWAYS),
        *("louder", "way", *entry_exit_features.NAMES, *passage_profile.NAMES, *event_order.NAMES),
        *(f"band_{axis}_{middle:.0f}" for axis in axes for middle in THIRDS),
        *(f"fine_{axis}_{middle:.0f}" for axis in axes for middle in FINE),
        *(f"{line}_{what}_{axis}" for axis in axes for line in lines for what in ("level", "lead")),
    )


def describe(stretch: Stretch, orders: FaultFrequencies, plate: NamePlate, axes: tuple[str, ...]) -> Float:
    """Work out the descriptors of a stretch.

    Parameters
    ----------
    stretch : Stretch
        In which the shaft turns one way; an axis of vibration for each of `axes`.
    orders : FaultFrequencies
        Of one row, per shaft revolution.
    plate : NamePlate
    axes : tuple of str
        Of ``x``, ``y`` and ``z``.

    Returns
    -------
    float64 array, shape [descriptor]
        In the order of `names_of`; levels in dB, NaN where there is nothing to be worked out.
    """
    nominal = {"cup": orders.bpfo, "cone": orders.bpfi}
    passed = {
        part: find_passage_order(stretch.acceleration, stretch.rate, stretch.shaft_angle, order)
        for part, order in nominal.items()
    }
    found = {
        "shaft": log10(max(stretch.shaft_frequency, LEVEL_FLOOR)),
        **_of_monitor(stretch, orders, plate),
        **_ways(stretch, passed, plate),
    }
    louder = RACEWAYS[int(found["score_cone"] > found["score_cup"])]
    found |= {"louder": float(RACEWAYS.index(louder)), "way": found[f"way_{louder}"]}
    found |= entry_exit_features.of_passages(stretch, louder, passed[louder], plate)
    found |= passage_profile.profile_of(stretch, louder, passed[louder], plate)
    found |= event_order.order_of_events(stretch, louder, passed[louder], plate, axes)
    for k, axis in enumerate(axes):
        received = stretch.acceleration[:, k] - stretch.acceleration[:, k].mean()
        for name, middles, share in (("band", THIRDS, 3), ("fine", FINE, 12)):
            levels = band_levels(received, stretch.rate, middles, share)
            found |= {f"{name}_{axis}_{middle:.0f}": level for middle, level in levels.items()}
    found |= _lines(stretch, orders, axes)
    return np.array([found[name] for name in names_of(axes)])


def _of_monitor(stretch: Stretch, orders: FaultFrequencies, plate: NamePlate) -> dict[str, float]:
    """Ask the reference monitor how strong the lines of each part are."""
    result = REFERENCE(stretch, orders, plate.roller_count, MonitorSettings())
    known = result.verdict != "waiting"
    scores = result.scores if known else (nan,) * len(FAULTS)
    return {
        **{f"score_{part}": float(score) for part, score in zip(FAULTS, scores, strict=True)},
        **{
            name: float(getattr(result, name)) if known else nan
            for name in ("score", "kurtosis", "crest", "strongest_level")
        },
    }


def _ways(stretch: Stretch, passed: dict[str, float], plate: NamePlate) -> dict[str, float]:
    """Measure how far entry and exit are apart on cup and cone, [mm]; 0 where no second event stands out."""
    found = {}
    for part, order in passed.items():
        width = narrow_width(stretch.acceleration, stretch.rate, stretch.shaft_angle, part, order, plate)
        found[f"way_{part}"] = 1e3 * width if isfinite(width) else 0.0
    return found


def band_levels(signal: Float, rate: float, middles: tuple[float, ...], share: int) -> dict[float, float]:
    """Measure bands, so many to an octave, against 1 m/s^2, [dB]; NaN from half of the sampling rate on."""
    power = np.abs(rfft(signal * np.hanning(len(signal)))) ** 2 / len(signal) ** 2 * (2.0 * 8.0 / 3.0)
    sums = np.concatenate([[0.0], np.cumsum(power)])
    bands = bands_of(middles, share, rate, len(signal))
    return {
        middle: nan if band is None else _level(float(sums[band.stop] - sums[band.start]))
        for middle, band in zip(middles, bands, strict=True)
    }


def bands_of(middles: tuple[float, ...], share: int, rate: float, samples: int) -> list[slice | None]:
    """Find the lines of bands, so many to an octave, in the spectrum of a signal; none beyond it."""
    frequency, half = np.arange(samples // 2 + 1) * rate / samples, 2.0 ** (0.5 / share)
    found: list[slice | None] = []
    for middle in middles:
        first, last = np.searchsorted(frequency, [middle / half, middle * half]).tolist()
        inside = middle * half < 0.5 * rate and last > first
        found.append(slice(first, last) if inside else None)
    return found


def _lines(stretch: Stretch, orders: FaultFrequencies, axes: tuple[str, ...]) -> dict[str, float]:
    """Measure lines of the rollers' passing and of the shaft: level and lead over their neighbours, [dB]."""
    wanted = {f"passing_{k}": k * orders.bpfo for k in _PASSINGS} | {f"turn_{k}": float(k) for k in _TURNS}
    centred = stretch.acceleration - stretch.acceleration.mean(axis=0)
    weighted = centred * np.hanning(len(centred))[:, None] * 2.0
    found = {}
    for name, order in wanted.items():
        beside = [order + shift * _BESIDE for shift in (-1.0, 0.0, 1.0)]
        power = np.array([_line(weighted, stretch.shaft_angle, each) for each in beside])
        for k, axis in enumerate(axes):
            found[f"{name}_level_{axis}"] = _level(power[1, k])
            found[f"{name}_lead_{axis}"] = _level(power[1, k]) - _level(0.5 * (power[0, k] + power[2, k]))
    return found


def _line(weighted: Float, angle: Float, order: float) -> Float:
    """Compute the power of a line that follows the angle of the shaft, shape [axis], [m^2/s^4]."""
    turned = order * angle
    along, across = np.cos(turned) @ weighted, np.sin(turned) @ weighted
    return np.asarray(2.0 * (along**2 + across**2) / len(weighted) ** 2, np.float64)


def _level(power: float) -> float:
    return 10.0 * log10(max(power, LEVEL_FLOOR**2))
