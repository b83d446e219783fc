"""Excitation events of a run as truth: irregularity, strikes of the wheel, joints passed, with times."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi
from typing import Any

import numpy as np

from beardyn_core.rail.excitation import waves_of
from beardyn_core.rail.roughness import select_roughness
from beardyn_core.rail.spectra import spectrum_band
from beardyn_core.scene import excitation
from beardyn_core.scene.operation import MeasuredOperation, QuarterVehicleOperation
from beardyn_core.scene.running import distance_at, speed_at
from beardyn_core.scene.scene import Scene

Event = dict[str, Any]

MOST_TIMES = 200  # of one kind of event; more are only counted
_SPACING = 2e-3  # between the instants at which the travel is looked at, [s]
_MOST_INSTANTS = 500_000


class _Travel:
    """Travelled distance of the wheel along the track over time."""

    def __init__(self, operation: QuarterVehicleOperation, duration: float) -> None:
        count = min(int(np.ceil(duration / _SPACING)), _MOST_INSTANTS) + 1
        self.time = np.linspace(0.0, duration, count)
        self.distance = distance_at(operation.speed_profile, self.time)
        self.speed = speed_at(operation.speed_profile, self.time)

    def passages(self, first: float, spacing: float | None, endless: bool = False) -> dict[str, Any]:
        """List times and distances at which places are passed: one, or evenly spaced ones."""
        if spacing is None:  # -1 before the place, 0 behind it
            passed = (self.distance >= first).astype(np.int64) - 1
        else:
            passed = np.floor((self.distance - first) / spacing).astype(np.int64)
        many = np.abs(np.diff(passed))
        begin = np.repeat(np.arange(len(many)), many)
        nth = np.arange(len(begin)) - np.repeat(np.cumsum(many) - many, many)
        forwards = passed[begin + 1] > passed[begin]
        number = np.where(forwards, passed[begin] + 1 + nth, passed[begin] - nth)
        if not endless:
            begin, number = begin[number >= 0], number[number >= 0]
        place = first + (0.0 if spacing is None else spacing) * number
        gone = self.distance[begin + 1] - self.distance[begin]
        share = (place - self.distance[begin]) / gone
        time = self.time[begin] + share * (self.time[begin + 1] - self.time[begin])
        return {
            "count": len(time),
            "time_s": np.round(time[:MOST_TIMES], 6).tolist(),
            "distance_m": np.round(place[:MOST_TIMES], 4).tolist(),
        }


def events_of(scene: Scene) -> dict[str, Any]:
    """List everything that excites a run besides the bearing, JSON-able.

    Returns
    -------
    dict
        ``load``: where load and speed come from, a sentence; ``irregularity``: kind, band and seed, of a
        run on a track; ``events``: one entry for each excitation with its ``kind``, its sizes in SI and
        its times [s] and distances [m], of at most `MOST_TIMES` passes, ``count`` says how many there are;
        ``background``: the name of what else sensors measure, where there is one.
    """
    found = _operation(scene)
    return found if scene.background is None else {**found, "background": scene.background.name}


def _operation(scene: Scene) -> dict[str, Any]:
    operation = scene.operation
    if isinstance(operation, QuarterVehicleOperation):
        travel = _Travel(operation, scene.duration)
        return {
            "load": f"{operation.vehicle.name} on its track",
            "distance_m": round(float(travel.distance[-1]), 3),
            "irregularity": _irregularity(operation.irregularity, scene),
            "events": [
                *_wheel(operation, travel),
                *_rail(operation.rail_defects, travel),
                *_curves(operation, travel),
                *_runs(travel),
            ],
        }
    if isinstance(operation, MeasuredOperation):
        taken = {"both": "force and speed", "force": "force", "speed": "speed"}[operation.take]
        return {"load": f"{taken} measured, {operation.path.name}", "events": []}
    return {"load": "as written in the scene", "events": []}


def _irregularity(irregularity: excitation.Irregularity, scene: Scene) -> dict[str, Any]:
    found: dict[str, Any] = {"kind": irregularity.kind}
    if irregularity.path is not None:
        found["file"] = irregularity.path.name
    if irregularity.kind not in ("none", "csv"):
        found["wavelength_m"] = list(spectrum_band(irregularity))
    roughness, _ = select_roughness(irregularity, scene.background)
    if roughness.rail != "none":
        found["short_waves"] = roughness.rail
    if irregularity.kind not in ("none", "csv") or roughness.rail != "none":
        found["seed"] = scene.seed
    return found


def _wheel(operation: QuarterVehicleOperation, travel: _Travel) -> Iterator[Event]:
    radius = 0.5 * operation.wheel_diameter
    round_ = 2.0 * pi * radius
    top = float(np.abs(travel.speed).max())
    for defect in operation.wheel_defects:
        if isinstance(defect, excitation.WheelFlat):
            yield {
                "kind": "wheel_flat",
                "length_m": defect.length,
                "depth_m": defect.depth_on(radius),
                "shape": defect.shape,
                "period_m": round_,
                "top_frequency_Hz": top / round_,
                **travel.passages((pi - defect.azimuth) * radius, round_, endless=True),
            }
        elif isinstance(defect, excitation.WheelPolygon):
            yield {
                **_waves((defect,), radius),
                "kind": "polygon",
                "top_frequency_Hz": defect.order * top / round_,
            }
        elif isinstance(defect, excitation.WheelOutOfRound):
            waves = _waves(waves_of(defect), radius)
            yield {"kind": "out_of_round", "seed": defect.seed, **waves}


def _waves(waves: tuple[excitation.WheelPolygon, ...], radius: float) -> dict[str, Any]:
    return {
        "orders": [wave.order for wave in waves],
        "amplitudes_m": [wave.amplitude for wave in waves],
        "period_m": 2.0 * pi * radius,
    }


def _rail(defects: tuple[excitation.RailDefect, ...], travel: _Travel) -> Iterator[Event]:
    for defect in defects:
        if isinstance(defect, excitation.DippedJoint):
            sizes: Event = {"kind": "dipped_joint", "angle_rad": defect.angle, "length_m": defect.length}
            yield {**sizes, **travel.passages(defect.position, defect.spacing)}
        elif isinstance(defect, excitation.DippedWeld):
            sizes = {"kind": "dipped_weld", "depth_m": defect.depth, "length_m": defect.length}
            yield {**sizes, **travel.passages(defect.position, defect.spacing)}
        elif isinstance(defect, excitation.Crossing):
            sizes = {"kind": "crossing", "depth_m": defect.depth, "angle_rad": defect.angle}
            yield {**sizes, **travel.passages(defect.position, None)}
        elif isinstance(defect, excitation.Corrugation):
            yield {
                "kind": "corrugation",
                "wavelength_m": defect.wavelength,
                "amplitude_m": defect.amplitude,
                "top_frequency_Hz": float(np.abs(travel.speed).max()) / defect.wavelength,
                **_stretch(defect.begin, defect.end, travel),
            }


def _stretch(begin: float, end: float, travel: _Travel) -> dict[str, Any]:
    """Find distances and times between which the wheel is on a stretch, `None` where it stays on it."""
    inside = (travel.distance >= begin) & (travel.distance <= end)
    if not inside.any():
        return {"count": 0, "begin_s": None, "end_s": None, "begin_m": begin, "end_m": None}
    met = np.flatnonzero(inside)
    return {
        "count": 1,
        "begin_s": round(float(travel.time[met[0]]), 3),
        "end_s": round(float(travel.time[met[-1]]), 3),
        "begin_m": begin,
        "end_m": end if np.isfinite(end) else None,
    }


def _curves(operation: QuarterVehicleOperation, travel: _Travel) -> Iterator[Event]:
    for curve in operation.curves:
        yield {
            "kind": "curve",
            "radius_m": curve.radius,
            "cant_m": curve.cant,
            "hand": curve.hand,
            "transition_m": curve.transition,
            **_stretch(curve.begin, curve.begin + curve.length, travel),
        }


def _runs(travel: _Travel) -> Iterator[Event]:
    """List standstills, and the starts after them in either direction."""
    moving = np.sign(np.where(np.abs(travel.speed) < 1e-6, 0.0, travel.speed))
    changes = np.flatnonzero(np.diff(moving) != 0.0) + 1
    words = {0.0: "standstill", 1.0: "forwards", -1.0: "backwards"}
    for at in changes:
        yield {
            "kind": words[float(moving[at])],
            "count": 1,
            "time_s": [round(float(travel.time[at]), 3)],
            "distance_m": [round(float(travel.distance[at]), 3)],
        }
