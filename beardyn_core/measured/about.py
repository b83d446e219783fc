"""What a measured recording says about itself: files, channels, units, speed, bearing data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from math import isnan, nan
from typing import Annotated as A
from typing import Any

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.catalogue_entry import CatalogueEntry
from beardyn_core.bearing.factors import SYMBOLS
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.measured.claimed_start import Start
from beardyn_core.measured.load_channel import describe_load
from beardyn_core.measured.stated_speed import uncertainty_of
from beardyn_core.measured.survey import Survey
from beardyn_core.monitor.chain import MonitorSettings

USUAL_LABEL = "bearing"  # of the only one on a shaft


@dataclass(frozen=True)
class Mounted:
    """A bearing on the shaft, and the accelerometer that measures it."""

    label: A[str, "such as ``drive_end``"]
    plate: NamePlate
    sensor: A[str, "name of an accelerometer; empty: the first"] = ""
    entry: A[CatalogueEntry | None, "line of the catalogue that was taken; None: none"] = field(
        default=None, compare=False
    )


def about(survey: Survey, bearings: Sequence[Mounted] = ()) -> dict[str, Any]:
    """Describe measured files, JSON-able, units in the keys."""
    first = survey.files[0]
    speed = first.chosen.speed
    sensors = {}
    for sensor in first.chosen.sensors:
        sensors[sensor.name] = {
            "rate_Hz": survey.rate(sensor.name),
            "channels": {axis: found.channel.name for axis, found in sensor.axes.items()},
            "m_per_s2_per_number": {axis: found.factor for axis, found in sensor.axes.items()},
        }
    return {
        "duration_s": survey.duration,
        "files": [
            {
                "name": each.chosen.path.name,
                "format": each.chosen.format.name,
                "size_bytes": each.chosen.path.stat().st_size,
                "begin_s": each.begin_ns * 1e-9,
                "date": _date(each.start),
                "says": {**each.chosen.source.facts, **each.chosen.source.numbers},
            }
            for each in survey.files
        ],
        "sensors": sensors,
        "speed": {
            "from": speed.kind if survey.received is None else "vibration",
            "channel": None if speed.channel is None else speed.channel.name,
            "constant_rad_per_s": speed.value if speed.kind == "constant" else None,
            "uncertainty": uncertainty_of(survey),
        },
        "load": describe_load(
            [(each.chosen.load, each.chosen.source) for each in survey.files], survey.reading.load_error
        ),
        "bearings": {each.label: _write_bearing(each) for each in bearings},
        "understood": list(survey.told),
        "warnings": list(survey.warnings),
    }


def beside_others(settings: MonitorSettings, one: Mounted, bearings: Sequence[Mounted]) -> MonitorSettings:
    """Add the other bearings on the shaft to the settings of the monitor of one."""
    others = tuple(
        each.plate.frequencies
        for each in bearings
        if each.label != one.label and each.plate.frequencies != one.plate.frequencies
    )
    return replace(settings, neighbours=tuple(dict.fromkeys((*settings.neighbours, *others))))


def mounted_in(facts: Mapping[str, Any], label: str) -> tuple[Mounted, ...]:
    """Read the bearings that a measured recording names.

    Raises
    ------
    InputError
        They are damaged.
    """
    found = []
    bearings = facts.get("bearings")
    for name, keys in (bearings if isinstance(bearings, Mapping) else {}).items():
        try:
            plate = NamePlate(
                name=str(keys["name"]),
                description=str(keys["description"]),
                roller_count=int(keys["roller_count"] or 0),
                roller_diameter=_number(keys["roller_diameter_m"]),
                pitch_diameter=_number(keys["pitch_diameter_m"]),
                contact_angle=_number(keys["contact_angle_rad"]),
                bpfo=_number(keys.get("bpfo")),
                bpfi=_number(keys.get("bpfi")),
                bsf=_number(keys.get("bsf")),
                ftf=_number(keys.get("ftf")),
                kind=str(keys.get("kind") or ""),
            )
        except (KeyError, TypeError, ValueError) as error:
            raise InputError(
                f"{label}: the data of its bearing {name} is damaged ({error!r}); give --bearing"
            ) from error
        found.append(Mounted(name, plate, str(keys.get("sensor") or "")))
    return tuple(found)


def _write_bearing(mounted: Mounted) -> dict[str, Any]:
    """Write a bearing, SI."""
    plate = mounted.plate
    return {
        "name": plate.name,
        "description": plate.description,
        "kind": plate.kind or None,
        "roller_count": plate.roller_count or None,
        "roller_diameter_m": _known(plate.roller_diameter),
        "pitch_diameter_m": _known(plate.pitch_diameter),
        "contact_angle_rad": _known(plate.contact_angle),
        **{each: value for each in SYMBOLS if (value := _known(getattr(plate, each))) is not None},
        "sensor": mounted.sensor or None,
    }


def _date(start: Start | None) -> str | None:
    """Write when a file began by its own clock, whatever its time zone; ``None`` where it does not say."""
    if start is None or not start.dated:
        return None
    return f"{datetime.fromtimestamp(start.ns * 1e-9, UTC):%Y-%m-%d %H:%M:%S}"


def _number(value: Any) -> float:
    return nan if value is None else float(value)


def _known(value: float) -> float | None:
    return None if isnan(value) else value
