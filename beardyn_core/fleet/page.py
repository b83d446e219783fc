"""The page of a fleet: the ranked list, and a page for each axlebox over `watch` with its evidence."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import UTC, datetime
from functools import partial
from math import isfinite
from pathlib import Path

from beardyn_core.base.outputs import write_whole
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.base.versions import versions
from beardyn_core.fleet.analysis import Evidence
from beardyn_core.fleet.health import ACT, CANNOT_TELL, OK, PLAN, SCALE, WATCH
from beardyn_core.fleet.identity import write_date, write_time
from beardyn_core.fleet.pictures import (
    draw_evidence_excerpt,
    draw_evidence_record,
    draw_evidence_spectrum,
    draw_health,
    draw_sisters,
    draw_widths,
)
from beardyn_core.fleet.ranking import MEANINGS, FleetStatus, Standing
from beardyn_core.fleet.store import FleetStore
from beardyn_core.study.report_page.page import (
    Facts,
    Headline,
    Page,
    PageReport,
    Panel,
    Part,
    Picture,
    Points,
    Rows,
)
from beardyn_core.study.report_page.page_html import html_of

TITLE = "Condition of a fleet"
COLOURS = {ACT: "#7f0000", PLAN: "#c62828", WATCH: "#b26a00", CANNOT_TELL: "#616161", OK: "#2e7d32"}
_KEEPER = (
    "How far the vehicle may run until then is for the rules of its keeper: mileage left is a forecast from "
    "what is assumed, no permission."
)
_BY_LEVELS = (
    "Look at the other end of the axle and at the wheel: what both ends have is not the bearing.",
    "Check the sensor and its mounting, and record again at a similar speed. Levels do not name a part.",
)
MOST_PAGES = 100  # of axleboxes, each some 0.2 MB
_SHOWN = (WATCH, PLAN, ACT)
_ASSUMED = 12  # lines of what was assumed of a recording


def write_fleet_page(
    store: FleetStore, status: FleetStatus, html: Path, *, most: int = MOST_PAGES, force: bool = False
) -> None:
    """Write the page of a fleet as one HTML file, with pages of so many axleboxes at most."""
    write_whole(html, html_of(fleet_page(store, status, most)), replace=force)


def fleet_page(store: FleetStore, status: FleetStatus, most: int = MOST_PAGES) -> PageReport:
    """Compose the pages: the list, and of so many axleboxes at most a page of their own."""
    shown = [each for each in status.standings if each.health.state in _SHOWN][:most]
    pages = [_overview(status, shown), *(_axlebox_page(store, status, each) for each in shown)]
    made = f"page made {datetime.now(UTC):%Y-%m-%d %H:%M} UTC"
    foot = f"beardyn {versions()['beardyn']}, {made}, store {store.path.name}"
    return PageReport(TITLE, tuple(pages), foot)


def state_word(state: str) -> str:
    """Write a state in capitals, which replace the colour in print."""
    return state.replace("_", " ").upper()


def _overview(status: FleetStatus, shown: list[Standing]) -> Page:
    counts = status.counts()
    number = {each.axlebox: place for place, each in enumerate(shown, 1)}
    rows, links = [], []
    for each in status.standings:
        health = each.health
        if health.state == OK:
            continue
        rows.append(
            (
                str(each.rank),
                each.axlebox.name,
                state_word(health.state) + acknowledged_mark(each),
                since_words(each),
                health.why[0],
                f"{write_date(each.last.time)}",
                each.advice,
            )
        )
        links.append(f"p{number[each.axlebox]}" if each.axlebox in number else "")
    worst = status.standings[0]
    told = ", ".join(f"{count} {state.replace('_', ' ')}" for state, count in counts.items() if count)
    headline = Headline(
        state_word(worst.health.state),
        f"{len(status.standings)} axleboxes: {told}.",
        COLOURS[worst.health.state],
        (
            f"First: {worst.axlebox.name}: {worst.health.why[0]}.",
            f"{status.recordings} recordings until {write_time(status.as_of)} UTC.",
        ),
    )
    alarmed = sum(each.health.state in _SHOWN for each in status.standings)
    which = "a linked one has a page of its own below"
    if alarmed > len(shown):
        which = f"the first {len(shown)} of {alarmed} with an alarm have a page of their own below"
    table = Rows(
        f"Axleboxes, the one that needs attention most first; {which}",
        ("rank", "axlebox", "health", "since", "why", "last recording", "what to do"),
        (0.05, 0.14, 0.11, 0.12, 0.28, 0.11, 0.19),
        tuple(rows),
        tuple(links),
    )
    scale = Facts(
        "The scale", tuple((state.replace("_", " "), MEANINGS[state]) for state in reversed(SCALE)), 1
    )
    return Page(f"{TITLE}, {write_date(status.as_of)}", headline, (*_tables(table, status.standings), scale))


def _tables(table: Rows, standings: Sequence[Standing]) -> list[Part]:
    """Give the table of those that are not ok, and the others by vehicle."""
    parts: list[Part] = [table] if table.rows else []
    vehicles: dict[str, list[Standing]] = {}
    for each in standings:
        vehicles.setdefault(each.axlebox.vehicle, []).append(each)
    points = []
    for vehicle in sorted(vehicles, key=_in_order):
        every = vehicles[vehicle]
        healthy = [each.axlebox for each in every if each.health.state == OK]
        if len(healthy) == len(every) > 1:
            points.append(f"{vehicle}: all {len(every)}")
        elif healthy:
            ends = sorted(healthy, key=lambda box: (_in_order(box.axle), box.side))
            points.append(f"{vehicle}: {', '.join(f'axle {box.axle} {box.side}' for box in ends)}")
    if points:
        count = sum(each.health.state == OK for each in standings)
        parts.append(Points(f"{count} axleboxes that are ok, by vehicle", tuple(points)))
    return parts


def _in_order(name: str) -> tuple[tuple[str, int], ...]:
    """Give a key by which T2 comes before T10."""
    return tuple((text, int(number or 0)) for text, number in re.findall(r"(\D*)(\d*)", name))


def acknowledged_mark(standing: Standing) -> str:
    """Say who has acknowledged the state."""
    return f", acknowledged by {standing.acknowledged.made_by}" if standing.acknowledged else ""


def since_words(standing: Standing) -> str:
    """Write since when, and at which mileage."""
    health = standing.health
    if not isfinite(health.since):
        return "-"
    text = write_date(health.since)
    return f"{text}, {health.since_mileage / 1e3:,.0f} km" if isfinite(health.since_mileage) else text


def _axlebox_page(store: FleetStore, status: FleetStatus, standing: Standing) -> Page:
    health, last = standing.health, standing.last
    details = [*(f"{each}." for each in health.why[1:]), *(f"Note: {each}." for each in health.notes)]
    if health.part:
        details += [f"{each[0].upper()}{each[1:]}." for each in standing.left.sentences]
    entry = standing.acknowledged
    if entry is not None:
        note = f": {entry.note}" if entry.note else ""
        details.append(f"Acknowledged by {entry.made_by} on {write_date(entry.time)}{note}.")
    headline = Headline(state_word(health.state), f"{health.why[0]}.", COLOURS[health.state], tuple(details))
    parts: list[Part] = [
        Facts("Axlebox", _identity(standing)),
        Picture(
            "Health over time, and the width of the spall",
            (
                Panel(partial(draw_health, points=standing.points), "State of the axlebox over time"),
                Panel(partial(draw_widths, standing=standing), "Width of the spall, 20 mm as a line"),
            ),
            44.0,
        ),
        *_laws_part(standing),
        *_evidence_parts(store, standing),
    ]
    if any(each.number in status.comparisons for each in standing.history):
        parts.append(
            Picture(
                "Compared with the other axleboxes of the train on the same rides",
                (
                    Panel(
                        partial(draw_sisters, status=status, box=standing.axlebox),
                        "Level over the median of the ride, of every axlebox of the train",
                    ),
                ),
                36.0,
            )
        )
    assumed = (*last.analysis.assumed[:_ASSUMED], *standing.left.assumed)
    parts.append(Points("What was assumed", assumed or ("what the recording of the twin states",)))
    parts.append(Points("What to do next", _actions(standing)))
    return Page(f"{standing.rank}. {standing.axlebox.name}", headline, tuple(parts))


def _identity(standing: Standing) -> tuple[tuple[str, str], ...]:
    last, health = standing.last, standing.health
    analysis = last.analysis
    rows = [
        ("Axlebox", standing.axlebox.name),
        ("Train", last.train),
        ("Bearing", standing.bearing),
        ("Since", since_words(standing)),
        ("Recordings of this bearing", str(standing.recordings)),
        ("Last recording", f"{write_time(last.time)} UTC, {Path(last.file).name}"),
    ]
    if isfinite(last.mileage):
        rows.append(("Mileage at the last recording", f"{last.mileage / 1e3:,.0f} km"))
    if isfinite(analysis.temperature):
        rows.append(("Temperature", f"{analysis.temperature - ZERO_CELSIUS:.0f} °C"))
    if isfinite(analysis.shaft_frequency):
        rows.append(("Speed of the shaft", f"{60.0 * analysis.shaft_frequency:.0f} rpm"))
    if health.part:
        rows.append(("Mileage left", standing.left.sentence))
    return tuple(rows)


def _laws_part(standing: Standing) -> list[Part]:
    """Give the table of the laws of growth, where there is something to fit."""
    rows = [
        (
            f"{each.law}{', assumed' if each.is_assumed else ''}",
            "yes" if each.agrees else "no",
            _interval_words([f"{value / 1e3:,.0f} km" for value in each.distance]),
            _interval_words([write_date(value) if isfinite(value) else "-" for value in each.dates]),
        )
        for each in standing.left.laws
    ]
    if not rows:
        return []
    heads = ("law of growth", "agrees with its widths", "mileage left, 90 % interval", "date")
    title = "Mileage until the spall is 20 mm wide, by several laws of growth"
    return [Rows(title, heads, (0.25, 0.17, 0.29, 0.29), tuple(rows), ("",) * len(rows))]


def _interval_words(ends: list[str]) -> str:
    low, likely, high = ends
    return f"{likely} ({low} to {high})"


def _evidence_parts(store: FleetStore, standing: Standing) -> list[Part]:
    """Show spectrum and waveform of the latest recording that names the part, else of the latest called."""
    order = [
        *(each for each in reversed(standing.history) if each.analysis.verdict == standing.health.part),
        *(
            each
            for each in reversed(standing.history)
            if each.analysis.verdict not in ("healthy", "not_diagnosable")
        ),
    ]
    for each in order:
        evidence = store.evidence(each.number)
        if evidence is not None and len(evidence.order):
            return _pictures(evidence, f"recording of {write_time(each.time)} UTC, {Path(each.file).name}")
    return [
        Points(
            "Spectrum and waveform", ("no recording of this bearing has named a part; levels alone differ",)
        )
    ]


def _pictures(evidence: Evidence, of: str) -> list[Part]:
    return [
        Picture(
            f"Spectrum of the envelope, {of}",
            (
                Panel(
                    partial(draw_evidence_spectrum, evidence=evidence),
                    "Spectrum of the envelope with labelled lines of outer ring (BPFO), inner ring (BPFI), "
                    "rollers (2 BSF), cage (FTF) and shaft",
                ),
            ),
            50.0,
        ),
        Picture(
            "Waveform of that recording",
            (
                Panel(partial(draw_evidence_record, evidence=evidence), "Acceleration of the whole record"),
                Panel(partial(draw_evidence_excerpt, evidence=evidence), "Acceleration over three turns"),
            ),
            34.0,
        ),
    ]


def _actions(standing: Standing) -> tuple[str, ...]:
    from beardyn_core.study.report_page.advice import ADVICE

    health = standing.health
    first = f"{standing.advice[0].upper()}{standing.advice[1:]}."
    if health.part:
        return (first, *ADVICE[health.part].actions[:-1], _KEEPER)
    if standing.last.analysis.verdict == "hot_box" or health.state == ACT:
        return (first, *ADVICE["hot_box"].actions)
    return (first, *_BY_LEVELS)
