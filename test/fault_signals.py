"""Signals of bearings with and without a fault, whose frequencies are known, and how a monitor gets them."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np
from scipy.signal import lfilter

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import frequencies
from beardyn_core.monitor.chain import MonitorResult, MonitorSettings, Stretch
from beardyn_core.monitor.streaming import Monitor

RATE = 25_600.0


ROLLERS = 17


ORDERS = frequencies(ROLLERS, 185.0, 26.7, np.deg2rad(10.5))


SETTINGS = MonitorSettings()


NOISE = 0.02 * np.sqrt(RATE / 2)  # deviation of 0.02 m/s^2/sqrt(Hz)


def fault_signal(
    fault: str | None,
    seed: int,
    duration: float = 3.0,
    speed: tuple[float, float] = (19.2, 19.2),
    noise: float = 1.0,
    slip: float = 0.0,
    coloured: bool = False,
) -> tuple[Float, Float, Float]:
    """Impulses with 1 % jitter through a 4.5 kHz resonance, modulated as the fault's load is.

    Returns time [s], shaft angle [rad], acceleration [m/s^2].
    """
    random = np.random.default_rng(seed)
    count = int(duration * RATE)
    time = np.arange(count) / RATE
    revolution = speed[0] * time + 0.5 * (speed[1] - speed[0]) * time**2 / duration
    background = random.normal(size=(count, 3))
    if coloured:
        background = lfilter([1.0], [1.0, -1.2, 0.7], background, axis=0)
        background /= background.std()  # the same power, with its peak at 3 kHz in the band
    acceleration = noise * NOISE * background
    acceleration[:, 2] += 9.8 + 5.0 * np.sin(2 * np.pi * revolution)
    if fault:
        order = {"cup": ORDERS.bpfo, "cone": ORDERS.bpfi, "roller": 2 * ORDERS.bsf}[fault] * (1 + slip)
        number = np.arange(1, int(revolution[-1] * order))
        place = (number + random.normal(0.0, 0.01, len(number))) / order
        strength = random.uniform(0.8, 1.2, len(number))
        if fault == "cone":  # through the load zone once a revolution
            strength *= np.maximum(0.0, np.cos(2 * np.pi * place + 1.0))
        if fault == "roller":  # with the cage, and weaker on the cone
            strength *= np.maximum(0.0, np.cos(2 * np.pi * ORDERS.ftf * place + 1.0))
            strength *= np.where(number % 2, 1.0, 0.7)
        impulses = np.zeros(count)
        at = (np.interp(place, revolution, time) * RATE).astype(int)
        np.add.at(impulses, np.clip(at, 0, count - 1), strength)
        decay = np.arange(400) / RATE
        ringing = np.exp(-1500 * decay) * np.sin(2 * np.pi * 4500 * decay)
        acceleration += 20.0 * np.convolve(impulses, ringing)[:count, None] * [0.4, 0.2, 1.0]
    return time, 2 * np.pi * revolution, acceleration


def feed_monitor(
    monitor: Monitor, signal: tuple[Float, Float, Float], block: int = 512, skip: Collection[int] = ()
) -> list[MonitorResult]:
    """Stream a signal block by block, tachometer at 400 Hz with wrapped angle; all results."""
    time, angle, acceleration = signal
    time_ns = np.round(time * 1e9).astype(np.int64)
    results = []
    for number, start in enumerate(range(0, len(time), block)):
        part = slice(start, start + block)
        if number not in skip:
            monitor.push_vibration(time_ns[part], acceleration[part])
        tach = slice(start + (-start) % 64, start + block, 64)
        monitor.push_shaft(time_ns[tach], np.angle(np.exp(1j * angle[tach])))
        monitor.push_load(time_ns[tach], np.full(len(time_ns[tach]), 8e4))
        results.append(monitor.update())
    return [result for result in results if result is not None]


def fault_stretch(fault: str | None, seed: int, **situation: Any) -> Stretch:
    """A stretch of a signal, as a step of the chain gets it."""
    _, angle, acceleration = fault_signal(fault, seed, **situation)
    return Stretch(RATE, acceleration, angle, 8e4, 0)
