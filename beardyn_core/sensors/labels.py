"""Labels of a run for machine learning: condition, load, speed, fault frequencies, dimensions."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.radial_bearing import RadialBearing
from beardyn_core.scene.load import WRENCH_AXES
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Scene

HEALTHY = "healthy"


def scene_labels(scene: Scene) -> dict[str, Any]:
    """Label a scene by the facts that are known before the run.

    Returns
    -------
    dict
        JSON-able, units in the keys: ``condition`` (the parts with a fault, ``healthy`` without),
        ``geometry``, ``temperature_K``, ``end_play_m`` and ``radial_clearance_m`` (null where the kind of
        bearing has none), ``sampling_rate_Hz``, ``wheel_diameter_m`` (null where no wheel belongs to the
        operation), ``duration_s``.
    """
    bearing, operation = scene.bearing, scene.operation
    return {
        "condition": "+".join(sorted({fault.on for fault in scene.faults})) or HEALTHY,
        "geometry": {
            "roller_count": bearing.roller_count,
            "roller_diameter_m": bearing.roller_diameter,
            "pitch_diameter_m": bearing.pitch_diameter,
            "contact_angle_rad": bearing.contact_angle,
            "effective_length_m": bearing.effective_length,
        },
        "lubricant": scene.lubricant.name,
        "temperature_K": scene.temperature,
        "end_play_m": None if bearing.self_aligning else scene.end_play,
        "radial_clearance_m": bearing.radial_clearance if isinstance(bearing, RadialBearing) else None,
        "sampling_rate_Hz": {
            "vibration": {sensor.name: sensor.rate for sensor in scene.sensors},
            "force_waveform": scene.waveform_rate,
        },
        "wheel_diameter_m": operation.wheel_diameter
        if isinstance(operation, QuarterVehicleOperation)
        else None,
        "duration_s": scene.duration,
    }


def load_labels(
    time_ns: NDArray[np.int64], wrench: Float, shaft_speed: Float, truth: Mapping[str, Any]
) -> dict[str, Any]:
    """Label the load and the speed of a run.

    Parameters
    ----------
    time_ns : int64 array, shape [sample], [ns]
    wrench : float64 array, shape [sample, 6]
        On the journal, [N, N m].
    shaft_speed : float64 array, shape [sample], [rad/s]
    truth : mapping
        Gives ``fault_frequencies_per_rev`` and ``wheel_diameter_m``.

    Returns
    -------
    dict
        ``load`` with mean, min and max of ``fx_N``, ``fy_N`` and ``fz_N``; ``speed`` with the same of
        ``rpm`` and, where there is a wheel, ``kmh``; ``fault_frequencies_Hz`` at the mean speed. Means are
        over time. Empty without samples.
    """
    if not len(time_ns):
        return {}
    found: dict[str, Any] = {
        "load": {f"{axis}_N": _range(time_ns, wrench[:, k]) for k, axis in enumerate(WRENCH_AXES[:3])},
        "speed": {"rpm": _range(time_ns, shaft_speed * 30.0 / math.pi)},
    }
    wheel = truth.get("wheel_diameter_m")
    if wheel:
        found["speed"]["kmh"] = _range(time_ns, shaft_speed * 0.5 * wheel * 3.6)
    hertz = abs(found["speed"]["rpm"]["mean"]) / 60.0
    per_rev = truth.get("fault_frequencies_per_rev", {})
    found["fault_frequencies_Hz"] = {name: value * hertz for name, value in per_rev.items()}
    return found


def flat_labels(truth: Mapping[str, Any]) -> dict[str, Any]:
    """Flatten the labels of a truth to the row of a table.

    Nested keys are joined by ``_``: ``load_fz_N_mean``, ``fault_frequencies_Hz_BPFO``. Of the faults the
    first one gives ``fault_on``, ``fault_kind``, ``fault_row``, ``fault_width_m``, ``fault_depth_m`` and
    ``fault_length_m``; lists are left out.

    Parameters
    ----------
    truth : mapping
        See `Run.truth`.
    """
    row = _flat("", truth)
    faults = truth.get("faults") or ()
    if faults:
        sizes = ("width", "depth", "length", "diameter", "clearance")
        first = {**faults[0], **faults[0].get("drawn", {})}
        row |= {f"fault_{key}": first[key] for key in ("on", "kind", "row", "roller") if key in first}
        row |= {f"fault_{key}_m": first[key] for key in sizes if key in first}
    return row


def _flat(prefix: str, part: Mapping[str, Any]) -> dict[str, Any]:
    row: dict[str, Any] = {}
    for key, value in part.items():
        if isinstance(value, Mapping):
            row |= _flat(f"{prefix}{key}_", value)
        elif not isinstance(value, list | tuple):
            row[f"{prefix}{key}"] = value
    return row


def _range(time_ns: NDArray[np.int64], values: Float) -> dict[str, float]:
    """Compute mean over time, smallest and largest value of samples that are linear in between."""
    mean = float(values[0])
    if len(values) > 1:
        steps = np.diff(time_ns).astype(np.float64)
        mean = float((0.5 * (values[1:] + values[:-1])) @ steps / steps.sum())
    return {"mean": mean, "min": float(values.min()), "max": float(values.max())}
