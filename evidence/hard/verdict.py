"""From measures, limits and reports to a verdict."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from beardyn_core.physics.tiers.status import SENTENCES, Status
from evidence.hard.case import HardCase
from evidence.hard.refinement import Change
from evidence.hard.watch import Measures

HOLDS, REPORTS, ENDS, REFUSED = "holds", "reports", "ends", "refused"
FAILED, KNOWN, SKIPPED = "FAILED", "known failure", "skipped"
GOOD = (HOLDS, REPORTS, ENDS, REFUSED)


@dataclass(frozen=True)
class Outcome:
    """What became of a case.

    Parameters
    ----------
    name : str
    verdict : str
        ``holds``; ``reports``, it goes on and says what is wrong; ``ends`` or ``refused`` with a sentence;
        ``FAILED``; ``known failure``; ``skipped``.
    reasons : tuple of str
        Why it failed or was skipped.
    measures : Measures
    changes : tuple of Change
        What half the step changes.
    sentence : str
        With which it ended, was refused or reports.
    wall : float
        [s].
    starts, held : int
        How many starts a nanometre apart were run, and how many of them came to a good verdict, the same one.
    """

    name: str
    verdict: str
    reasons: tuple[str, ...] = ()
    measures: Measures = field(default_factory=Measures)
    changes: tuple[Change, ...] = ()
    sentence: str = ""
    wall: float = 0.0
    starts: int = 1
    held: int = 1


@dataclass(frozen=True)
class Finding:
    """What a run gave, before it is judged; see `Outcome`."""

    measures: Measures
    changes: tuple[Change, ...] = ()
    sentence: str = ""
    refused: bool = False
    refined_status: int = 0


def judged(case: HardCase, finding: Finding, wall: float) -> Outcome:
    """Judge a case."""
    reasons = tuple(_complaints(case, finding))
    status = Status(finding.measures.status)
    sentence = finding.sentence or "; ".join(SENTENCES[flag] for flag in SENTENCES if flag in status)
    if reasons:
        verdict = KNOWN if case.known_failure else FAILED
    elif finding.sentence:
        verdict = REFUSED if finding.refused else ENDS
    else:
        verdict = REPORTS if status else HOLDS
    return Outcome(case.name, verdict, reasons, finding.measures, finding.changes, sentence, wall)


# Of several starts the page shows the largest.
_WORST = ("energy_residual", "penetration", "chatter_index", "axis_error", "quaternion_error",
          "momentum_residual", "roller_load")  # fmt: skip


def over_starts(case: HardCase, found: Sequence[Outcome], wall: float) -> Outcome:
    """Sum up the outcomes of several starts; a verdict that a nanometre changes is a failure.

    Parameters
    ----------
    case : HardCase
    found : sequence of Outcome
        The first one is that of the scene itself.
    wall : float
        [s].
    """
    first, reasons = found[0], list(found[0].reasons)
    for start, outcome in enumerate(found[1:], start=1):
        reasons += [f"begun {start} nm apart: {reason}" for reason in outcome.reasons]
        if not outcome.reasons and outcome.verdict != first.verdict:
            reasons.append(f"begun {start} nm apart: {outcome.verdict}")
    held = sum(outcome.verdict in GOOD and outcome.verdict == first.verdict for outcome in found)
    verdict = first.verdict if not reasons else KNOWN if case.known_failure else FAILED
    worst: dict[str, Any] = {}
    for name in _WORST:
        values = [value for outcome in found if (value := getattr(outcome.measures, name)) is not None]
        if values:
            worst[name] = max(values, key=lambda value: (math.isnan(value), value))
    # with the bits of every start: the largest value may be that of a start that says so
    for outcome in found:
        worst["status"] = worst.get("status", 0) | outcome.measures.status
    measures = replace(first.measures, **worst)
    return replace(
        first, verdict=verdict, reasons=tuple(reasons), measures=measures, wall=wall, starts=len(found),
        held=held,
    )  # fmt: skip


def _complaints(case: HardCase, finding: Finding) -> list[str]:
    measures = finding.measures
    found = list(_about_the_sentence(case, finding))
    status = Status(measures.status)
    missing = case.must_report & ~status
    if missing and not (case.run_as == "coarse step" and case.must_report & status):
        found.append(f"does not report {missing!r}")
    fatal = Status.NOT_FINITE | Status.PENETRATION | Status.OFF_RIB
    excused = case.must_report | case.may_report | (fatal if case.sentence else Status.FINE)
    if surplus := status & ~excused:
        found.append(f"reports {surplus!r}: {'; '.join(SENTENCES[f] for f in SENTENCES if f in surplus)}")
    if not measures.finite and not status & Status.NOT_FINITE:
        found.append("has numbers that are not finite and does not report them")
    blown_up = case.must_report & status & Status.NOT_FINITE  # nothing is left to be measured
    if not case.sentence and not blown_up:
        found += _beyond_limits(case, measures, chatters=bool(status & Status.CHATTER))
    if not status & Status.CHATTER:  # a run that says its friction is not converged is not asked again
        found += [
            f"half the step changes {change.statistic} by {change.change:+.2%}, its band is {change.band:.2%}"
            for change in finding.changes
            if not change.inside
        ]
    return found


def _about_the_sentence(case: HardCase, finding: Finding) -> list[str]:
    if case.sentence and not finding.sentence:
        return [f"goes on in silence; expected the sentence '... {case.sentence} ...'"]
    if case.sentence not in finding.sentence:
        return [f"ends with '{finding.sentence}'; expected '... {case.sentence} ...'"]
    if finding.sentence and not case.sentence:
        return [f"ends: {finding.sentence}"]
    return []


def _beyond_limits(case: HardCase, measures: Measures, chatters: bool) -> list[str]:
    found = []
    for limit in case.all_limits:
        value = getattr(measures, limit.measure)
        if value is None or (limit.measure == "chatter_index" and chatters):
            continue
        if not limit.low <= value <= limit.high:  # also true for NaN
            low = "" if limit.low == -math.inf else f"{limit.low:.4g} to "
            found.append(f"{limit.measure} is {value:.4g}; allowed is {low or 'up to '}{limit.high:.4g}")
    return found
