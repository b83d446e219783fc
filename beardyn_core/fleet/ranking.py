"""All axleboxes of a store, the one that needs attention most first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite, nan
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.fleet.health import (
    ACT,
    CANNOT_TELL,
    OK,
    PLAN,
    SCALE,
    WATCH,
    Health,
    HealthPoint,
    HealthSettings,
    axlebox_histories,
    replay,
    since_exchange,
    with_state,
)
from beardyn_core.fleet.identity import Axlebox, write_date
from beardyn_core.fleet.mileage_left import MileageLeft, judge_mileage
from beardyn_core.fleet.sisters import Comparison, compare_sisters
from beardyn_core.fleet.store import ACKNOWLEDGED, EXCHANGED, Entry, FleetStore, Stored
from beardyn_core.follow.growth import GrowthLaw

MEANINGS = {
    ACT: "the box is hot, or a part is named again and again and its spall is wide: take it out of service "
    "as the rules of the keeper require",
    PLAN: "3 of the last 5 recordings name the same part, or 2 and the levels, temperature or sisters agree",
    WATCH: "one sign: a single verdict, levels that rise, or a difference from the other axleboxes",
    CANNOT_TELL: "the last recording cannot tell, or there is none for longer than usual: not healthy",
    OK: "nothing points to a fault",
}
"""What each state means; the scale of `beardyn fleet`."""
EXIT_CODES = {OK: 0, CANNOT_TELL: 10, WATCH: 11, PLAN: 12, ACT: 12}
_ADVICE = {
    ACT: "stop using it as the rules of the keeper require; inspect the bearing now",
    PLAN: "confirm with a recording at a similar speed, then plan the inspection or exchange",
    WATCH: "record again soon; check speed and bearing data",
    CANNOT_TELL: "check sensor, cable and recording; until then nothing is known",
    OK: "none; keep the interval of recordings",
}
_OVERDUE, _DAY = 3.0, 86_400.0  # usual intervals without a recording; [s]
_LEAST_RECORDINGS = 4  # from which an interval is usual


@dataclass(frozen=True)
class Standing:
    """One axlebox in the ranked list."""

    rank: int
    axlebox: Axlebox
    health: Health
    acknowledged: A[Entry | None, "of the state of now; ``None``: nobody has"]
    last: A[Stored, "latest recording of the bearing"]
    recordings: A[int, "of the bearing"]
    left: MileageLeft
    advice: A[str, "what to do"]
    points: A[tuple[HealthPoint, ...], "over the recordings"]
    history: A[tuple[Stored, ...], "recordings of the bearing"]
    bearing: A[str, "name"]


@dataclass(frozen=True)
class FleetStatus:
    """The ranked list."""

    as_of: A[float, "time that it is of, [s]"]
    standings: tuple[Standing, ...]
    recordings: A[int, "in the store"]
    comparisons: A[dict[int, Comparison], "by the number of the recording"]

    @property
    def exit_code(self) -> int:
        """Code of the worst state; one that is acknowledged counts like the others."""
        return max((EXIT_CODES[each.health.state] for each in self.standings), default=0)

    def counts(self) -> dict[str, int]:
        """Count the axleboxes of each state, the worst first."""
        return {s: sum(each.health.state == s for each in self.standings) for s in reversed(SCALE)}


def rank_fleet(
    store: FleetStore,
    *,
    as_of: float | None = None,
    settings: HealthSettings | None = None,
    law: GrowthLaw | None = None,
) -> FleetStatus:
    """Rank all axleboxes of a store.

    Parameters
    ----------
    as_of : float, optional
        Time that the list is of, later recordings left aside, [s]; by default that of the latest recording.

    Raises
    ------
    InputError
        The store is empty at that time.
    """
    recordings = [each for each in store.recordings() if as_of is None or each.time <= as_of]
    if not recordings:
        raise InputError(f"--store {store.path}: has no recording; `beardyn fleet add` adds some")
    at = recordings[-1].time if as_of is None else as_of
    comparisons = compare_sisters(recordings)
    entries: dict[Axlebox, list[Entry]] = {}
    for entry in store.entries():
        entries.setdefault(entry.axlebox, []).append(entry)
    found = []
    for box, history in axlebox_histories(recordings).items():
        own_entries = entries.get(box, [])
        exchanges = [e.time for e in own_entries if e.kind == EXCHANGED and e.time <= at]
        health, points = replay(history, comparisons, exchanges, settings)
        own = since_exchange(history, exchanges)
        health = _without_recordings(health, own or history, bool(own), at)
        left = judge_mileage(own, health.part, law) if health.part else judge_mileage([], "")
        found.append(
            Standing(
                0,
                box,
                health,
                _acknowledged(own_entries, health),
                (own or history)[-1],
                len(own),
                left,
                _advice(health, left),
                tuple(points),
                tuple(own),
                (own or history)[-1].analysis.bearing_name,
            )
        )
    found.sort(key=_urgency)
    ranked = tuple(
        Standing(number, *(getattr(each, name) for name in list(each.__dataclass_fields__)[1:]))
        for number, each in enumerate(found, 1)
    )
    return FleetStatus(at, ranked, len(recordings), comparisons)


def _without_recordings(health: Health, history: Sequence[Stored], is_of_this: bool, at: float) -> Health:
    """Say where there is no recording since an exchange, or none for longer than usual."""
    if not is_of_this:
        return health
    times = np.array([each.time for each in history])
    usual = float(np.median(np.diff(times))) if len(times) >= _LEAST_RECORDINGS else nan
    silent = at - float(times[-1])
    if not (isfinite(usual) and silent > max(_OVERDUE * usual, _DAY)):
        return health
    sentence = f"no recording for {silent / _DAY:.0f} days, where one every {usual / _DAY:.1f} days was usual"
    if health.state in (OK, CANNOT_TELL):
        return with_state(health, CANNOT_TELL, sentence)
    return with_state(health, health.state, sentence)


def _acknowledged(entries: Sequence[Entry], health: Health) -> Entry | None:
    """Find who has acknowledged this state of an axlebox since it was raised."""
    if health.state not in (WATCH, PLAN, ACT):
        return None
    own = [e for e in entries if e.kind == ACKNOWLEDGED]
    return next((e for e in reversed(own) if e.health == health.state and e.raised == health.raised), None)


def _advice(health: Health, left: MileageLeft) -> str:
    # the least of the laws that agree with its widths: nobody knows which of them holds
    if left.span[0] == 0.0 and health.state in (PLAN, ACT):
        return _ADVICE[ACT]
    if health.state == PLAN and isfinite(left.span_dates[0]):
        return f"{_ADVICE[PLAN]}, before {write_date(left.span_dates[0])}"
    return _ADVICE[health.state]


def _urgency(standing: Standing) -> tuple[Any, ...]:
    """Sort by state, those that nobody has acknowledged first, then by size and evidence, then by name."""
    health, analysis = standing.health, standing.last.analysis
    named = [each.analysis for each in standing.history if each.analysis.verdict == health.part]
    widths = [each.width for each in named[-5:] if isfinite(each.width)]
    width = float(np.median(widths)) if widths else 0.0
    rise = health.rise if isfinite(health.rise) else 0.0
    hot = analysis.temperature if isfinite(analysis.temperature) and health.state == ACT else 0.0
    return (
        -SCALE.index(health.state), standing.acknowledged is not None, -width, -health.support, -hot, -rise,
        standing.axlebox,
    )  # fmt: skip


def find_standing(status: FleetStatus, box: Axlebox) -> Standing:
    """Find one axlebox.

    Raises
    ------
    InputError
        It is not in the store, with the nearest names.
    """
    from difflib import get_close_matches

    for each in status.standings:
        if each.axlebox == box:
            return each
    known = {each.axlebox.name: each for each in status.standings}
    near = get_close_matches(box.name, known, 3, 0.4)
    hint = f"; nearest are {', '.join(near)}" if near else ""
    raise InputError(f"{box.name}: is not in the store{hint}")
