"""The state of an axlebox from its history: evidence of many recordings, with hysteresis."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import isfinite, nan
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.fleet.analysis import Analysis
from beardyn_core.fleet.identity import Axlebox, write_date
from beardyn_core.fleet.sisters import Comparison
from beardyn_core.fleet.store import Stored
from beardyn_core.monitor.chain import MonitorSettings
from beardyn_core.monitor.severity import SEVERE
from beardyn_core.monitor.trend import ALARM, Trend, TrendPoint, TrendSettings

OK, CANNOT_TELL, WATCH, PLAN, ACT = "ok", "cannot_tell", "watch", "plan", "act"
SCALE = (OK, CANNOT_TELL, WATCH, PLAN, ACT)
"""From the best to the worst."""
PARTS = ("cup", "cone", "roller")
_BLIND = ("not_diagnosable", "waiting")
_OF_PARTS = {"cup": "outer ring (cup)", "cone": "inner ring (cone)", "roller": "roller"}


@dataclass(frozen=True)
class HealthSettings:
    """What health is made of; all numbers are assumed, docs/evidence/fleet_year.md has their outcome."""

    recent: A[int, "recordings that can tell, of which so many must agree"] = 5
    agreeing: A[int, "of them that name the same part: `plan`"] = 3
    agreeing_with_other: A[int, "the same where trend, sisters or temperature agree"] = 2
    least_confidence: A[float, "of a verdict that counts, [-]"] = 0.5
    widest: A[float, "width that a spall may reach, at the upper end of its 95 % interval: `act`, [m]"] = (
        20e-3
    )
    least_width: A[float, "or its width, or the least of it: `act`, [m]"] = 10e-3
    wide: A[int, "recordings of the bearing with such a spall, at any time"] = 2
    release: A[int, "recordings without cause, one after the other, after which an alarm ends"] = 10
    release_watch: A[int, "the same of `watch`"] = 5
    differs: A[float, "over the other axleboxes of the ride, in two bands, [dB]"] = 10.0
    dead: A[float, "under them, in every band: the sensor does not measure, [dB]"] = 25.0
    warmer: A[float, "than them, [K]"] = 20.0
    smooth: A[int, "recordings whose median is compared with the sisters"] = 3
    speed: A[float, "of the usual one within which levels are compared where there are no sisters"] = 0.1
    trend: A[TrendSettings, "of the levels over recordings"] = field(
        default_factory=lambda: TrendSettings(baseline=10, smooth=3, release=10)
    )


@dataclass(frozen=True)
class Health:
    """How an axlebox stands after a recording."""

    state: A[str, "one of `SCALE`"]
    part: A[str, "that is named, '' without"]
    since: A[float, "when it left `ok`, NaN while it is, [s]"]
    since_mileage: A[float, "the same, NaN unknown, [m]"]
    raised: A[float, "when it came to the state of now, NaN while `ok`, [s]"]
    why: A[tuple[str, ...], "sentences, the weightiest first"]
    notes: A[tuple[str, ...], "what does not decide"]
    rise: A[float, "largest level of the trend over its baseline, NaN unknown, [dB]"]
    support: A[int, "of the recent recordings that name the part"]


@dataclass(frozen=True)
class HealthPoint:
    """State after one recording, for the picture over time."""

    time: A[float, "[s]"]
    mileage: A[float, "[m]"]
    state: str
    verdict: str
    rise: A[float, "[dB]"]


@dataclass
class _Watched:
    """What is kept from recording to recording."""

    settings: HealthSettings
    trend: Trend | None = None
    point: TrendPoint | None = None
    recent: deque[Stored] = field(default_factory=deque)
    compared: deque[Float] = field(default_factory=deque)
    shared: deque[Float] = field(default_factory=deque)
    warmer: deque[float] = field(default_factory=deque)
    wide: dict[str, list[Stored]] = field(default_factory=dict)  # by part
    part: str = ""  # that was named last
    level: int = 0  # of the alarm, as a place in SCALE
    below: int = 0  # recordings in a row whose cause is less
    blind: int = 0  # recordings in a row that cannot tell
    blind_since: float = nan
    blind_mileage: float = nan
    since: float = nan
    since_mileage: float = nan
    raised: float = nan


def replay(
    history: Sequence[Stored],
    comparisons: Mapping[int, Comparison],
    exchanges: Iterable[float] = (),
    settings: HealthSettings | None = None,
) -> tuple[Health, list[HealthPoint]]:
    """Work out the health of an axlebox from its recordings since its bearing was exchanged last.

    Parameters
    ----------
    history : sequence of Stored
        Of one axlebox, in the order of time.
    comparisons : mapping
        Of `compare_sisters`.
    exchanges : iterable of float
        Times at which a bearing was exchanged, [s].

    Returns
    -------
    Health
        After the last recording.
    list of HealthPoint
        After every recording since the exchange.
    """
    settings = settings or HealthSettings()
    history = since_exchange(history, exchanges)
    has_sisters = 2 * sum(each.number in comparisons for each in history) >= len(history) > 0
    usual = _usual_speed(history)
    watched = _Watched(settings, recent=deque(maxlen=settings.recent))
    for name in ("compared", "shared", "warmer"):
        setattr(watched, name, deque(maxlen=settings.smooth))
    points = []
    health = Health(CANNOT_TELL, "", nan, nan, nan, ("there is no recording of the bearing",), (), nan, 0)
    for each in history:
        health = _after(watched, each, comparisons.get(each.number), has_sisters, usual)
        points.append(HealthPoint(each.time, each.mileage, health.state, each.analysis.verdict, health.rise))
    return health, points


def since_exchange(history: Sequence[Stored], exchanges: Iterable[float]) -> list[Stored]:
    """Leave out the recordings of bearings before the one of now."""
    last = max([-np.inf, *exchanges, *(each.time for each in history if each.exchanged)])
    return [each for each in history if each.time >= last]


def _usual_speed(history: Sequence[Stored]) -> float:
    known = [each.analysis.shaft_frequency for each in history if isfinite(each.analysis.shaft_frequency)]
    return float(np.median(known)) if known else nan


def _after(
    watched: _Watched, recording: Stored, comparison: Comparison | None, has_sisters: bool, usual: float
) -> Health:
    """Take one recording."""
    settings, analysis = watched.settings, recording.analysis
    why: list[str] = []
    notes: list[str] = []
    silent = comparison is not None and _is_silent(comparison.levels, settings.dead)
    blind = analysis.verdict in _BLIND or silent
    hot = analysis.verdict == "hot_box" or analysis.temperature >= MonitorSettings().hot
    if not blind:
        watched.recent.append(recording)
        if analysis.verdict in PARTS and _counts(recording, settings) and _is_wide(analysis, settings):
            watched.wide.setdefault(analysis.verdict, []).append(recording)
    if not silent:  # levels of a recording that is too short for a verdict count
        _compare(watched, recording, comparison, has_sisters, usual)
    if blind and not watched.blind:
        watched.blind_since, watched.blind_mileage = recording.time, recording.mileage
    watched.blind = watched.blind + 1 if blind else 0
    part, support = _named(watched)
    watched.part = part or watched.part
    other = _other_evidence(watched, notes)
    cause = _cause(watched, part, support, other, why)
    if hot:
        cause = SCALE.index(ACT)
        warmth = (
            "" if not isfinite(analysis.temperature) else f", {analysis.temperature - ZERO_CELSIUS:.0f} °C"
        )
        why.insert(0, f"the axlebox is hot{warmth}")
    # what levels alone have raised, levels alone release
    by_levels = (
        watched.level == SCALE.index(WATCH) and not support and not silent and analysis.levels.size > 0
    )
    if not blind or hot or cause > watched.level or by_levels:
        _move(watched, cause, recording, held=bool(other))
    state = SCALE[watched.level]
    if watched.level > cause and watched.level >= SCALE.index(PLAN) and other:
        notes.append("the part is no longer named, and levels are as high as before: the alarm stays")
    elif watched.level > cause and watched.level >= SCALE.index(WATCH):
        left = (
            settings.release if watched.level >= SCALE.index(PLAN) else settings.release_watch
        ) - watched.below
        notes.append(
            f"the cause was not seen in the last {watched.below} recordings; {left} more without it end this"
        )
    if blind:
        reason = "its level is far below those of the other axleboxes" if silent else analysis.reason
        sentence = (
            f"the last {watched.blind} recordings cannot tell"
            if watched.blind > 1
            else "the last recording cannot tell"
        )
        if state == OK:
            state = CANNOT_TELL
            why.insert(0, f"{sentence}: {reason}")
        else:
            notes.insert(0, f"{sentence}: {reason}; the alarm stays")
    if not why:
        why.append("nothing points to a fault" if state == OK else "the earlier alarm has not been released")
    rise = nan if watched.point is None else watched.point.rise
    is_ok = state == OK
    return Health(
        state, watched.part if watched.level >= SCALE.index(WATCH) else "",
        nan if is_ok else watched.since if isfinite(watched.since) else watched.blind_since,
        nan if is_ok else watched.since_mileage if isfinite(watched.since) else watched.blind_mileage,
        nan if is_ok else watched.raised if isfinite(watched.raised) else watched.blind_since,
        tuple(why), tuple(notes), rise, support,
    )  # fmt: skip


def _is_silent(levels: Float, dead: float) -> bool:
    known = levels[np.isfinite(levels)]
    return bool(len(known)) and bool((known < -dead).all())


def _compare(
    watched: _Watched, recording: Stored, comparison: Comparison | None, has_sisters: bool, usual: float
) -> None:
    """Take levels and temperature against the sisters, or the levels alone at the usual speed."""
    analysis = recording.analysis
    levels: Float | None = None
    if comparison is not None:
        # a wheel strikes both ends of its axle: what the other end has as well is not this bearing's
        both = np.fmax(comparison.partner, 0.0)
        alone = comparison.levels - np.where(np.isfinite(both), both, 0.0)
        watched.compared.append(alone)
        watched.shared.append(np.where(np.isfinite(both), np.minimum(both, comparison.levels), 0.0))
        own = comparison.partner_warmer if isfinite(comparison.partner_warmer) else 0.0
        watched.warmer.append(comparison.warmer - max(own, 0.0))
        levels = alone
    if not has_sisters:
        near = abs(analysis.shaft_frequency / usual - 1.0) <= watched.settings.speed if usual > 0.0 else True
        levels = analysis.levels if near else None
    if levels is None or not levels.size:
        return
    if watched.trend is None:
        watched.trend = Trend(analysis.axes, watched.settings.trend)
    if watched.trend.axes == analysis.axes:
        watched.point = watched.trend.take(levels, recording.time)


def _counts(recording: Stored, settings: HealthSettings) -> bool:
    """Tell whether a verdict is sure enough to count; one of another monitor may state no confidence."""
    return not recording.analysis.confidence < settings.least_confidence


def _named(watched: _Watched) -> tuple[str, int]:
    """Find the part that most of the recent recordings name, and how many do."""
    counts = dict.fromkeys(PARTS, 0)
    for each in watched.recent:
        verdict = each.analysis.verdict
        if verdict in PARTS and _counts(each, watched.settings):
            for part in {verdict, *each.analysis.also_fits} & set(PARTS):
                counts[part] += 1
    # of equal counts the one that was named last
    last = next((e.analysis.verdict for e in reversed(watched.recent) if e.analysis.verdict in PARTS), "")
    part = max(PARTS, key=lambda each: (counts[each], each == last))
    return (part, counts[part]) if counts[part] else ("", 0)


def _other_evidence(watched: _Watched, notes: list[str]) -> list[str]:
    """List what other than the verdicts points to this axlebox."""
    settings, found = watched.settings, []
    point = watched.point
    if point is not None and point.state == ALARM:
        found.append(f"levels have risen over its own baseline, most {point.level}, by {point.rise:+.0f} dB")
    if len(watched.compared) == settings.smooth and len({each.shape for each in watched.compared}) == 1:
        alone = np.median(list(watched.compared), axis=0)
        if np.count_nonzero(alone >= settings.differs) >= 2:
            found.append(f"up to {np.nanmax(alone):.0f} dB louder than the other axleboxes on the same rides")
        shared = np.median(list(watched.shared), axis=0)
        if np.count_nonzero(shared >= settings.differs) >= 2:
            notes.append(
                f"both ends of the axle are up to {np.nanmax(shared):.0f} dB louder than the others: "
                "look at the wheelset"
            )
    warmer = [each for each in watched.warmer if isfinite(each)]
    if len(warmer) == settings.smooth and float(np.median(warmer)) >= settings.warmer:
        found.append(f"{np.median(warmer):.0f} K warmer than the other axleboxes on the same rides")
    return found


def _cause(watched: _Watched, part: str, support: int, other: list[str], why: list[str]) -> int:
    """Give the place in `SCALE` that the recordings of late are cause for, and say why."""
    settings, count = watched.settings, len(watched.recent)
    level = SCALE.index(OK)
    named = [each.analysis for each in watched.recent if each.analysis.verdict == part] if part else []
    if support:
        sure = [each.confidence for each in named if isfinite(each.confidence)]
        with_confidence = f", confidence {100.0 * float(np.mean(sure)):.0f} %" if sure else ""
        why.append(
            f"{_OF_PARTS[part]}: named by {support} of the last {count} recordings that can tell"
            f"{with_confidence}"
        )
        needed = settings.agreeing_with_other if other else settings.agreeing
        level = SCALE.index(PLAN if support >= needed else WATCH)
    if level == SCALE.index(PLAN) and named:
        wide = watched.wide.get(part, [])
        if len(wide) >= settings.wide:
            level = SCALE.index(ACT)
            last = wide[-1]
            why.insert(0, f"the spall is wide, on {write_date(last.time)} {last.analysis.stage_reason}")
        elif named[-1].stage_reason:
            why.append(f"size: {named[-1].stage_reason}")
    if other:
        why += other
        level = max(level, SCALE.index(WATCH))
    strange = sum(each.analysis.verdict == "unexplained" for each in watched.recent)
    if strange >= settings.agreeing:
        why.append(f"{strange} of the last {count} recordings have regular strikes that fit no part")
        level = max(level, SCALE.index(WATCH))
    return level


def _is_wide(analysis: Analysis, settings: HealthSettings) -> bool:
    """Tell whether a spall is so wide that it must come out; a spall does not become smaller."""
    known = analysis.width if isfinite(analysis.width) else analysis.width_low
    reaches = analysis.width_ends[1] >= settings.widest or known >= settings.least_width
    return analysis.stage == SEVERE or reaches


def _move(watched: _Watched, cause: int, recording: Stored, *, held: bool) -> None:
    """Raise the state at once, lower it after so many recordings without cause.

    An alarm stays where levels are `held`: of a wide spall a monitor may name no part any more.
    """
    settings, before = watched.settings, watched.level
    if cause >= watched.level:
        watched.level, watched.below = cause, 0
    elif not (held and watched.level >= SCALE.index(PLAN)):
        watched.below += 1
        needed = settings.release if watched.level >= SCALE.index(PLAN) else settings.release_watch
        if watched.below >= needed:
            watched.level, watched.below = cause, 0
    if watched.level != before:
        watched.raised = recording.time if watched.level else nan
    if watched.level and not before:
        watched.since, watched.since_mileage = recording.time, recording.mileage
    if not watched.level:
        watched.part = ""
        watched.since = watched.since_mileage = nan


def with_state(health: Health, state: str, sentence: str) -> Health:
    """Give a health another state, for a reason that is not in its recordings."""
    return replace(health, state=state, why=(sentence, *health.why))


def axlebox_histories(recordings: Sequence[Stored]) -> dict[Axlebox, list[Stored]]:
    """Sort recordings by axlebox, each in the order of time."""
    found: dict[Axlebox, list[Stored]] = {}
    for each in recordings:
        found.setdefault(each.axlebox, []).append(each)
    return found
