"""Bearing data by name: those of the catalogue, of files, of whole bearings."""

from __future__ import annotations

import os
from pathlib import Path

from beardyn_core.bearing.catalogue_entry import CatalogueEntry
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.config.catalogue import find_bearing
from beardyn_core.config.folders import find, shipped_names
from beardyn_core.config.nouns import bearing_from_mapping, load_any_bearing, read_noun
from beardyn_core.config.yaml_text import read_file


def load_plate(name: str | Path) -> NamePlate:
    """Load bearing data of the catalogue or of a file, or take that of a whole bearing.

    Raises
    ------
    InputError
        With every mistake, or the nearest names there are.
    """
    text = str(name)
    if text in shipped_names("bearings"):
        return NamePlate.of(load_any_bearing(text))
    if _is_name(text):
        return find_bearing(text).plate
    path = find("plates", text)
    data = read_file(path)
    if "cage" in data or "row_spacing_mm" in data or "kind" in data:
        return NamePlate.of(bearing_from_mapping(data, str(path)))
    plate: NamePlate = read_noun(NamePlate, data, str(path))
    return plate


def find_entry(name: str | Path) -> CatalogueEntry | None:
    """Find the line of the catalogue that `load_plate` takes; None for a file and for a whole bearing.

    Raises
    ------
    InputError
        With the nearest names there are.
    """
    text = str(name)
    if text in shipped_names("bearings") or not _is_name(text):
        return None
    entry = find_bearing(text)
    return None if entry.name in shipped_names("bearings") else entry


def _is_name(text: str) -> bool:
    """Tell whether a text is a name and no path."""
    is_path = Path(text).suffix in (".yaml", ".yml") or os.sep in text or "/" in text
    return not is_path or _is_designation(text)


def _is_designation(text: str) -> bool:
    """Tell whether a slash is that of a designation, 22228 CC/W33, and not of a path."""
    first = text.partition("/")[0]
    return (
        Path(text).suffix not in (".yaml", ".yml")
        and not Path(text).exists()
        and first[:1].isalnum()
        and any(each.isdigit() for each in first)
        and not Path(first).is_dir()
    )
