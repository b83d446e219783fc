"""Bearing data by name: shipped ones, those of files, those of whole bearings."""

from __future__ import annotations

from pathlib import Path

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.config.folders import find, shipped_names
from beardyn_core.config.nouns import bearing_from_mapping, load_bearing, read_noun
from beardyn_core.config.yaml_text import read_file


def load_plate(name: str | Path) -> NamePlate:
    """Load shipped bearing data or that of a file, or take that of a whole bearing.

    Raises
    ------
    InputError
        With every mistake, or the names there are.
    """
    text = str(name)
    if text not in shipped_names("plates") and text in shipped_names("bearings"):
        return NamePlate.of(load_bearing(text))
    try:
        path = find("plates", text)
    except InputError as error:
        bearings = ", ".join(shipped_names("bearings"))
        raise InputError([f"{each}; bearings are {bearings}" for each in error.problems]) from None
    data = read_file(path)
    if "row_spacing_mm" in data or "cage" in data:
        return NamePlate.of(bearing_from_mapping(data, str(path)))
    plate: NamePlate = read_noun(NamePlate, data, str(path))
    return plate
