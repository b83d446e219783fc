"""The verdict as a headline, and what to do next, without more certainty than a monitor has."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Annotated as A

from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.monitor.severity import NOT_MEASURABLE, SEVERE
from beardyn_core.study.inspection import Inspection
from beardyn_core.study.report_page.page import Headline

_GREEN, _GREY, _AMBER, _RED, _DARK = "#2e7d32", "#616161", "#b26a00", "#c62828", "#7f0000"


@dataclass(frozen=True)
class Advice:
    """A kind of verdict in words for who decides."""

    word: A[str, "one or two words in capitals"]
    sentence: str
    colour: str
    actions: A[tuple[str, ...], "what to do next"]


_CONFIRM = (
    "Confirm it: record the same axlebox again at a similar speed, and the axlebox at the other end of the "
    "axle with the same sensor. A fault is in both records of this box and in none of the other."
)
_CHECK_INPUTS = (
    "Check speed and bearing on this page: with a wrong one the strikes of one part can pass for another's."
)
_PLAN = (
    "If a second record agrees, plan to inspect or exchange the bearing. How far the vehicle may run until "
    "then is for the rules of its keeper; this page makes no statement on it."
)
_FAULT_ACTIONS = (_CONFIRM, _CHECK_INPUTS, _PLAN)
_AGAIN = (
    "Do not read this page as healthy: the record does not decide.",
    "Remove the cause that is stated under the verdict, and measure again: accelerometer fixed to the "
    "axlebox, steady speed, 60 revolutions of the wheelset or more, 20 kHz or faster.",
    "Until then, what is known of this bearing is what was known before this record.",
)
ADVICE: dict[str, Advice] = {
    "healthy": Advice(
        "NO FAULT FOUND",
        "No fault found: nothing in this record points to a faulty part of the bearing.",
        _GREEN,
        (
            "No action follows from this record. Keep the usual interval of measurement.",
            "Keep this page and compare the next one with it: a level that rises is a sign, too.",
            "A small fault, or one that carried no load in this record, can be missed. No fault found is no "
            "proof that there is none.",
        ),
    ),
    "cup": Advice(
        "FAULT",
        "Fault of the outer ring (cup): the record has the regular strikes of one.",
        _RED,
        _FAULT_ACTIONS,
    ),
    "cone": Advice(
        "FAULT",
        "Fault of the inner ring (cone): the record has the regular strikes of one.",
        _RED,
        _FAULT_ACTIONS,
    ),
    "roller": Advice(
        "FAULT",
        "Fault of a roller (rolling element): the record has the regular strikes of one.",
        _RED,
        (
            "Confirm it with several records: strikes of a roller come and go as it turns, so that a single "
            "record counts for less than one of a ring.",
            _CHECK_INPUTS,
            _PLAN,
        ),
    ),
    "unexplained": Advice(
        "CHECK",
        "Something strikes regularly, but it fits no part of this bearing at the stated speed.",
        _AMBER,
        (
            "Do not read this page as healthy: the strikes are there.",
            "Check the speed (wheel diameter, gear ratio, tachometer) and the designation of the bearing; "
            "the sentence under the verdict names what would fit.",
            "Look for another source: the wheel tread, a gear, a fan, another bearing on the shaft (name it "
            "with --neighbour). Then make this page again.",
        ),
    ),
    "hot_box": Advice(
        "HOT",
        "The axlebox is hot. The vibration does not name a faulty part.",
        _DARK,
        (
            "Follow the rule of the vehicle for a hot axlebox now. This page does not replace it.",
            "Check the temperature with a second sensor, and compare with the other axleboxes of the "
            "vehicle.",
            "Have the grease and the bearing inspected before it runs again. A brake that drags heats an "
            "axlebox, too.",
        ),
    ),
    "not_diagnosable": Advice(
        "CANNOT TELL", "This record cannot tell whether the bearing is healthy.", _GREY, _AGAIN
    ),
    "waiting": Advice(
        "CANNOT TELL", "This record is too short to tell whether the bearing is healthy.", _GREY, _AGAIN
    ),
}
"""What each of `beardyn_core.monitor.chain.VERDICTS` means for who decides."""
_HOT_FAULT = ADVICE["hot_box"].actions[0]
_SEVERE_FIRST = (
    "Inform the person who is responsible for the maintenance now: the spall is wider than the limit for "
    "severe on this page, which is assumed."
)
_WARM = "The axlebox is warm: watch its temperature, and compare with the other axleboxes of the vehicle."
_CALLED = ("cup", "cone", "roller", "unexplained", "hot_box")
_CONTRARY = (
    "Part of the record, or an earlier file, has another verdict: {}. A fault does not heal, and one that "
    "begins is in the latest part alone. Record again, and find out why the parts differ, before the box "
    "counts as healthy."
)
_MOST = {"healthy": "No fault found in most of the record."}
_CHANCE = 1  # analyses of another verdict that may be chance
_FEW = "One analysis only: record for longer, so that several analyses can agree."


def headline_of(inspection: Inspection, files: Sequence[str] = ()) -> Headline:
    """Write the verdict with its confidence and the size of the fault, or why neither is known."""
    advice, result = ADVICE[inspection.verdict], inspection.results.concluded
    sentence, colour, word = advice.sentence, advice.colour, advice.word
    if inspection.conclusion.finding is None:
        sentence = ADVICE["waiting"].sentence
    if contrary := contrary_verdicts(inspection, files):
        sentence = f"{_MOST.get(inspection.verdict, sentence)} Part of it differs: {', '.join(contrary)}."
        if files and files[-1] in _CALLED:
            sentence += f" The latest file: {in_words(files[-1])}."
        word, colour = f"{word}, CHECK", _AMBER
    finding = inspection.conclusion.finding
    if finding is not None and finding.also_fits:
        others = " and ".join(map(in_words, finding.also_fits))
        sentence += f" The lines fit {others} as well: which of them it is stays open."
    severity = inspection.severity
    if severity is not None and isfinite(severity.width):
        sentence += f" The spall is about {1e3 * severity.width:.1f} mm wide ({severity.grade})."
        word = f"{word}, {severity.grade.upper()}"
        colour = _DARK if severity.grade == SEVERE else colour
    if result is not None and result.temperature_state == "hot" and inspection.verdict != "hot_box":
        sentence, word, colour = f"{sentence} The axlebox is hot as well.", f"{word}, HOT", _DARK
    return Headline(word, sentence, colour, tuple(_details(inspection)))


def _details(inspection: Inspection) -> list[str]:
    run = inspection.run
    found = [f"NOT WHOLE: {run.problem}; this page is about what is there."] if run.problem else []
    found += [f"Confidence: {_confidence(inspection)}", f"The monitor: {inspection.reason}."]
    if (severity := inspection.severity) is not None:
        if isfinite(severity.width):
            found.append(
                f"Size: {1e3 * severity.width:.1f} mm wide in rolling direction, 95 % interval "
                f"{1e3 * severity.low:.1f} to {1e3 * severity.high:.1f} mm."
            )
        else:
            why = severity.reason.removeprefix(f"{NOT_MEASURABLE}: ")
            found.append(f"Size: {NOT_MEASURABLE}; {why}.")
    result = inspection.results.concluded
    if result is not None and isfinite(result.temperature):
        found.append(
            f"Temperature of the axlebox: {result.temperature - ZERO_CELSIUS:.0f} °C, "
            f"{result.temperature_state}."
        )
    return found


def _confidence(inspection: Inspection) -> str:
    """Say how many analyses agree, what the others say, and by how much the alarm was passed."""
    conclusion = inspection.conclusion
    finding = conclusion.finding
    if finding is None:
        return "no analysis was possible."
    if conclusion.analyses == 1:
        text = "a single analysis"
    elif conclusion.agreeing == conclusion.analyses:
        text = f"all {conclusion.analyses} analyses agree"
    else:
        counts = Counter(each.verdict for each in inspection.results.findings)
        others = {name: count for name, count in counts.items() if name not in (finding.verdict, "waiting")}
        told = ", ".join(f"{in_words(name)} {count}" for name, count in others.items())
        text = f"{conclusion.agreeing} of {conclusion.analyses} analyses agree; the others: {told}"
    result = inspection.results.concluded
    if finding.is_fault and result is not None and isfinite(result.threshold):
        text += f". In the latest the fault passes the alarm by {result.score - result.threshold:.1f} dB"
    if isfinite(finding.confidence):
        share = "over 99" if finding.confidence > 0.99 else f"{100.0 * finding.confidence:.0f}"
        text = f"the verdict is right with a probability of {share} %; {text}"
    return f"{text}."


def in_words(verdict: str) -> str:
    """Write a verdict in a few words, for tables."""
    return {
        "healthy": "no fault found",
        "cup": "outer ring (cup)",
        "cone": "inner ring (cone)",
        "roller": "roller",
        "cage": "the cage",
        "hot_box": "hot axlebox",
        "not_diagnosable": "cannot tell",
        "waiting": "too short",
    }.get(verdict, verdict)


def contrary_verdicts(inspection: Inspection, files: Sequence[str] = ()) -> list[str]:
    """List what speaks against a healthy verdict: analyses of a fault, and files with one, in words.

    Parameters
    ----------
    files : sequence of str
        Verdicts of the files over time, where there are several.
    """
    if inspection.verdict in _CALLED:
        return []
    counts = Counter(each.verdict for each in inspection.results.findings)
    analyses = inspection.conclusion.analyses
    found = {
        verdict: f"{in_words(verdict)} in {counts[verdict]} of {analyses} analyses"
        for verdict in _CALLED
        if counts[verdict] > _CHANCE
    }
    for verdict, count in Counter(files).items():
        if verdict in _CALLED:
            found.setdefault(verdict, f"{in_words(verdict)} in {count} of {len(files)} files")
    return list(found.values())


def actions_for(inspection: Inspection, files: Sequence[str] = ()) -> tuple[str, ...]:
    """List what to do next; the verdicts of files over time, where there are some, may speak against it."""
    actions = list(ADVICE[inspection.verdict].actions)
    severity, result = inspection.severity, inspection.results.concluded
    if severity is not None and severity.grade == SEVERE:
        actions.insert(0, _SEVERE_FIRST)
    if result is not None and result.temperature_state == "hot" and inspection.verdict != "hot_box":
        actions.insert(0, _HOT_FAULT)
    if result is not None and result.temperature_state == "warm":
        actions.append(_WARM)
    if contrary := contrary_verdicts(inspection, files):
        actions = [_CONTRARY.format(", ".join(contrary)), *actions[1:]]
    if inspection.conclusion.analyses == 1:
        actions.append(_FEW)
    return tuple(actions)
