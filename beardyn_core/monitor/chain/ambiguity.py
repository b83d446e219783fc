"""Parts that a verdict cannot speak of, and parts that it cannot tell apart."""

from __future__ import annotations

from math import log

from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain.explanations import PART_NAMES
from beardyn_core.monitor.chain.fault_lines import FAULTS, SHAFT_REACH, Candidate, fault_patterns
from beardyn_core.monitor.chain.inputs import MonitorSettings

CAGE = "cage"  # no part that is named, but one that may be meant
ON_THE_SHAFT = "whose lines are multiples of the shaft's"
_HIDDEN = (1, 2)  # harmonics without which a comb is not found
_ALIKE = 0.006  # orders that differ by less are one, [-]
_AS_SURE = 0.9  # of the evidence of the part that is named, from which another one explains the lines as well


def parts_without_order(orders: FaultFrequencies) -> tuple[str, ...]:
    """List the parts that cannot be judged, since the bearing data do not give their orders."""
    known = {each.fault for each in fault_patterns(orders)}
    return tuple(part for part in FAULTS if part not in known)


def parts_on_the_shaft(orders: FaultFrequencies, revolutions: float) -> tuple[str, ...]:
    """List the parts whose lines lie where those of the shaft are, which are left out.

    Parameters
    ----------
    revolutions : float
        Of the stretch: the longer it is, the nearer to a multiple of the shaft lines are seen apart.
    """
    reach = SHAFT_REACH / revolutions
    return tuple(
        each.fault
        for each in fault_patterns(orders)
        if all(abs(h * each.order - round(h * each.order)) <= reach for h in _HIDDEN)
    )


def not_judged_sentence(unknown: tuple[str, ...], hidden: tuple[str, ...]) -> str:
    """Say which parts are not judged and why, empty where all are."""
    several = ((unknown, "whose order is not known"), (hidden, ON_THE_SHAFT))
    return "; ".join(
        f"not judged: {', '.join(PART_NAMES[part] for part in parts)}, {why}"
        for parts, why in several
        if parts
    )


def comes_with_the_cage(best: Candidate, settings: MonitorSettings) -> bool:
    """Tell whether a fault of rolling elements shows in the turns of the cage alone, as one of it would."""
    return best.pattern.cage > 0.0 and best.stated(-log(settings.false_alarm_rate))[1] == best.pattern.cage


def alike_parts(best: Candidate, candidates: tuple[Candidate, ...]) -> tuple[str, ...]:
    """List the other parts that explain the lines of a candidate as well as it does.

    A fault may lack the sidebands of its part: a comb alone counts.
    """
    return tuple(
        each.pattern.fault
        for each in candidates
        if each.pattern.fault != best.pattern.fault
        and abs(each.order / best.order - 1.0) <= _ALIKE
        and max(each.evidence, each.alone) >= _AS_SURE * best.evidence
    )
