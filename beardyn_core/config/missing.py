"""What of a scene speaks of rows and rollers that are not there."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.config.keys import valid
from beardyn_core.config.problems import Place
from beardyn_core.scene.defect import MissingRoller

_ROW_NAMES = ("inboard", "outboard")


def missing_problems(scene: Mapping[str, Any], bearing: RollerBearing) -> list[tuple[Place, str]]:
    """Find contradictions of `rows` and `missing_rollers` with each other and with the faults.

    Of the scene as written, entries with other mistakes are left out. Returned are the place of an entry, and
    what is wrong with it.
    """
    rows = scene.get("rows", 2)
    if rows not in (1, 2):
        return []
    problems: list[tuple[Place, str]] = []
    missing: list[tuple[int, int]] = []
    for place, given in entries_of(scene, "missing_rollers"):
        found = valid(MissingRoller, given)
        if found is None:
            continue
        wrong = list(found.contradictions(bearing))
        if found.row >= rows:
            wrong.append(_no_row(found.row))
        if (found.row, found.roller) in missing:
            wrong.append(f"roller {found.roller} of row {found.row} is given twice; name each roller once")
        problems += [(place, text) for text in wrong]
        if not wrong:
            missing.append((found.row, found.roller))
    for row in range(rows):
        if sum(each == row for each, _ in missing) >= bearing.roller_count:
            name = _ROW_NAMES[row]
            hint = "; take `rows: 1` for a bearing with the inboard row alone" if row == 1 else ""
            problems.append(
                (("missing_rollers",), f"every roller of row {row} ({name}) is missing; leave one{hint}")
            )
    for key in ("defects", "waviness"):
        for place, given in entries_of(scene, key):
            its_row, on = given.get("row"), given.get("on")
            if its_row == 1 and rows == 1:
                problems.append((place, _no_row(1)))
            roller = given.get("roller", 0 if key == "defects" else None)
            if (on == "roller" or given.get("kind") == "diameter") and (its_row, roller) in missing:
                problems.append((place, f"roller {roller} of row {its_row} is one of missing_rollers"))
    return problems


def _no_row(row: int) -> str:
    return f"row is {row}; with `rows: 1` there is row 0 alone"


def entries_of(scene: Mapping[str, Any], key: str) -> list[tuple[Place, dict[str, Any]]]:
    """List the mappings under a key with their places; what is none is reported elsewhere."""
    entries = scene.get(key)
    if not isinstance(entries, list):
        return []
    return [((key, index), given) for index, given in enumerate(entries) if isinstance(given, dict)]
