"""What a person says about measured files: one declaration of every option.

From a field follow the argument of ``read_measured`` with the unit in its name (``rate_Hz``), the option of
the command line (``--rate-hz``), its limits and its words.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

from beardyn_core.base.edge import At, Place, kind_of, places, refuse
from beardyn_core.base.errors import InputError
from beardyn_core.measured.units import ACCELERATION, ROTATION, TIME, TRAVEL

SEPARATORS = {"comma": ",", "semicolon": ";", "tab": "\t", "bar": "|", "space": None}
RPM = ROTATION["rpm"]
DECIMALS = {"point": ".", "comma": ","}


@dataclass(frozen=True, kw_only=True)
class Reading:
    """How measured files are to be read; what is not said is taken from the file, or asked for."""

    channels: A[
        tuple[str, ...],
        At(),
        "which channel is which axis of the accelerometer: z=NAME or x=NAME,y=NAME,z=NAME; of several "
        "accelerometers SENSOR:z=NAME for each; NAME may have * and ?, or be the number of a column from 1; "
        "default the only channel, as z, or those called x, y and z",
    ] = ()
    unit: A[str, At(one_of=("", *ACCELERATION)), "of the acceleration; default that of the file"] = ""
    scale: A[
        float,
        At(ge=-1e12, le=1e12),
        "the numbers times this are in that unit: 10 for volts of a sensor of 100 mV/g in g, the range for a "
        "WAV file of whole numbers",
    ] = 1.0
    rate: A[float | None, At("Hz", gt=0.0, ge=1.0, le=1e8), "sampling rate; default that of the file"] = None
    speed: A[float | None, At("rpm", gt=0.0, le=1e6), "constant speed of the shaft"] = None
    vehicle_speed: A[
        float | None,
        At("kmh", gt=0.0, le=1000.0, key="speed"),
        "constant speed of the vehicle, with the wheel diameter",
    ] = None
    wheel_diameter: A[float | None, At("mm", gt=0.0, ge=100.0, le=3000.0), "over the running tread"] = None
    speed_range_rpm: A[
        str,
        At(),
        "LOW:HIGH, rough limits of the speed, at most a factor of two apart, between which it is "
        "found in the "
        "vibration itself; needs the bearing; default none",
    ] = ""
    speed_channel: A[
        str, At(), "channel with the speed, or the name of a number in the file; * and ? as above"
    ] = ""
    speed_unit: A[
        str,
        At(one_of=("", *ROTATION, *TRAVEL)),
        "of that channel; default that of the file or of its name; km/h and m/s need the wheel diameter",
    ] = ""
    tacho_channel: A[str, At(), "channel with the pulses of a tachometer; * and ? as above"] = ""
    pulses_per_turn: A[int, At(ge=1, le=100_000), "of the tachometer"] = 1
    tacho_level: A[
        float | None,
        At(ge=-1e12, le=1e12),
        "a pulse begins where its channel rises through this; default the middle between the "
        "levels of its pulses",
    ] = None
    load_channel: A[
        str,
        At(),
        "channel with the vertical load on this journal, for beardyn estimate and follow; * and ? as above",
    ] = ""
    load_unit: A[str, At(one_of=("", "N", "kN", "t", "kg")), "of that channel; default that of the file"] = ""
    load_error: A[
        float | None,
        At("percent", gt=0.0, le=50.0),
        "half of the 90 % interval of its mean; default 10 % are assumed",
    ] = None
    time_channel: A[
        str, At(), "channel with the time stamps; default one called time; none: there is none"
    ] = ""
    time_unit: A[str, At(one_of=("", *TIME)), "of the time stamps; default that of the file, else s"] = ""
    separator: A[
        str, At(one_of=("", *SEPARATORS)), "between the columns of a text file; default what fits"
    ] = ""
    decimal: A[str, At(one_of=("", *DECIMALS)), "decimal sign in a text file; default what fits"] = ""
    file_interval: A[
        float | None,
        At("s", gt=0.0, le=1e9),
        "from the beginning of a file to that of the next; default each begins where the one before ends",
    ] = None

    def rules(self) -> Iterator[str]:
        """Check that speed is given in one way, and what belongs to it."""
        ways = {
            "speed_rpm": self.speed is not None,
            "speed_kmh": self.vehicle_speed is not None,
            "speed_range_rpm": bool(self.speed_range_rpm),
            "speed_channel": bool(self.speed_channel),
            "tacho_channel": bool(self.tacho_channel),
        }
        given = [name for name, there in ways.items() if there]
        if len(given) > 1:
            yield f"{' and '.join(given)} are given; give one of {', '.join(ways)}"
        travels = self.vehicle_speed is not None or self.speed_unit in TRAVEL
        if travels and self.wheel_diameter is None:
            yield "wheel_diameter_mm is not given; the speed of a vehicle needs it"
        if self.speed_range_rpm and self.speed_range is None:
            yield (
                f"speed_range_rpm is {self.speed_range_rpm!r}; it must be LOW:HIGH such as "
                "1400:1800, both above 0 "
                "and at most a factor of two apart"
            )
        if (self.load_unit or self.load_error is not None) and not self.load_channel:
            yield "load_unit and load_error_percent are of load_channel, which is not given"
        if self.scale == 0.0:
            yield "scale is 0; it must be another number"
        if self.separator == "comma" and self.decimal == "comma":
            yield "separator and decimal are both comma; they must differ"

    @property
    def speed_range(self) -> tuple[float, float] | None:
        """Limits between which the speed is sought in the vibration, [rad/s]; ``None`` where it is not."""
        try:
            low, high = (float(each) * RPM for each in self.speed_range_rpm.split(":"))
        except ValueError:
            return None
        return (low, high) if 0.0 < low < high <= 2.0 * low else None

    @classmethod
    def of(cls, **given: Any) -> Reading:
        """Make it of arguments in the units of their names; None stands for not given.

        Raises
        ------
        InputError
            With every mistake.
        """
        known = {place.key: place for place in places(cls)}
        problems = [
            f"{key} is no option of measured files; allowed are {', '.join(known)}"
            for key in given
            if key not in known
        ]
        values: dict[str, Any] = {}
        for key, value in given.items():
            if key in known and value is not None:
                try:
                    values[known[key].field] = _convert_value(known[key], value)
                except (TypeError, ValueError):
                    problems.append(f"{key} is {value!r}; it must be {_wanted_type(known[key])}")
        if problems:
            raise InputError(problems)
        made = cls(**values)
        refuse(made, "measured files")
        return made


def _convert_value(place: Place, value: Any) -> Any:
    kind = kind_of(place)
    if place.field == "channels":
        if isinstance(value, Mapping):
            value = ",".join(f"{axis}={name}" for axis, name in value.items())
        return (value,) if isinstance(value, str) else tuple(str(each) for each in value)
    if kind is str:
        if not isinstance(value, str):
            raise TypeError
        return value
    if isinstance(value, bool | str):
        raise TypeError
    return place.at.scale.to_si(float(value)) if kind is float else kind(value)


def _wanted_type(place: Place) -> str:
    words = {float: "a number", int: "a whole number", str: "a text"}
    return "a text or several" if place.field == "channels" else words[kind_of(place)]
