"""Settings of the chain, and of how often it runs."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class MonitorSettings:
    """Settings of `Monitor` and of the functions of a `Chain`.

    Parameters
    ----------
    band : tuple of 2 floats
        Of the envelope where no band stands out, [Hz].
    lowest_band : float
        Bands that reach below are left to track and wheel, [Hz].
    narrowest_band : float
        Narrowest band of the kurtogram, [Hz].
    orders_in_band : float
        The spectrum of an envelope ends at the width of its band, which is at least this many times the
        shaft frequency: the last harmonics must fit, [-].
    strike_band : tuple of 2 floats
        In which strikes of the wheel are looked for, [Hz].
    window_revolutions : float
        Shaft revolutions in one analysis; 60 are some 25 of the cage, [-].
    least_revolutions : float
        Shaft revolutions before the first verdict, [-].
    longest_window : float
        The window at slow speed, [s].
    interval : float
        Time between two analyses, [s].
    samples_per_revolution : int
        Angular grid of the order tracking.
    background_width : float
        Width of the neighbourhood whose median is the background, [shaft orders].
    tolerance : float
        Of a fault frequency against geometry, [-].
    harmonics : int
        Multiples of a fault frequency that are added up, the fundamental included.
    false_alarm_rate : float
        Probability that stationary noise alone passes the threshold of an analysis, [-].
    warm, hot : float
        Temperature of the axlebox from which it is warm, and hot, [K].
    heating : float
        Rise of the temperature from which the box counts as hot, [K/s].
    heating_floor : float
        Below this temperature a rise is warming up, [K].

    Notes
    -----
    EN 15437-2 asks for levels and leaves their values to the vehicle; those here are assumed: 90 and
    120 °C, and 5 K a minute above 60 °C.
    """

    band: tuple[float, float] = (2000.0, 10_000.0)
    lowest_band: float = 1500.0
    narrowest_band: float = 1500.0
    orders_in_band: float = 60.0
    strike_band: tuple[float, float] = (1600.0, 3200.0)
    window_revolutions: float = 60.0
    least_revolutions: float = 15.0
    longest_window: float = 20.0
    interval: float = 0.5
    samples_per_revolution: int = 1024
    background_width: float = 3.0
    tolerance: float = 0.01
    harmonics: int = 5
    false_alarm_rate: float = 1e-4
    warm: float = 363.15
    hot: float = 393.15
    heating: float = 5.0 / 60.0
    heating_floor: float = 333.15
