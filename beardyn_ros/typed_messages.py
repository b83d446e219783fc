"""Messages of the topic table as messages of the package beardyn_msgs, with the same content.

The package is built with colcon from ``interfaces/beardyn_msgs``; without it nothing here is used.
"""

from __future__ import annotations

import json
import math
from array import array
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from importlib import import_module
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray
from std_msgs.msg import Header

from beardyn_core.record.cloud_layout import cloud_points
from beardyn_core.record.encoding import ACCELERATION_AXES
from beardyn_core.record.messages import (
    decode_diagnostics,
    decode_string,
    decode_told,
    header_frame,
    header_stamp,
)
from beardyn_core.record.plot_values import CODES
from beardyn_core.scene.load import WRENCH_AXES
from beardyn_core.study.monitored_recording import Finding

PACKAGE = "beardyn_msgs"
PREFIX = "typed/"
_UNKNOWN = 255  # code of a verdict or health that has none
_FORCE_UNITS = ("N", "N", "N", "N m", "N m", "N m")
_BOGIE = ("ux", "uy", "uz")
_AS_FOUND = tuple(
    each.name
    for each in fields(Finding)
    if each.name not in ("verdict", "reason", "time", "not_judged", "also_fits")
)


def message_types() -> Any:
    """Import the messages of beardyn_msgs; ``None`` where the package is not built and sourced."""
    try:
        return import_module(f"{PACKAGE}.msg")
    except ImportError:
        return None


@dataclass(frozen=True)
class TypedMessage:
    """How the messages of one topic are converted."""

    type_name: A[str, "in beardyn_msgs"]
    convert: A[
        Callable[[Any, bytes, str], Any], "of the message classes, the bytes and the frame of the axlebox"
    ]


def typed_message(name: str) -> TypedMessage | None:
    """Find the conversion of a topic of the table; ``None``: it has none."""
    return _CONVERSIONS.get("vibration" if name.startswith("vibration/") else name)


def _header(cdr: bytes) -> Header:
    return _stamped(header_stamp(cdr), header_frame(cdr))


def _stamped(stamp_ns: int, frame: str) -> Header:
    header = Header(frame_id=frame)
    header.stamp.sec, header.stamp.nanosec = divmod(stamp_ns, 1_000_000_000)
    return header


def _column(points: NDArray[Any], name: str, code: str) -> array[Any]:
    """Copy a column of a cloud into an array of the type code of ``array``; empty where there is none."""
    kind = {"f": "<f4", "d": "<f8", "I": "<u4"}[code]
    members = points.dtype.names or ()
    return array(code, np.ascontiguousarray(points[name], kind).tobytes() if name in members else b"")


def _waveform(axes: Sequence[str], units: Sequence[str]) -> Callable[[Any, bytes, str], Any]:
    def convert(types: Any, cdr: bytes, _frame: str) -> Any:
        points = cloud_points(cdr)
        return types.Waveform(
            header=_header(cdr),
            sample=_column(points, "sample", "I"),
            t=_column(points, "t", "I"),
            channels=[
                types.Channel(name=axis, unit=unit, data=_column(points, axis, "f"))
                for axis, unit in zip(axes, units, strict=True)
            ],
        )

    return convert


def _load_block(types: Any, cdr: bytes, _frame: str) -> Any:
    points = cloud_points(cdr)
    return types.LoadBlock(
        header=_header(cdr),
        sample=_column(points, "sample", "I"),
        t=_column(points, "t", "I"),
        **{name: _column(points, name, "d") for name in (*WRENCH_AXES, "shaft_speed", *_BOGIE)},
    )


def _verdict(types: Any, cdr: bytes, frame: str) -> Any:
    stamp_ns, statuses = decode_diagnostics(cdr)
    status = statuses[0]
    finding = Finding.from_diagnostic(status)
    if finding is None:
        raise ValueError("a status without a verdict is no result of a monitor")
    return types.Verdict(
        header=_stamped(stamp_ns, frame),
        code=CODES.get(finding.verdict, _UNKNOWN),
        verdict=finding.verdict,
        reason=finding.reason,
        not_judged=list(finding.not_judged),
        also_fits=list(finding.also_fits),
        last_word=status.value("final") == "true",
        agreeing=int(status.value("agreeing") or 0),
        analyses=int(status.value("analyses") or 0),
        **{name: getattr(finding, name) for name in _AS_FOUND},
    )


def _estimate(types: Any, cdr: bytes, frame: str) -> Any:
    told = decode_told(cdr)
    if "health" not in told:  # the last word of a run without a stretch
        return types.Estimate(
            header=_stamped(0, frame), last_word=True, code=_UNKNOWN, **dict.fromkeys(_NUMBERS, math.nan)
        )
    condition: Mapping[str, Any] = told["condition"] or {}
    remains: Mapping[str, Any] | None = told["forecast"]
    return types.Estimate(
        header=_stamped(round(1e9 * told["time_s"]), frame),
        last_word=bool(told["final"]),
        code=CODES.get(told["health"], _UNKNOWN),
        health=told["health"],
        doubts=told["doubts"],
        changed=told["changed"],
        distance=_number(told["distance_m"]),
        surprise=_number(told["surprise"]),
        strangeness=_number(told["strangeness"]),
        stretches=told["stretches"],
        shaft_frequency=_number(told["shaft_frequency_Hz"]),
        condition=condition.get("name", ""),
        condition_probability=_number(condition.get("probability")),
        condition_set_50=condition.get("set_50", []),
        condition_set_90=condition.get("set_90", []),
        quantities=[_quantity(types, key, each) for key, each in told["estimates"].items()],
        growth=_number(told["growth_m2_per_m"]),
        growth_factor_90=_number(told["growth_factor_90"]),
        names=told["names"],
        covariance=array("d", [_number(each) for row in told["covariance"] for each in row]),
        has_forecast=remains is not None,
        **_forecast(remains or {}),
    )


_NUMBERS = (
    *("distance", "surprise", "strangeness", "shaft_frequency", "condition_probability", "growth"),
    *("growth_factor_90", "widest", "equivalent_load", "life", "reference_life"),
)


def _forecast(remains: Mapping[str, Any]) -> dict[str, Any]:
    return {
        "widest": _number(remains.get("widest_m")),
        "remaining": _numbers(remains.get("remaining_m"), 3),
        "equivalent_load": _number(remains.get("equivalent_load_N")),
        "life": _number(remains.get("life_m")),
        "reference_life": _number(remains.get("reference_life_m")),
        "used": _numbers(remains.get("used"), 3),
    }


def _quantity(types: Any, key: str, told: Mapping[str, Any]) -> Any:
    name, _, unit = key.rpartition("_")
    return types.Quantity(
        name=name,
        unit=unit,
        value=_number(told["value"]),
        interval_50=_numbers(told["interval_50"], 2),
        interval_90=_numbers(told["interval_90"], 2),
        at_least=_number(told["at_least"]),
        reason=told["reason"],
    )


def _truth(types: Any, cdr: bytes, _frame: str) -> Any:
    text = decode_string(cdr)
    found = json.loads(text)
    orders = found.get("fault_frequencies_per_rev", {})
    return types.Truth(
        **{key: str(found.get(key, "")) for key in ("run_id", "scene", "bearing", "tier", "condition")},
        seed=int(found.get("seed") or 0),
        effects=[str(each) for each in found.get("effects", [])],
        defects=[_defect(types, each) for each in found.get("faults", [])],
        **{name.lower(): _number(orders.get(name)) for name in ("FTF", "BPFO", "BPFI", "BSF")},
        json=text,
    )


def _defect(types: Any, told: Mapping[str, Any]) -> Any:
    return types.Defect(
        kind=str(told.get("kind", "")),
        part=str(told.get("on", "")),
        row=int(told.get("row", 0)),
        roller=int(told.get("roller", 0)),
        **{name: _number(told.get(name)) for name in ("azimuth", "width", "length", "depth")},
    )


def _number(told: Any) -> float:
    """Read a number of JSON, where what is not known is null."""
    return math.nan if told is None else float(told)


def _numbers(told: Sequence[Any] | None, count: int) -> list[float]:
    return [math.nan] * count if told is None else [_number(each) for each in told]


_CONVERSIONS: Mapping[str, TypedMessage] = {
    "vibration": TypedMessage("Waveform", _waveform(ACCELERATION_AXES, ("m/s^2",) * 3)),
    "force_waveform": TypedMessage("Waveform", _waveform(WRENCH_AXES, _FORCE_UNITS)),
    "load/blocks": TypedMessage("LoadBlock", _load_block),
    "monitor/result": TypedMessage("Verdict", _verdict),
    "follower/estimate": TypedMessage("Estimate", _estimate),
    "truth": TypedMessage("Truth", _truth),
}
"""By name in the topic table."""
TYPED = tuple(_CONVERSIONS)
