"""The box of a scene: modes by the name or path of their table, seats of sensors, the mounting with it."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from beardyn_core.base.config_folder import config_folder
from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import note_read
from beardyn_core.base.packed import unpack_file
from beardyn_core.base.spelling import closest
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects import EffectSet, ModalStructure
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.sensor import Accelerometer
from beardyn_core.structure.modes import Modes
from beardyn_core.structure.table import modes_of_text, read_table

SEAT_REACH = 5e-3  # a sensor this close to a seat sits on it [m]


def is_path(table: str) -> bool:
    """Tell whether a table is given by its path; else it is the name of a shipped box."""
    return table.lower().endswith(".csv")


def table_path(name: str) -> Path:
    """Find the table of a shipped box, or that of a path, which ends in ``.csv``."""
    if is_path(name):
        return Path(name)
    folder = config_folder() / "structures"
    if not (path := folder / f"{name}.csv").is_file():
        names = sorted(each.stem for each in folder.glob("*.csv"))
        guess = closest(name, names)
        hint = f"did you mean {guess}? " if guess else ""
        raise InputError(
            f"there is no table of a box {name!r}; {hint}shipped are {', '.join(names) or 'none'}; a table "
            "of your own is given by its path, ending in .csv"
        )
    return path


def modes_of_effects(effects: EffectSet) -> Modes | None:
    """Read the modes of the box of a set of effects; ``None`` where the box has none.

    Raises
    ------
    InputError
        With every mistake in the table.
    """
    structure = effects.structure
    if not isinstance(structure, ModalStructure):
        return None
    found = _modes_of(structure)
    if structure.stiffness_factor == 1.0 and structure.damping_factor == 1.0:
        return found
    return found.scaled(structure.stiffness_factor, structure.damping_factor)


def _modes_of(structure: ModalStructure) -> Modes:
    if structure.content:
        return _unpack_modes(structure.content, structure.table, structure.highest)
    path = table_path(structure.table)
    note_read(path)
    try:
        written = path.stat().st_mtime_ns
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror})") from error
    return _read(path, written, structure.highest)


@lru_cache(maxsize=16)
def _read(path: Path, _written: int, highest: float | None) -> Modes:
    if highest is not None:  # a choice asks for one limit after the other
        return _read(path, _written, None).below(highest)
    return read_table(path)


@lru_cache(maxsize=16)
def _unpack_modes(content: str, label: str, highest: float | None) -> Modes:
    if highest is not None:
        return _unpack_modes(content, label, None).below(highest)
    return modes_of_text(unpack_file(content, label), label)


def seat_of(sensor: Accelerometer, modes: Modes) -> str:
    """Find the seat that an accelerometer sits on; raises `InputError` with the seats there are."""
    distance = {
        name: math.dist(sensor.position, place)
        for name, place in modes.places.items()
        if name not in modes.suspension
    }
    nearest = min(distance, key=lambda name: distance[name], default=None)
    if nearest is None or distance[nearest] > SEAT_REACH:
        seats = ", ".join(f"{name} at {_mm(modes.places[name])}" for name in distance)
        raise InputError(
            f"sensor {sensor.name!r} at position_mm {_mm(sensor.position)} sits on no seat of the box "
            f"{modes.name}; it has {seats or 'none'}"
        )
    return nearest


def _mm(place: tuple[float, float, float]) -> list[float]:
    return [round(1e3 * each, 1) for each in place]


def require_cup(modes: Modes, bearing: RollerBearing) -> None:
    """Raise `InputError` where modes were made with another cup than that of the bearing."""
    differences = ", ".join(modes.cup.differences(bearing))
    if differences:
        fitting = ", ".join(_shipped_boxes(bearing)) or "none"
        raise InputError(
            f"the box {modes.name} was made with the cup of {modes.cup.bearing}: {differences}; shipped "
            f"boxes with the cup of {bearing.name}: {fitting}; effects auto take a box that does not bend, "
            f"and `beardyn structure BOX --bearing {bearing.name} -o box.csv` fits one that does"
        )


def _shipped_boxes(bearing: RollerBearing) -> list[str]:
    """List the shipped boxes that were made with the cup of a bearing."""
    tables = sorted((config_folder() / "structures").glob("*.csv"))
    return [each.stem for each in tables if not any(read_table(each).cup.differences(bearing))]


def mounting_of(modes: Modes, mounting: Mounting, bearing: RollerBearing) -> Mounting:
    """Put the box of a table into a mounting: mass, centre of mass and inertia without the cup.

    Raises
    ------
    InputError
        When the box was made with another cup, or is lighter than the cup that it should hold.
    """
    require_cup(modes, bearing)
    mass = modes.mass - bearing.cup_mass
    inertia = np.array(modes.inertia) - np.array(bearing.cup_inertia)
    if mass <= 0.0 or inertia.min() <= 0.0:
        raise InputError(
            f"the box {modes.name} has {modes.mass:g} kg with its cup; the cup of {bearing.name} alone has "
            f"{bearing.cup_mass:g} kg: take the box of this bearing"
        )
    x, y, z = (modes.mass / mass * each for each in modes.centre)
    about_x, about_y, about_z = map(float, inertia)
    return replace(mounting, box_mass=mass, box_centre=(x, y, z), box_inertia=(about_x, about_y, about_z))
