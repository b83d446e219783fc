"""The pages of inspections: one for each bearing, an overview first where there are several."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Annotated as A

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.monitor.streaming import measured_axes
from beardyn_core.scene.scene import Scene
from beardyn_core.study.inspection import Inspection
from beardyn_core.study.monitored_recording import rank_of
from beardyn_core.study.report_page.advice import actions_for, contrary_verdicts, headline_of, in_words
from beardyn_core.study.report_page.assumptions import assumed_rows
from beardyn_core.study.report_page.file_levels import FileLevel, level_rows, levels_of
from beardyn_core.study.report_page.identity import OF_THE_RECORD, identity_rows, signal_of
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
from beardyn_core.study.report_page.page_pictures import (
    draw_levels,
    draw_spectrum,
    draw_strikes,
    draw_waveform,
)

Records = Sequence[Sequence[Inspection]]
TITLE = "Condition of an axlebox bearing"
_SPECTRUM, _WAVEFORM, _LEVELS = 54.0, 36.0, 30.0  # heights of pictures, [mm]


@dataclass(frozen=True)
class Names:
    """What a person calls the things on the page; empty: what the files say."""

    train: A[str, "train or vehicle"] = ""
    axlebox: A[str, "such as axle 2 left"] = ""


def page_report(records: Records, names: Names, foot: str) -> PageReport:
    """Compose the pages.

    Parameters
    ----------
    records : sequence of sequence of Inspection
        The bearings of each recording or measurement, in the order of time.
    names : Names
    foot : str
        A line at the end of each page.
    """
    history: dict[str, list[Inspection]] = {}
    for record in records:
        for each in record:
            history.setdefault(each.mounted.label, []).append(each)
    ranked = sorted(history.items(), key=lambda item: _urgency(item[1][-1]), reverse=True)
    pages = [_bearing_page(label, each, names, alone=len(ranked) == 1) for label, each in ranked]
    if len(ranked) > 1:
        pages.insert(0, _overview(dict(ranked), names))
    return PageReport(TITLE, tuple(pages), foot)


def _urgency(inspection: Inspection) -> tuple[int, bool]:
    """Rank a bearing: by its verdict, and of the same verdict those first of which a part differs."""
    return rank_of(inspection.verdict), bool(contrary_verdicts(inspection))


def _overview(history: dict[str, list[Inspection]], names: Names) -> Page:
    latest = {label: each[-1] for label, each in history.items()}
    worst = next(iter(latest))
    headline = headline_of(latest[worst])
    rows = tuple(
        (str(number), label, _verdict(each), _agreement(each), _size(each), _rms(each))
        for number, (label, each) in enumerate(latest.items(), 1)
    )
    table = Rows(
        "All bearings, the worst first; each has a page of its own after this one",
        ("no.", "axlebox, bearing", "verdict", "analyses that agree", "width of the spall, mm", "rms, m/s²"),
        (0.06, 0.2, 0.34, 0.14, 0.16, 0.1),
        rows,
    )
    identity = identity_rows(latest[worst], train=names.train, scene=_scene_of(latest[worst]))
    record = Facts("Record", tuple(each for each in identity if each[0] in OF_THE_RECORD))
    first = Headline(
        headline.word,
        f"Worst of {len(rows)}: {worst}. {headline.sentence}",
        headline.colour,
        tuple(each for each in headline.details if each.startswith(("Confidence", "Size"))),
    )
    title = f"Overview of {len(rows)} bearings"
    return Page(f"{title}, {names.train}" if names.train else title, first, (record, table))


def _verdict(inspection: Inspection) -> str:
    word, words = headline_of(inspection).word, in_words(inspection.verdict)
    return word if words.upper() == word else f"{word}: {words}"


def _rms(inspection: Inspection) -> str:
    values = measured_axes(signal_of(inspection).values)
    return f"{float(np.sqrt(np.sum(values.var(axis=0)))):.3g}" if len(values) else "-"


def _agreement(inspection: Inspection) -> str:
    conclusion = inspection.conclusion
    return f"{conclusion.agreeing} of {conclusion.analyses}" if conclusion.analyses else "no analysis"


def _size(inspection: Inspection) -> str:
    severity = inspection.severity
    if severity is None:
        return "-"
    if severity.width == severity.width:
        return f"{1e3 * severity.width:.1f} ({1e3 * severity.low:.1f} to {1e3 * severity.high:.1f})"
    return "not measurable"


def _bearing_page(label: str, history: Sequence[Inspection], names: Names, *, alone: bool) -> Page:
    inspection = history[-1]
    scene, levels = _scene_of(inspection), levels_of(history)
    verdicts = [each.verdict for each in levels]
    axlebox = names.axlebox if alone else ""
    identity = identity_rows(inspection, train=names.train, axlebox=axlebox, scene=scene)
    parts: list[Part] = [
        Facts("Record", identity),
        Picture(
            "Spectrum of the envelope",
            (
                Panel(
                    partial(draw_spectrum, inspection=inspection),
                    "Spectrum of the envelope over the order, with labelled lines of outer ring (BPFO), "
                    "inner ring (BPFI), rollers (2 BSF), cage (FTF) and shaft",
                ),
            ),
            _SPECTRUM,
        ),
        Picture(
            "Waveform",
            (
                Panel(partial(draw_waveform, inspection=inspection), "Acceleration of the whole record"),
                Panel(
                    partial(draw_strikes, inspection=inspection), "Acceleration over three turns of the shaft"
                ),
            ),
            _WAVEFORM,
        ),
        *_trend_parts(history, levels),
        Facts("What was assumed", assumed_rows(inspection, scene)),
        Points("What to do next", actions_for(inspection, verdicts)),
    ]
    name = axlebox or ("" if alone else label)
    title = ", ".join(each for each in (TITLE, names.train, name) if each)
    return Page(title, headline_of(inspection, verdicts), tuple(parts))


def _trend_parts(history: Sequence[Inspection], levels: Sequence[FileLevel]) -> list[Part]:
    if not levels:
        return []
    order = "in the order given; the last one is the record of this page"
    if len(history) == 1:
        order = "in the order given; an analysis may begin in the file before"
    return [
        Picture(
            f"Levels over {len(levels)} files{_rise(levels)}",
            (
                Panel(
                    partial(draw_levels, levels=levels),
                    "Level of each file over its number, with its verdict",
                ),
            ),
            _LEVELS,
        ),
        Rows(
            f"Verdicts over {len(levels)} files {order}",
            ("no.", "file", "date", "rms, m/s²", "peak, m/s²", "verdict, analyses that agree"),
            (0.08, 0.32, 0.18, 0.10, 0.10, 0.22),
            level_rows(levels),
        ),
    ]


def _rise(levels: Sequence[FileLevel]) -> str:
    """Compare the level of the last file with those before."""
    before = [each.rms for each in levels[:-1] if each.rms > 0.0]
    if not before or not levels[-1].rms > 0.0:
        return ""
    rise = 20.0 * float(np.log10(levels[-1].rms / np.median(before)))
    return f", the last {rise:+.1f} dB to the median before it; speed and track change levels, too"


def _scene_of(inspection: Inspection) -> Scene | None:
    """Read the scene of a simulated recording; ``None`` where there is none that can be read."""
    from beardyn_core.choice import scene_from_text

    run = inspection.run
    if not run.scene_text:
        return None
    with suppress(InputError):
        return scene_from_text(run.scene_text, run.label)
    return None
