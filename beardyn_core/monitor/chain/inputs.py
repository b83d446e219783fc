"""What a monitoring algorithm gets: a stretch of signal, with shaft, load and temperature; its settings."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray
from scipy.fft import rfft

from beardyn_core.base.arrays import Bool, Float
from beardyn_core.base.errors import InputError
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain.levels import Levels
from beardyn_core.monitor.features import analytic_part, real_part, squared_magnitude


@dataclass(frozen=True)
class Stretch:
    """A stretch of signal to analyse."""

    rate: A[float, "[Hz]"]
    acceleration: A[Float, "shape [sample, axis], [m/s^2]"]
    shaft_angle: A[Float, "shape [sample], increasing, [rad]"]
    load: A[float, "mean vertical load, NaN when unknown, [N]"]
    end_ns: A[int, "time of the last sample, [ns]"]
    temperature: A[float, "of the axlebox at the end, NaN when unknown, [K]"] = np.nan
    heating: A[float, "rise of that temperature, NaN when unknown, [K/s]"] = np.nan
    earlier: A[tuple[Levels, ...], "of the stretches before, the oldest first"] = ()

    def __post_init__(self) -> None:
        if self.acceleration.ndim == 1:  # it would be multiplied with itself instead of sample by sample
            object.__setattr__(self, "acceleration", self.acceleration[:, None])

    @property
    def revolutions(self) -> float:
        """Revolutions of the shaft, [-]."""
        return float(self.shaft_angle[-1] - self.shaft_angle[0]) / (2.0 * np.pi)

    @property
    def shaft_frequency(self) -> float:
        """Mean frequency of the shaft, [Hz]."""
        return self.revolutions * self.rate / (len(self.shaft_angle) - 1)

    @cached_property
    def ramp(self) -> Float:
        """Weight of each sample: 0 at both ends, 1 from half a revolution on, shape [sample].

        A Fourier transform joins the last sample to the first. Cut off in a strike of the wheel they differ
        by a hundred times what a bearing does, and the step between them would be the loudest knock of all.
        """
        turned = np.abs(self.shaft_angle - self.shaft_angle[[0, -1]][:, None])
        return np.asarray(np.sin(0.5 * np.minimum(turned.min(axis=0), np.pi)) ** 2, np.float64)

    @property
    def inner(self) -> slice:
        """Samples between the ramps."""
        first, last = np.searchsorted(self.shaft_angle, self.shaft_angle[[0, -1]] + [np.pi, -np.pi])
        return slice(int(first), int(last))

    def at_speed(self, ratio: float) -> Stretch:
        """Give the same vibration with a shaft that turns faster by a ratio; envelopes are shared."""
        other = replace(self, shaft_angle=ratio * self.shaft_angle)
        other.__dict__.update(spectrum=self.spectrum, _envelopes=self._envelopes)
        return other

    @cached_property
    def spectrum(self) -> NDArray[np.complex128]:
        """``rfft`` of the acceleration between ramps, shape [line, axis], which every band is cut out of."""
        return np.asarray(rfft(self.acceleration * self.ramp[:, None], axis=0), np.complex128)

    @cached_property
    def _envelopes(self) -> dict[tuple[float, float], Float]:
        return {}

    @cached_property
    def struck(self) -> dict[tuple[tuple[float, float], ...], Bool]:
        """Sectors found by `chain.wheel.struck_sectors` so far, by the bands of their settings."""
        return {}

    def squared_envelope(self, band: tuple[float, float]) -> Float:
        """Compute the squared envelope of a band, summed over the axes, shape [sample], [m^2/s^4]."""
        if band not in self._envelopes:
            analytic = analytic_part(self.spectrum, len(self.acceleration), self.rate, band)
            self._envelopes[band] = squared_magnitude(analytic)
        return self._envelopes[band]

    def in_band(self, band: tuple[float, float]) -> Float:
        """Compute the acceleration in a band, shape [sample, axis], [m/s^2]."""
        return real_part(self.spectrum, len(self.acceleration), self.rate, band)


@dataclass(frozen=True)
class MonitorSettings:
    """Settings of `Monitor` and of the functions of a `Chain`.

    Notes
    -----
    A healthy bearing has lines of its own: of rollers that enter the load zone, and of waves that the same
    surfaces pass again and again, so that the power of a random pattern comes back. With a quiet sensor they
    are no chance, and no fault. They are smooth: one harmonic holds most of them. What is called must strike:
    beyond its loudest harmonic, others must hold `least_strikes` of the mean power. Of measured analyses that
    name a fault right 99 % have more than 0.33; no surely present line of a healthy bearing, measured next to
    a faulty one or simulated, had more than 0.27 (docs/evidence/monitor_measured.md). Where a loud tone or
    the track fills the band, `least_sharpest` in one octave does; there healthy ones had up to 0.7 at BPFO,
    with which their rollers pass, and 0.4 at the lines of cone and roller. Its level does not count.

    Rollers slip, so that lines lie 1 to 2 % next to the orders of the bearing data (Randall, Antoni 2011,
    section 2.2); a roller that spins on through the unloaded side in settled grease does so here, by 1.8 %
    in `service_metro_roller`.

    EN 15437-2 asks for levels and leaves their values to the vehicle; those here are assumed: 90 and
    120 °C, and 5 K a minute above 60 °C. Healthy boxes with settled grease are silent up to 300 km/h in air
    of 40 °C (freshly greased ones are warm then), and overgreased, preloaded and starved ones are at least
    warm there (docs/evidence/heat.md).
    """

    band: A[tuple[float, float], "of the envelope where no band stands out, [Hz]"] = (2000.0, 10_000.0)
    whole_band: A[
        tuple[float, float], "of the envelope where the signal is whitened, as far as it is usable, [Hz]"
    ] = (500.0, 12_000.0)
    usable_share: A[float, "of the sampling rate, up to where anti-alias filters let pass, [-]"] = 0.45
    lowest_band: A[float, "bands that reach below are left to track and wheel, [Hz]"] = 1500.0
    narrowest_band: A[float, "narrowest band of the kurtogram, [Hz]"] = 1500.0
    orders_in_band: A[
        float,
        "the spectrum of an envelope ends at the width of its band, which is at least this many times the "
        "shaft frequency: the last harmonics must fit, [-]",
    ] = 60.0
    strike_bands: A[
        tuple[tuple[float, float], ...],
        "where strikes of the wheel are sought, each by itself, as far as the signal reaches, [Hz]",
    ] = ((1600.0, 3200.0), (3200.0, 6400.0), (6400.0, 12_800.0))
    window_revolutions: A[float, "shaft revolutions in one analysis; 60 are some 25 of the cage, [-]"] = 60.0
    least_revolutions: A[float, "shaft revolutions before the first verdict, [-]"] = 15.0
    least_joined_revolutions: A[
        float, "and where the shaft has stopped or turned round, so that no longer stretch comes, [-]"
    ] = 6.0
    longest_window: A[float, "the window at slow speed, [s]"] = 20.0
    interval: A[float, "time between two analyses, [s]"] = 0.5
    samples_per_revolution: A[int, "angular grid of the order tracking"] = 1024
    background_width: A[float, "of the neighbourhood whose median is the background, [shaft orders]"] = 3.0
    tolerance: A[float, "of a fault frequency against bearing data, for rollers slip by 1 to 2 %, [-]"] = 0.02
    speed_uncertainty: A[
        float, "of the stated speed, 0 where a tachometer counts the revolutions; searched over, [-]"
    ] = 0.0
    speed_doubt: A[
        float,
        "error of the speed up to which a comb that fits nothing at the stated speed is compared with the "
        "parts of the bearing: a wheel worn from 920 to 850 mm, [-]",
    ] = 0.08
    neighbours: A[
        tuple[FaultFrequencies, ...], "other bearings on the same shaft, whose combs are explained by them"
    ] = ()
    harmonics: A[int, "multiples of a fault frequency that are added up, the fundamental included"] = 5
    false_alarm_rate: A[float, "probability that noise alone passes the threshold of an analysis, [-]"] = 1e-4
    strike_harmonics: A[int, "multiples of a fault frequency by which strikes differ from a hum"] = 8
    least_strikes: A[float, "what those but the loudest must make of the mean power for a fault, [-]"] = 0.3
    least_sharpest: A[
        tuple[float, float, float], "or what they must make in one of `strike_bands`: cup, cone, roller, [-]"
    ] = (1.0, 0.5, 0.5)
    faint_margin: A[float, "score over the threshold from which a fault may strike less than that, [dB]"] = (
        0.5
    )
    faint_rival: A[float, "then nothing else may have more evidence than this share of its own, [-]"] = 0.3
    faint_sidebands: A[
        float, "and sidebands must make its evidence so many times that without them: cone and roller, [-]"
    ] = 1.3
    faint_sharpest: A[
        tuple[float, float],
        "and strikes so much in one of `strike_bands`: cup and turns of the cage, cone and roller, [-]",
    ] = (0.45, 0.25)
    foreign_strikes: A[
        float,
        "and what those of a comb that no part explains at any speed must make, for it may come from a "
        "bearing next to this one, [-]",
    ] = 1.0
    foreign_sharpest: A[float, "or what they must make in one of `strike_bands`, [-]"] = 1.5
    clockwork_depth: A[
        float, "line over the mean power from which the signal is judged as measured, too, [-]"
    ] = 0.25
    clockwork_strikes: A[float, "in place of `least_strikes` there, [-]"] = 1.0
    warm: A[float, "temperature of the axlebox from which it is warm, [K]"] = 363.15
    hot: A[float, "and from which it is hot, [K]"] = 393.15
    heating: A[float, "rise of the temperature from which the box counts as hot, [K/s]"] = 5.0 / 60.0
    heating_floor: A[float, "below this temperature a rise is warming up, [K]"] = 333.15

    def __post_init__(self) -> None:
        if self.warm > self.hot:
            raise InputError(
                f"warm is {self.warm - ZERO_CELSIUS:g} degrees Celsius; it must be at most hot, which is "
                f"{self.hot - ZERO_CELSIUS:g}"
            )
