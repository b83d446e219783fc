"""Every spectrum that was tried finds a fault that is clear, and none in noise."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.config import load_plate
from beardyn_core.monitor.chain import MonitorSettings, Stretch
from evidence.measured.cycbd import deconvolved, on_harmonics, strongest_near
from evidence.measured.spectra import standings

RATE, SHAFT, SECONDS = 12_000.0, 30.0, 2.0


def received(strike: float) -> Stretch:
    """Strikes at BPFO of a 6205 that ring at 3 kHz, in noise of 1 m/s²."""
    random = np.random.default_rng(1)
    time = np.arange(int(SECONDS * RATE)) / RATE
    period = 1.0 / (load_plate("6205").frequencies.bpfo * SHAFT)
    when = np.cumsum(period * random.normal(1.0, 0.005, int(SECONDS / period) - 4))
    signal = random.normal(size=len(time))
    for each in when:
        since = time[int(each * RATE) :][:100] - each
        signal[int(each * RATE) :][:100] += strike * np.exp(-since / 1e-3) * np.sin(6e3 * np.pi * since)
    return Stretch(RATE, signal[:, None], np.asarray(2.0 * np.pi * SHAFT * time), np.nan, 0)


def test_each_finds_a_clear_fault_and_none_in_noise() -> None:
    orders, settings = load_plate("6205").frequencies, MonitorSettings()
    found = {name: each.called for name, each in standings(received(6.0), orders, settings)}
    assert len(found) == 8
    assert set(found.values()) == {"cup"}
    assert {each.called for _, each in standings(received(0.0), orders, settings)} == {""}


def test_blind_deconvolution_finds_the_ringing_of_strikes_and_order_in_noise_too() -> None:
    orders, settings = load_plate("6205").frequencies, MonitorSettings()
    struck, noise = received(1.0), received(0.0)

    def share(signal: Float, stretch: Stretch) -> float:
        power = signal**2
        order = strongest_near(power, stretch, orders.bpfo, settings)
        part = on_harmonics(power, order * stretch.shaft_angle, settings.harmonics)
        return float(np.mean(part * power) / np.mean(power) ** 2)

    before, after = (
        share(signal, struck)
        for signal in (struck.acceleration[:, 0], deconvolved(struck, orders.bpfo, settings))
    )
    assert after > 3.0 * before
    spectrum = np.abs(np.fft.rfft(deconvolved(struck, orders.bpfo, settings)))
    assert abs(np.fft.rfftfreq(len(struck.shaft_angle), 1.0 / RATE)[spectrum.argmax()] - 3e3) < 500.0
    assert share(deconvolved(noise, orders.bpfo, settings), noise) > 3.0 * share(
        noise.acceleration[:, 0], noise
    )
