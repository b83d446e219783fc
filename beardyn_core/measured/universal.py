"""Universal files, data set 58 (functions at nodes), read with pyuff and held in memory."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

from beardyn_core.base.optional import library
from beardyn_core.measured.claimed_rate import claims_in
from beardyn_core.measured.claimed_start import seconds_as_start
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import Channel, Held, unreadable_file
from beardyn_core.measured.units import usual

_TIME_RESPONSE = 1
_DIRECTIONS = {1: "x", 2: "y", 3: "z"}


def open_file(path: Path, _reading: Reading) -> Held:
    """List the time responses of a file by their first line, or by node and direction without one."""
    pyuff = library("pyuff", f"{path}: reading Universal files", "measured")
    try:
        file = pyuff.UFF(str(path))
        kinds = [int(each) for each in file.get_set_types()]
        sets = [file.read_sets(number) for number, kind in enumerate(kinds) if kind == 58]
    except Exception as error:  # the reader breaks in any way on text that is not what it should be
        raise unreadable_file(path, "a Universal file", error) from error
    signals = [each for each in sets if int(each.get("func_type", 0)) == _TIME_RESPONSE]
    labels = [_label(each) for each in signals]
    doubled = Counter(labels)
    channels, columns = [], {}
    facts: dict[str, str] = {}
    notes: list[str] = []
    for number, (label, each) in enumerate(zip(labels, signals, strict=True)):
        name = label if doubled[label] == 1 else f"{label} ({number + 1})"
        values = np.asarray(each["data"])
        if np.iscomplexobj(values):
            continue
        step, even = float(each.get("abscissa_inc", 0.0) or 0.0), bool(each.get("abscissa_spacing", 1))
        claims = tuple(claims_in({"increment": step}, shown=f"{name}: ")) if even and step > 0.0 else ()
        begin = float(each.get("abscissa_min", 0.0) or 0.0)
        start = seconds_as_start(begin) if even else None
        table = f"{len(values)} samples at {1.0 / step if claims else float('nan'):g} Hz"
        table += f" from {begin:.9g} s" if begin else ""
        unit = usual(str(each.get("ordinate_axis_units_lab", "") or "").replace("NONE", ""))
        direction = int(each.get("rsp_dir", 0) or 0)
        axis = _DIRECTIONS.get(abs(direction), "")
        if direction < 0:
            values = -values
            notes.append(
                f"{name} points along -{axis or '?'}: its sign is turned, so that it is along +{axis}"
            )
        channels.append(Channel(name, table, len(values), unit, claims, start, axis=axis))
        columns[name] = values
        if not even:
            time = f"time of {name}"
            channels.append(Channel(time, table, len(values), "s", is_time=True))
            columns[time] = np.asarray(each["x"], np.float64)
        for key in ("id1", "id2", "id3"):
            if text := str(each.get(key, "") or "").strip():
                facts.setdefault(key, text)
    problems = [] if _is_whole(path) else [f"{path}: is cut off: its last data set has no end"]
    problems += (
        [] if channels else [f"{path}: has no time response (data set 58, function type 1), has {kinds}"]
    )
    return Held(tuple(channels), columns, {}, facts, tuple(notes), problems)


def _label(each: dict[str, Any]) -> str:
    name = str(each.get("id1", "") or "").strip()
    if name and name.upper() != "NONE":
        return name
    direction = int(each.get("rsp_dir", 0) or 0)
    sign = "-" if direction < 0 else "+"
    return f"node {each.get('rsp_node', 0)} {sign}{_DIRECTIONS.get(abs(direction), '?')}"


def _is_whole(path: Path) -> bool:
    """Tell whether a file ends with the delimiter of a data set."""
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 200))
        return file.read().strip().rpartition(b"\n")[2].strip() == b"-1"
