"""Modes at nodes in a Universal file."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.structure.mesh import EXTRA
from beardyn_core.structure.shapes import Shapes

_NODES, _SHAPES, _NORMAL_MODE = (15, 2411), 55, 2


def read_universal(path: Path) -> Shapes:
    """Read nodes and normal modes of a Universal file.

    Raises
    ------
    InputError
        pyuff is missing, the file cannot be read, or it lacks nodes or modes.
    """
    try:
        import pyuff
    except ImportError as error:
        raise InputError(f"Universal files need pyuff ({error}); {EXTRA}") from error
    try:
        if not path.is_file():
            raise OSError("no such file")
        sets = pyuff.UFF(str(path)).read_sets()
    except Exception as error:  # of a broken file pyuff raises whatever Python does
        raise InputError(f"{path}: cannot be read as a Universal file: {error}") from error
    sets = sets if isinstance(sets, list) else [sets]
    places: dict[int, Float] = {}
    for each in (found for found in sets if found["type"] in _NODES):
        where = np.stack([each["x"], each["y"], each["z"]], axis=1).astype(float)
        places |= dict(zip(map(int, each["node_nums"]), where, strict=True))
    modes = [each for each in sets if each["type"] == _SHAPES and each.get("analysis_type") == _NORMAL_MODE]
    problems = []
    if not places:
        problems.append(f"{path}: there are no nodes (data set 15 or 2411)")
    if not modes:
        problems.append(f"{path}: there are no normal modes (data set 55, analysis type 2)")
    strange = sorted({int(number) for each in modes for number in each["node_nums"]} - places.keys())
    if modes and places and strange:
        problems.append(f"{path}: {len(strange)} nodes of the shapes have no place, {strange[0]} first")
    massless = [each["mode_n"] for each in modes if not each.get("modal_m", 0.0) > 0.0]
    if massless:
        problems.append(f"{path}: mode {massless[0]:g} has no modal mass; export the modes with it")
    if problems:
        raise InputError(problems)
    numbers = sorted({int(number) for each in modes for number in each["node_nums"]})
    order = {number: i for i, number in enumerate(numbers)}
    shape = np.zeros((len(modes), len(numbers), 3))
    for i, each in enumerate(modes):
        rows = [order[int(number)] for number in each["node_nums"]]
        shape[i, rows] = np.stack([np.real(each[axis]) for axis in ("r1", "r2", "r3")], axis=1)
        shape[i] /= math.sqrt(each["modal_m"])
    return Shapes(
        np.array([places[number] for number in numbers]),
        np.array([float(each["freq"]) for each in modes]),
        np.array([float(each.get("modal_damp_vis", 0.0)) for each in modes]),
        shape,
    )
