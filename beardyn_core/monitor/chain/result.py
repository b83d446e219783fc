"""Result of a monitoring algorithm."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.monitor.chain.confidence import Grounds
from beardyn_core.monitor.chain.explanations import Explanation
from beardyn_core.monitor.chain.fault_lines import Line
from beardyn_core.monitor.features import OrderSpectrum
from beardyn_core.monitor.severity import Severity

VERDICTS = ("waiting", "healthy", "cup", "cone", "roller", "unexplained", "hot_box", "not_diagnosable")


@dataclass(frozen=True)
class MonitorResult:
    """Result of the monitor at one time; an algorithm sets the fields that it computes."""

    verdict: A[
        str,
        "one of `VERDICTS`: ``waiting`` where there is not enough signal yet, ``not_diagnosable`` where "
        "more of it would not help, ``unexplained`` where strikes fit no part at the stated speed",
    ]
    reason: A[str, "the verdict in a sentence"]
    end_ns: A[int, "simulated time of the last sample analysed, [ns]"]
    confidence: A[
        float,
        "probability that the verdict is right, NaN of one that cannot tell; see `chain.confidence`, [-]",
    ] = np.nan
    grounds: A[Grounds | None, "what that rests on"] = None
    fault_order: A[float, "found, NaN without a fault, per shaft revolution"] = np.nan
    fault_frequency: A[float, "the same, [Hz]"] = np.nan
    expected_order: A[float, "of that fault from bearing data, [-]"] = np.nan
    expected_frequency: A[float, "of that fault from bearing data, [Hz]"] = np.nan
    fitting_shaft_frequency: A[
        float, "speed at which a fault has its order without slip, or a comb that of a part; else NaN, [Hz]"
    ] = np.nan
    comb_order: A[float, "of strikes that fit no part at the stated speed, NaN without, [-]"] = np.nan
    comb_frequency: A[float, "of these strikes, [Hz]"] = np.nan
    comb_strikes: A[float, "what they make of the mean power, [-]"] = np.nan
    fits: A[tuple[Explanation, ...], "what would explain them"] = ()
    score: A[float, "of the strongest candidate, [dB]"] = 0.0
    threshold: A[float, "score from which it is called, [dB]"] = np.nan
    scores: A[tuple[float, float, float], "for cup, cone and roller, NaN without their order, [dB]"] = (
        0.0,
        0.0,
        0.0,
    )
    not_judged: A[
        tuple[str, ...],
        "parts whose order is not known, or whose lines are multiples of the shaft's",
    ] = ()
    also_fits: A[
        tuple[str, ...],
        "other parts that explain the lines of the one that is named as well; ``cage``, which is never "
        "named, where strikes come and go with it",
    ] = ()
    lines: A[tuple[Line, ...], "lines of the strongest candidate that stand out one by one"] = ()
    strongest_order: A[float, "of the strongest line above the cage's own, [-]"] = np.nan
    strongest_level: A[float, "of that line, [dB]"] = np.nan
    band: A[tuple[float, float], "of the envelope, [Hz]"] = (np.nan, np.nan)
    rms: A[float, "levels in the usual band, [m/s^2]"] = np.nan
    kurtosis: A[float, "levels in the usual band, [-]"] = np.nan
    crest: A[float, "levels in the usual band, [-]"] = np.nan
    rms_rise: A[float, "over earlier stretches at a like speed, NaN without, [dB]"] = np.nan
    shaft_frequency: A[float, "mean, [Hz]"] = np.nan
    speed_change: A[
        float, "of a speed that is stated as constant, by the rate of strikes; NaN where none was found, [-]"
    ] = np.nan
    revolutions: A[float, "shaft revolutions analysed, [-]"] = 0.0
    load: A[float, "mean vertical load, [N]"] = np.nan
    temperature: A[float, "of the axlebox, NaN when unknown, [K]"] = np.nan
    temperature_state: A[str, "``unknown``, ``normal``, ``warm`` or ``hot``"] = "unknown"
    spectrum: A[OrderSpectrum | None, "of the envelope"] = None
    severity: A[
        Severity | None, "size and stage of the spall; a `Monitor` that knows the bearing sets it"
    ] = None
