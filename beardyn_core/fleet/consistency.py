"""Contradictions between recordings that are to be added, and between them and the store."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Annotated as A

from beardyn_core.fleet.identity import Axlebox, FleetRecording, write_time

_DAY = 86_400.0  # [s]


@dataclass(frozen=True)
class Known:
    """What is known of a recording that is in the store."""

    axlebox: Axlebox
    time: A[float, "[s]"]
    mileage: A[float, "[m]"]
    bearing: str
    key: A[tuple[str, str], "content, and the axlebox in it"]
    name: A[str, "of its file"]
    exchanged: A[bool, "whether the bearing is another one from this recording on"]


def find_contradictions(
    recordings: Sequence[FleetRecording],
    known: Iterable[Known],
    exchanges: Iterable[tuple[Axlebox, float]],
    now: float,
) -> list[str]:
    """List what contradicts: the same file twice, a future date, a mileage that falls, another bearing.

    Parameters
    ----------
    recordings : sequence of FleetRecording
        With their content hashes.
    known : iterable of Known
        Recordings of the store.
    exchanges : iterable of Axlebox and time
        Entries of `beardyn fleet exchanged`, [s].
    now : float
        [s].
    """
    stored = {each.key: each for each in known}
    problems = []
    seen: dict[tuple[str, str], FleetRecording] = {}
    for each in recordings:
        if each.time > now + _DAY:  # a day: the clock of a recorder may be in another zone
            problems.append(f"{each.path}: time is {write_time(each.time)} UTC, in the future")
        twin = seen.setdefault(each.key, each)
        if twin is not each:
            problems.append(
                f"{each.path}: is the same recording as {twin.path}; give each once (two axleboxes in one "
                "file need source_box)"
            )
        old = stored.get(each.key)
        if old is not None and (old.axlebox, old.time) != (each.axlebox, each.time):
            problems.append(
                f"{each.path}: is in the store as {old.axlebox.name} of {write_time(old.time)} ({old.name}), "
                f"and is now called {each.axlebox.name} of {write_time(each.time)}; correct the manifest"
            )
    new = [
        Known(each.axlebox, each.time, each.mileage, each.bearing, each.key, str(each.path), each.exchanged)
        for each in seen.values()
        if each.key not in stored
    ]
    histories: dict[Axlebox, list[Known]] = {}
    for one in (*stored.values(), *new):
        histories.setdefault(one.axlebox, []).append(one)
    changed: dict[Axlebox, list[float]] = {}
    for box, at in exchanges:
        changed.setdefault(box, []).append(at)
    fresh = {each.key for each in new}
    for box, history in histories.items():
        history.sort(key=lambda each: each.time)
        problems += _falls_and_changes(box, history, sorted(changed.get(box, ())), fresh)
    return problems


def _falls_and_changes(
    box: Axlebox, history: list[Known], exchanges: list[float], fresh: set[tuple[str, str]]
) -> Iterable[str]:
    """Give what falls or changes over the history of one axlebox, where a new recording is part of it."""
    highest: Known | None = None
    before: Known | None = None
    for each in history:
        if before is not None and {each.key, before.key} & fresh:
            if each.time == before.time:
                yield (
                    f"{each.name}: {box.name} has two recordings of {write_time(each.time)}, the other is "
                    f"{before.name}; correct time"
                )
            if each.bearing != before.bearing and not (
                each.exchanged or any(before.time < at <= each.time for at in exchanges)
            ):
                yield (
                    f"{each.name}: bearing of {box.name} is {each.bearing or 'not stated'}, and was "
                    f"{before.bearing or 'not stated'} in {before.name}; set bearing_exchanged, or correct it"
                )
        if isfinite(each.mileage):
            if highest is not None and each.mileage < highest.mileage and {each.key, highest.key} & fresh:
                yield (
                    f"{each.name}: mileage_km of {box.name} is {each.mileage / 1e3:,.0f} on "
                    f"{write_time(each.time)}, and was {highest.mileage / 1e3:,.0f} in {highest.name} "
                    "before; correct mileage_km or time"
                )
            if highest is None or each.mileage >= highest.mileage:
                highest = each
        before = each
