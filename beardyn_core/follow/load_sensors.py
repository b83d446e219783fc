"""Sensors of a train that give the load on a journal, each with its characteristic and its errors.

A sensor is written as its kind with its numbers: ``air_spring pressure_bar=4.1 area_m2=0.15
dead_mass_kg=700``. Half widths of 90 % intervals are among the numbers; the usual ones are assumed where no
source is named.

References
----------
OIML R 106-1 (2011), automatic rail-weighbridges: in service, classes 0.2 to 2 hold a wagon within 0.2 to
2 %. International Society for Weigh-in-Motion, rail WIM: typically 2 % of the vehicle and 5 % of an axle.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, dataclass
from datetime import date
from math import hypot
from typing import Annotated as A
from typing import Any, Protocol

from beardyn_core.base.edge import At, kind_of, places, refuse
from beardyn_core.base.errors import InputError
from beardyn_core.base.units import STANDARD_GRAVITY
from beardyn_core.follow.known_load import LEAST_N, MOST_N, KnownLoad, checked


class LoadSensor(Protocol):
    """A sensor of the vertical load."""

    def load(self) -> KnownLoad:
        """Give the load on the journal."""


@dataclass(frozen=True)
class AirSpring:
    """Pressure of the air spring above the journal, with its area and the mass that it does not carry."""

    pressure: A[float, At("bar", gt=0.0, le=12.0), "gauge pressure of the air spring"]
    area: A[float, At("m2", gt=0.0, ge=0.01, le=1.0), "effective area at the usual height"]
    dead_mass: A[float, At("kg", ge=0.0, le=5000.0), "on this journal below the air spring: frame, drive"]
    journals: A[int, At(ge=1, le=4), "that share the air spring"] = 2
    pressure_error: A[float, At("bar", ge=0.0, le=2.0), "half of the 90 % interval"] = 0.1e5
    area_error: A[float, At("percent", ge=0.0, le=30.0), "half of the 90 % interval, with the height"] = 0.05
    dead_mass_error: A[float, At("percent", ge=0.0, le=50.0), "half of the 90 % interval"] = 0.1
    sharing_error: A[
        float, At("percent", ge=0.0, le=50.0), "half of the 90 % interval of the share of this journal"
    ] = 0.06

    def __post_init__(self) -> None:
        refuse(self, "air_spring")

    def load(self) -> KnownLoad:
        """Give the load on the journal: pressure times area, shared, and the weight below the spring."""
        spring = self.pressure * self.area / self.journals
        dead = self.dead_mass * STANDARD_GRAVITY
        around = hypot(
            spring * hypot(self.pressure_error / self.pressure, self.area_error, self.sharing_error),
            dead * self.dead_mass_error,
        )
        return KnownLoad(spring + dead, around, f"air spring at {self.pressure / 1e5:.3g} bar")


@dataclass(frozen=True)
class PrimarySpring:
    """Deflection of the primary spring of the axlebox, beyond that at a known load."""

    deflection: A[float, At("mm", ge=-200.0, le=200.0), "now, beyond that at the tare load"]
    stiffness: A[float, At("kN_per_mm", gt=0.0, le=100.0), "vertical, of all springs of this axlebox"]
    tare: A[float, At("kN", gt=0.0, ge=1.0, le=400.0), "load on the journal at deflection 0"]
    deflection_error: A[
        float, At("mm", ge=0.0, le=50.0), "half of the 90 % interval, with creep and temperature"
    ] = 1.0e-3
    stiffness_error: A[float, At("percent", ge=0.0, le=50.0), "half of the 90 % interval"] = 0.08
    tare_error: A[float, At("percent", ge=0.0, le=30.0), "half of the 90 % interval"] = 0.03

    def __post_init__(self) -> None:
        refuse(self, "spring")

    def load(self) -> KnownLoad:
        """Give the load on the journal: that at tare and what the spring has yielded since."""
        more = self.stiffness * self.deflection
        around = hypot(
            more * self.stiffness_error, self.stiffness * self.deflection_error, self.tare * self.tare_error
        )
        where = f"spring {1e3 * self.deflection:+.3g} mm from tare"
        return KnownLoad(self.tare + more, around, where)


@dataclass(frozen=True)
class WeighingSite:
    """Load of the axle at a weighing site on a day, with what may have changed since."""

    axle_load: A[float, At("t", gt=0.0, ge=1.0, le=60.0), "mass on the rail under this axle, [kg]"]
    wheelset_mass: A[float, At("t", ge=0.1, le=5.0), "what the journals do not carry, [kg]"]
    day: A[str, At(), "of the weighing, YYYY-MM-DD"]
    error: A[float, At("percent", ge=0.0, le=30.0), "half of the 90 % interval of an axle, in motion"] = 0.05
    side_error: A[
        float, At("percent", ge=0.0, le=50.0), "half of the 90 % interval of the share of this side"
    ] = 0.04
    changed: A[
        float, At("percent", ge=0.0, le=90.0), "half of the 90 % interval of the change since that day"
    ] = 0.1

    def __post_init__(self) -> None:
        refuse(self, "weighing")

    def load(self) -> KnownLoad:
        """Give the load on the journal: half of what the axle carries less its own mass."""
        try:
            date.fromisoformat(self.day)
        except ValueError:
            raise InputError(
                f"weighing: day is {self.day!r}; write YYYY-MM-DD, a day that is in the calendar"
            ) from None
        carried = 0.5 * (self.axle_load - self.wheelset_mass) * STANDARD_GRAVITY
        if carried <= 0.0:
            raise InputError(
                f"weighing: axle_load_t is {self.axle_load / 1e3:g}, not more than wheelset_mass_t "
                f"({self.wheelset_mass / 1e3:g})"
            )
        axle = 0.5 * self.axle_load * STANDARD_GRAVITY * self.error
        around = hypot(axle, carried * self.side_error, carried * self.changed)
        return KnownLoad(carried, around, f"weighing of {self.day}")


SENSORS: Mapping[str, type[AirSpring] | type[PrimarySpring] | type[WeighingSite]] = {
    "air_spring": AirSpring,
    "spring": PrimarySpring,
    "weighing": WeighingSite,
}
"""Kinds of sensors by the word that begins their text."""


def read_sensor(text: str, name: str = "--load-sensor") -> KnownLoad:
    """Read a sensor of the load from a text, and give its load.

    Parameters
    ----------
    text : str
        Kind and numbers, such as ``spring deflection_mm=12 stiffness_kN_per_mm=1.1 tare_kN=55``.
    name : str
        What the text is called in messages.

    Raises
    ------
    InputError
        With every mistake.
    """
    kind, *words = text.split() if text.strip() else [""]
    if kind not in SENSORS:
        raise InputError(f"{name}: {kind!r} is no sensor of the load; allowed are {', '.join(SENSORS)}")
    noun = SENSORS[kind]
    known = {place.key: place for place in places(noun)}
    given: dict[str, Any] = {}
    problems = []
    for word in words:
        key, sign, value = word.partition("=")
        if not sign or key not in known or known[key].field in given:
            problems.append(f"{name}: {kind} has {word!r}; write each KEY=NUMBER once, of {', '.join(known)}")
            continue
        place = known[key]
        try:
            given[place.field] = (
                place.at.scale.to_si(float(value)) if kind_of(place) is float else kind_of(place)(value)
            )
        except ValueError:
            problems.append(f"{name}: {key} of {kind} is {value!r}; it must be a number")
    written = [word.partition("=")[0] for word in words]
    problems += [
        f"{name}: {kind} has no {place.key}; give {place.words}"
        for place in known.values()
        if place.default is MISSING and place.key not in written
    ]
    if problems:
        raise InputError(problems)
    try:
        found: KnownLoad = noun(**given).load()
    except InputError as error:
        raise InputError([f"{name}: {each}" for each in error.problems]) from None
    if not LEAST_N <= found.value <= MOST_N:
        raise InputError(
            f"{name} {kind}: gives {found.value / 1e3:.4g} kN on one journal; allowed are "
            f"{LEAST_N / 1e3:g} to {MOST_N / 1e3:g} kN: check the units"
        )
    assumed = [place.key for place in places(noun) if place.field not in given and "error" in place.key]
    assumed += ["changed_percent"] if noun is WeighingSite and "changed" not in given else []
    usual = f"usual {', '.join(assumed)} assumed" if assumed else ""
    return checked(KnownLoad(found.value, found.half_width, found.source, usual), f"{name} {kind}")
