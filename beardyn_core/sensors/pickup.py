"""Electrical pickup: what the inverter induces in the cables of the sensors."""

from __future__ import annotations

from math import pi

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.scene.background import Pickup

_STREAM = 0x7069636B


class PickupStream:
    """Voltage in the cable of one sensor, which goes on from block to block.

    Side bands whose frequency is not below 0.4 of the rate are held back by the anti-alias filter. Cutting
    the stream into other blocks gives the same bits.

    Parameters
    ----------
    rate : float
        Of the sensor, [Hz].
    seed, number : int
        Of the scene; which sensor.
    """

    def __init__(self, pickup: Pickup, rate: float, seed: int, number: int) -> None:
        self._pickup, self._rate = pickup, rate
        random = np.random.Generator(np.random.PCG64(np.random.SeedSequence([_STREAM, seed, number])))
        self._phases = random.uniform(0.0, 2.0 * pi, (len(pickup.lines), 2))
        self._angle = 0.0
        self._sample = 0

    def push(self, shaft_speed: Float) -> Float:
        """Compute the voltage at samples where the shaft has a speed [rad/s], shape [sample], [V]."""
        step = shaft_speed * (self._pickup.electrical_order / self._rate)
        angle = np.cumsum(np.concatenate(([self._angle], step)))
        self._angle = float(angle[-1])
        turns = self._pickup.switching / self._rate * (self._sample + np.arange(len(step)))
        self._sample += len(step)
        voltage = np.zeros(len(step))
        for line, phases in zip(self._pickup.lines, self._phases, strict=True):
            carrier = 2.0 * pi * ((line.carrier * turns) % 1.0)
            for side, phase in zip((-line.side, line.side), phases, strict=True):
                per_sample = line.carrier * 2.0 * pi * self._pickup.switching / self._rate + side * step
                received = np.abs(per_sample) < 0.8 * pi
                voltage += np.where(
                    received, line.amplitude * np.cos(carrier + side * angle[:-1] + phase), 0.0
                )
        return voltage
