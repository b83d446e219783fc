"""The monitor: collects the signals of a train and passes the last revolutions to an algorithm."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Annotated as A
from typing import NamedTuple

import numpy as np
from scipy.fft import next_fast_len

from beardyn_core.base.arrays import Float, Int
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.monitor import chain
from beardyn_core.monitor.chain.levels import Levels
from beardyn_core.monitor.rotation_segments import Legs, turning_legs
from beardyn_core.monitor.severity import Severity, severity_near, unmeasured
from beardyn_core.sensors.block import Block

_REMEMBERED = 1000  # results whose levels are kept for the trend
_HEATING_NS = 60_000_000_000  # over which the rise of the temperature is taken
_LEAST_HEATING_NS = 10_000_000_000
_BELIEVED_AFTER = 5  # blocks of a stream in a row behind its last one, after which its time has jumped back
# a spall is measured again on a stretch so many times as long, and after so long: spalls grow in days
_LONGER, _SIZED_FOR_NS = 1.25, 30_000_000_000
_SIZE_REVOLUTIONS = 200.0  # of which the size of a spall is measured, as far as they are there
_SAMPLES_OF_A_PASSAGE = 16  # at least, for two events in it
_WINDOWS_KEPT = 2  # of the longest, of a stream that the others do not follow


@dataclass(frozen=True)
class MonitorInput:
    """Signals of a short time that a train passes to its monitor; the only input of a `Monitor`."""

    vibration_time_ns: A[Int, "shape [sample], [ns]"]
    acceleration: A[Float, "shape [sample, axis], of one accelerometer, [m/s^2]"]
    shaft_time_ns: A[Int, "shape [sample], [ns]"]
    shaft_angle: A[Float, "shape [sample], [rad]"]
    load_time_ns: A[Int, "shape [sample], [ns]"]
    vertical_load: A[Float, "shape [sample], [N]"]
    temperature_time_ns: A[Int, "shape [sample], [ns], empty without a thermometer"]
    temperature: A[Float, "shape [sample], of the axlebox, [K]"]

    @classmethod
    def of_block(cls, block: Block) -> MonitorInput:
        """Take from a block the signals that a train would measure."""
        first, box = block.vibration[0], block.box_temperature
        return cls(
            first.time_ns, first.acceleration, block.trend_time_ns, block.shaft_angle,
            block.trend_time_ns, block.load[:, 2],
            np.array([] if box is None else [block.end_ns], np.int64),
            np.array([] if box is None else [box]),
        )  # fmt: skip


def measured_axes(acceleration: Float) -> Float:
    """Leave out the axes that were not measured, NaN from end to end, shape [sample, axis]."""
    absent = np.isnan(acceleration).all(axis=0)
    return acceleration if absent.all() or not absent.any() else acceleration[:, ~absent]


def run_monitor(monitor: Monitor, inputs: Iterable[MonitorInput]) -> Iterator[chain.MonitorResult]:
    """Feed a monitor with a run, live or recorded, and give its results as they become due.

    Parameters
    ----------
    inputs : iterable of MonitorInput
        Such as ``map(MonitorInput.of_block, blocks)`` or ``run.monitor_inputs()``.
    """
    for part in inputs:
        result = monitor.take(part)
        if result is not None:
            yield result


def fast_length(count: int) -> int:
    """Find the largest number of samples up to a count of which Fourier transforms are fast.

    A length with a large prime factor takes 4 to 10 times as long, and transforms are most of an analysis.
    From 5000 samples on at most 1.6 % are left out, from 20 000 on at most 1 %.
    """
    return next((length for length in range(count, 0, -1) if next_fast_len(length) == length), 0)


def _severity_of(
    result: chain.MonitorResult, acceleration: Float, rate: float, angle: Float, bearing: NamePlate
) -> Severity:
    """Measure the spall of the fault that an algorithm has named."""
    if not np.isfinite(result.fault_order):
        return unmeasured("the monitor states no order of the fault")
    turns_a_sample = float(angle[-1] - angle[0]) / (2.0 * np.pi * len(angle))
    if not 0.0 < result.fault_order * turns_a_sample * _SAMPLES_OF_A_PASSAGE < 1.0:
        return unmeasured(f"a passage at order {result.fault_order:g} has too few samples")
    axes = acceleration[:, np.ptp(acceleration, axis=0) > 0.0]
    return severity_near(axes, rate, angle, result.verdict, result.fault_order, bearing)


class _Sized(NamedTuple):
    """Spall that was measured last."""

    fault: str
    revolutions: float  # it was measured on
    end_ns: int  # of these
    severity: Severity


class _Samples:
    """Samples of a stream in their blocks, joined when somebody looks: joining each costs its square.

    Parameters
    ----------
    axes : tuple of int
        Shape of one sample.
    longest_ns : int
        What is kept when it would become twice as long, [ns].
    """

    def __init__(self, axes: tuple[int, ...], longest_ns: int) -> None:
        self._longest_ns = longest_ns
        self.axes = axes
        self.clear()

    def __len__(self) -> int:
        return self._count

    def clear(self) -> None:
        """Drop everything."""
        self._blocks: list[tuple[Int, Float]] = [(np.empty(0, np.int64), np.empty((0, *self.axes)))]
        self._count = 0

    def append(self, time_ns: Int, values: Float) -> None:
        """Add a block that is not empty; the oldest go when nobody has wanted them for long."""
        if len(self._blocks) == 1 and not len(self._blocks[0][0]):
            self._blocks = []
        self._blocks.append((np.array(time_ns), np.array(values)))  # the sender may use its arrays again
        self._count += len(time_ns)
        if self.last_ns - self.first_ns > _WINDOWS_KEPT * self._longest_ns:
            self.forget(self.last_ns - self._longest_ns)

    @property
    def first_ns(self) -> int:
        """Time of the first sample, [ns]; there must be one."""
        return int(self._blocks[0][0][0])

    @property
    def last_ns(self) -> int:
        """Time of the last sample, [ns]; there must be one."""
        return int(self._blocks[-1][0][-1])

    def joined(self) -> tuple[Int, Float]:
        """Give times, shape [sample], [ns], and values, shape [sample, ...]."""
        if len(self._blocks) > 1:
            times, values = zip(*self._blocks, strict=True)
            self._blocks = [(np.concatenate(times), np.concatenate(values))]
        return self._blocks[0]

    def forget(self, before_ns: int, spared: int = 0) -> None:
        """Drop the samples before a time, [ns], but the last `spared` of them."""
        time_ns, values = self.joined()
        kept = max(0, int(np.searchsorted(time_ns, before_ns, side="right" if spared else "left")) - spared)
        self._blocks = [(time_ns[kept:], values[kept:])]
        self._count = len(time_ns) - kept


class Monitor:
    """Collects streams and analyses the last revolutions from time to time.

    Parameters
    ----------
    orders : FaultFrequencies
        Of one row, per shaft revolution, from bearing data; NaN where one is not known, not all.
    roller_count : int
        Rollers of one row; 0 where that is not known.
    rate : float, optional
        Of the vibration, by default as its first block is stamped, [Hz].
    algorithm : function, optional
        In place of the reference chain.
    bearing : NamePlate, optional
        What the spall of a fault is measured with; without it no size is given.

    Attributes
    ----------
    lost : int
        Gaps found in the vibration; the signal before a gap is dropped.
    refused : int
        Blocks with NaN, time that does not increase, or another number of axes.
    restarts : int
        Times at which the time of a stream jumped back, as after one block that was stamped too late: after
        some blocks behind it the monitor begins anew.
    """

    def __init__(
        self,
        orders: FaultFrequencies,
        roller_count: int,
        rate: float | None = None,
        settings: chain.MonitorSettings | None = None,
        algorithm: chain.Algorithm = chain.REFERENCE,
        bearing: NamePlate | None = None,
    ) -> None:
        self.orders = orders
        self.bearing = bearing
        self.roller_count = roller_count
        self.rate = rate
        self.settings = settings or chain.MonitorSettings()
        self.algorithm = algorithm
        self.lost = 0
        self.refused = 0
        self.restarts = 0
        self._behind = {"vibration": 0, "shaft": 0}  # blocks in a row behind the last one of the stream
        longest_ns = round(self.settings.longest_window * 1e9)
        self._vibration = _Samples((3,), longest_ns)
        self._shaft = _Samples((), longest_ns)
        self._load = _Samples((), longest_ns)
        self._temperatures: list[tuple[int, float]] = []
        self._levels: list[Levels] = []
        self._next_ns: int | None = None
        self._analysed_ns = -1
        self._sized = _Sized("", 0.0, 0, unmeasured(""))
        self._changed_ns: int | None = None  # when a speed that is stated as constant was found to change

    def take(self, part: MonitorInput) -> chain.MonitorResult | None:
        """Add the samples of all streams, and give a new result when one is due."""
        self.push_vibration(part.vibration_time_ns, part.acceleration)
        self.push_shaft(part.shaft_time_ns, part.shaft_angle)
        self.push_load(part.load_time_ns, part.vertical_load)
        for time_ns, temperature in zip(
            part.temperature_time_ns.tolist(), part.temperature.tolist(), strict=True
        ):
            self.push_temperature(time_ns, temperature)
        return self.update()

    def push_vibration(self, time_ns: Int, acceleration: Float) -> None:
        """Add a block of vibration.

        Parameters
        ----------
        time_ns : int64 array, shape [sample]
        acceleration : array, shape [sample, axis] or, of one axis, [sample]
            [m/s^2]; as many axes as in the block before.
        """
        if not len(time_ns):
            return
        if acceleration.ndim == 1:
            acceleration = acceleration[:, None]
        known = len(self._vibration) > 0
        if not known:
            self._vibration.axes = acceleration.shape[1:]
        elif acceleration.shape[1:] != self._vibration.axes:
            self.refused += 1
            return
        if not np.isfinite(acceleration).all() or (np.diff(time_ns) <= 0).any():
            self.refused += 1
            return
        if self._is_behind("vibration", self._vibration, time_ns):
            return
        known = len(self._vibration) > 0
        if self.rate is None and len(time_ns) > 1:
            self.rate = (len(time_ns) - 1) * 1e9 / float(time_ns[-1] - time_ns[0])
        if known and self.rate and (time_ns[0] - self._vibration.last_ns) * 1e-9 * self.rate > 1.5:
            self.lost += 1
            self._vibration.clear()
        self._vibration.append(time_ns, acceleration)

    def push_shaft(self, time_ns: Int, angle: Float) -> None:
        """Add tachometer samples; an angle that wraps is unwrapped.

        Parameters
        ----------
        time_ns : int64 array, shape [sample]
        angle : array, shape [sample]
            Less than half a revolution between samples, [rad].
        """
        if not len(time_ns):
            return
        if (np.diff(time_ns) <= 0).any() or not np.isfinite(angle).all():
            self.refused += 1
            return
        if self._is_behind("shaft", self._shaft, time_ns):
            return
        before = self._shaft.joined()[1][-1:]
        self._shaft.append(time_ns, np.unwrap(np.concatenate((before, angle)))[len(before) :])

    def _is_behind(self, name: str, stream: _Samples, time_ns: Int) -> bool:
        """Tell whether a block is behind the last one of its stream, which refuses it; several begin anew."""
        if not len(stream) or time_ns[0] > stream.last_ns:
            self._behind[name] = 0
            return False
        self._behind[name] += 1
        if self._behind[name] < _BELIEVED_AFTER:
            self.refused += 1
            return True
        self._begin_anew(int(time_ns[0]))
        return False

    def _begin_anew(self, from_ns: int) -> None:
        """Drop what is later than the present time, [ns], because the clock has jumped back."""
        self.restarts += 1
        for name, stream in (("vibration", self._vibration), ("shaft", self._shaft), ("load", self._load)):
            if len(stream) and stream.last_ns >= from_ns:
                stream.clear()
                self._behind[name] = 0
        self._temperatures = [each for each in self._temperatures if each[0] < from_ns]
        self._next_ns, self._analysed_ns, self._changed_ns = None, -1, None

    def push_load(self, time_ns: Int, vertical: Float) -> None:
        """Add samples of the vertical load, [N]."""
        if len(time_ns):
            self._load.append(time_ns, vertical)

    def push_temperature(self, time_ns: int, temperature: float) -> None:
        """Add the temperature of the axlebox at one time, [K]."""
        if np.isfinite(temperature) and (not self._temperatures or time_ns > self._temperatures[-1][0]):
            self._temperatures.append((time_ns, temperature))

    def update(self) -> chain.MonitorResult | None:
        """Return a new result when one is due, else None."""
        if not len(self._vibration) or not len(self._shaft):
            return None
        end = min(self._vibration.last_ns, self._shaft.last_ns)
        if self._next_ns is None:
            self._next_ns = self._vibration.first_ns + round(self.settings.interval * 1e9)
        if end < self._next_ns:
            return None
        interval = round(self.settings.interval * 1e9)
        self._next_ns += interval * (1 + (end - self._next_ns) // interval)
        return self.result()

    def behind(self, time: float) -> float:
        """Compute how much has come in with shaft angle since a time [s], [s]."""
        if not len(self._vibration) or not len(self._shaft):
            return 0.0
        return 1e-9 * min(self._vibration.last_ns, self._shaft.last_ns) - time

    def result(self) -> chain.MonitorResult:
        """Analyse the samples so far, due or not."""
        if not len(self._vibration) or not len(self._shaft) or self.rate is None:
            return chain.MonitorResult("waiting", f"no vibration or no shaft angle yet{self._refusals()}", 0)
        time_ns, acceleration = self._vibration.joined()
        last = min(self._vibration.last_ns, self._shaft.last_ns)
        longest_ns = round(self.settings.longest_window * 1e9)
        first = max(self._vibration.first_ns, self._shaft.first_ns, last - longest_ns)
        begin, end = np.searchsorted(time_ns, (first, last + 1))
        if end - begin < 2:
            reason = f"no vibration with shaft angle yet{self._refusals()}"
            return chain.MonitorResult("waiting", reason, last)
        angle = np.interp(time_ns[begin:end], *self._shaft.joined())
        settings = self.settings
        sized = settings.window_revolutions if self.bearing is None else _SIZE_REVOLUTIONS
        most = max(settings.window_revolutions, sized)
        whole = turning_legs(angle, self.rate, settings.least_revolutions, most)
        legs = whole.latest(settings.window_revolutions)
        # what has been analysed is not analysed again while the shaft stands
        ended_ns = int(time_ns[begin + legs.last]) if legs.count else last
        self._forget(int(time_ns[begin + whole.samples.min()]) if legs.count else first)
        if not legs.count or (legs.ended and ended_ns <= self._analysed_ns):
            return chain.MonitorResult("waiting", "the shaft stands", last)
        revolutions, goes_on = legs.revolutions, legs.count == 1 and not legs.ended
        least = settings.least_revolutions if goes_on else settings.least_joined_revolutions
        if revolutions < least:
            return chain.MonitorResult(
                "waiting",
                f"{revolutions:.1f} shaft revolutions so far, {least:g} are needed",
                last,
                revolutions=revolutions,
            )
        self._analysed_ns = ended_ns
        kept = fast_length(len(legs.samples))
        received, angle = acceleration[begin + legs.samples[-kept:]], legs.angle[-kept:]
        load_time, load = self._load.joined()
        window_ns = time_ns[begin + legs.samples.min()]  # what is kept reaches further back
        load = load[(window_ns <= load_time) & (load_time <= last)]
        stretch = chain.Stretch(
            rate=self.rate,
            acceleration=received,
            shaft_angle=angle,
            load=float(load.mean()) if len(load) else np.nan,
            end_ns=last,
            temperature=self._temperatures[-1][1] if self._temperatures else np.nan,
            heating=self._heating(),
            earlier=tuple(self._levels),
        )
        result = chain.answer_of(self.algorithm, stretch, self.orders, self.roller_count, self.settings)
        result = self._at_a_speed_that_changed(result)
        if self.bearing is not None and result.verdict in chain.FAULTS:
            if self._is_size_due(result.verdict, whole, last):
                severity = _severity_of(
                    result, acceleration[begin + whole.samples], self.rate, whole.angle, self.bearing
                )
                self._sized = _Sized(result.verdict, whole.revolutions, last, severity)
            result = replace(result, severity=self._sized.severity)
        self._levels.append(Levels(result.rms, result.kurtosis, result.crest, stretch.shaft_frequency))
        del self._levels[:-_REMEMBERED]
        return result

    def _at_a_speed_that_changed(self, result: chain.MonitorResult) -> chain.MonitorResult:
        """Leave open what is healthy at a constant speed that was found to change earlier in the stream.

        It is found only while strikes are loud and their rate changes evenly; where it changes otherwise,
        or the train stands, lines are smeared and nothing says so.
        """
        if np.isfinite(result.speed_change):
            self._changed_ns = result.end_ns
        if self._changed_ns is None or result.verdict != chain.HEALTHY:
            return result
        ago = 1e-9 * (result.end_ns - self._changed_ns)
        reason = (
            f"the speed, stated as constant, was found to change {ago:.3g} s before; give a tachometer or a "
            f"speed channel; {result.reason}"
        )
        return replace(result, verdict=chain.NOT_DIAGNOSABLE, reason=reason, confidence=np.nan, grounds=None)

    def _is_size_due(self, fault: str, whole: Legs, end_ns: int) -> bool:
        """Tell whether a spall is to be measured: another one, on a longer stretch, or on a new one.

        It takes three times as long as an analysis.
        """
        sized = self._sized
        if fault != sized.fault or whole.revolutions > _LONGER * sized.revolutions:
            return True
        return not 0 <= end_ns - sized.end_ns <= _SIZED_FOR_NS

    def _refusals(self) -> str:
        """Say how many blocks were refused, empty when none was."""
        told = ""
        if self.refused:
            told = f"; {self.refused} blocks with NaN, other axes or time that does not increase were refused"
        if self.restarts:
            told += f"; the time jumped back {self.restarts} times, and the monitor began anew"
        return told

    def _heating(self) -> float:
        """Fit the rise of the temperature over the last minute, NaN with less than ten seconds, [K/s]."""
        if not self._temperatures:
            return np.nan
        end = self._temperatures[-1][0]
        while self._temperatures[0][0] < end - _HEATING_NS:
            del self._temperatures[0]
        time, temperature = np.array(self._temperatures).T
        if time[-1] - time[0] < _LEAST_HEATING_NS:
            return np.nan
        return float(np.polyfit((time - time[0]) * 1e-9, temperature, 1)[0])

    def _forget(self, before_ns: int) -> None:
        """Drop samples that no later window needs; the shaft keeps one sample before."""
        self._vibration.forget(before_ns)
        self._shaft.forget(before_ns, spared=1)
        self._load.forget(before_ns)
