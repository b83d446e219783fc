"""The reference monitoring chain: plain functions, each of which can be replaced.

================= ========================================================================================
module            responsibility
================= ========================================================================================
inputs            what an algorithm gets: vibration, shaft angle, load, temperature, and what can be tuned
diagnosable       finds signals in which no fault can show
kurtogram         another select_band: where the spectral kurtosis is largest
whitening         select_band and whiten: all that is usable, every frequency with the same weight
wheel             takes out what turns with the wheel (flats, polygons)
whole_orders      a fault that a wrong speed puts among the lines of the wheel
tracking          track: over the angle of the shaft, as logarithm
false_alarm_rate  how often noise has such lines: evidence, and the threshold of a stated rate
competing_orders  evenly spaced lines that no pattern explains
explanations      what would explain such lines: another speed, another bearing
fault_lines       score: power on the lines of each fault against noise
cage_turns        score, too: rolling elements that come and go with the cage
impulsiveness     how much of the power as measured comes in short strikes
levels            RMS, kurtosis, crest factor and their trend
verdict           decide: which fault is called, and why; the temperature rule
ambiguity         parts that a verdict cannot speak of, or cannot tell apart
speed_drift       whether a speed that is stated as constant changes
confidence        what a verdict rests on, and how often such verdicts are right
result            what an algorithm answers
chain             `Chain`: the steps put together, each replaceable
timeout           waits for a function, but not for ever
algorithm_by_name finds an algorithm by its name ``module:function``, and checks its answer
================= ========================================================================================
"""

from beardyn_core.monitor.chain.algorithm_by_name import algorithm_named, answer_of
from beardyn_core.monitor.chain.chain import REFERENCE, Algorithm, Chain
from beardyn_core.monitor.chain.diagnosable import NOT_DIAGNOSABLE
from beardyn_core.monitor.chain.explanations import Explanation
from beardyn_core.monitor.chain.fault_lines import FAULTS, FaultLines, Line
from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.chain.kurtogram import Band
from beardyn_core.monitor.chain.result import VERDICTS, MonitorResult
from beardyn_core.monitor.chain.verdict import HEALTHY, Verdict

__all__ = [
    "FAULTS",
    "HEALTHY",
    "NOT_DIAGNOSABLE",
    "REFERENCE",
    "VERDICTS",
    "Algorithm",
    "Band",
    "Chain",
    "Explanation",
]
__all__ += [
    "FaultLines",
    "Line",
    "MonitorResult",
    "MonitorSettings",
    "Stretch",
    "Verdict",
    "algorithm_named",
    "answer_of",
]
