"""The rail under the wheel: standing waves of a long beam on two layers of seats."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.scene.operation import Track

# waves per metre of rail: the shortest is 0.38 m long, about 5 kHz
_WAVES_PER_METRE = 8.0 / 3.0
_SHORTEST_STRETCH, _LONGEST_STRETCH = 18.0, 60.0
# how far a wave must have died away, as exp(-x), before it comes round the stretch
_DECAY = 3.0
_TAIL = 4000


@dataclass(frozen=True)
class RailWaves:
    """Cosine waves of a stretch of rail, sleepers and ballast that closes upon itself.

    Wave n has the wavenumber 2 pi n / length. Each is a chain rail - pad - sleeper - ballast - subgrade
    of its own; the rail under the wheel moves by their sum, and by the residue.
    """

    length: A[float, "of the stretch, [m]"]
    mass: A[Float, "shape [3], rail, sleepers, ballast, [kg/m]"]
    stiffness: A[Float, "shape [wave], of the rail's own bending and shear, [N/m^2]"]
    seats: A[Float, "shape [3], pads, ballast, subgrade, [N/m^2]"]
    seat_damping: A[Float, "shape [3], [N s/m^2]"]
    share: A[Float, "shape [wave], length of rail that moves with the amplitude of the wave, [m]"]
    residual_flexibility: A[float, "of all shorter waves together, [m/N]"]
    residual_time: A[float, "with which they give way, [s]"]

    @property
    def inverse_mass(self) -> Float:
        """Acceleration of each wave's rail under a unit force of the wheel, shape [wave], [1/kg]."""
        return np.asarray(1.0 / (self.mass[0] * self.share))

    @property
    def point_stiffness(self) -> float:
        """Static stiffness under the wheel, [N/m]."""
        below = 1.0 / np.sum(1.0 / self.seats)
        waves = np.sum(1.0 / (self.share * (self.stiffness + below)))
        return 1.0 / float(waves + self.residual_flexibility)

    def receptance(self, frequency: float) -> complex:
        """Compute how far the rail under the wheel goes with an oscillating force, [m/N], at [Hz]."""
        turn = 2j * np.pi * frequency
        give = self.residual_flexibility / (1.0 + turn * self.residual_time)
        waves = np.linalg.inv(turn * np.eye(6) - self.rates())[:, 0, 3]
        return complex(give + np.sum(self.inverse_mass * waves))

    def rates(self) -> Float:
        """Build the state matrices of the waves, displacements before speeds, shape [wave, 6, 6]."""
        stiffness = _chain(self.seats)[None] + np.zeros((len(self.share), 3, 3))
        stiffness[:, 0, 0] += self.stiffness
        rates = np.zeros((len(self.share), 6, 6))
        rates[:, :3, 3:] = np.eye(3)
        rates[:, 3:, :3] = -stiffness / self.mass[:, None]
        rates[:, 3:, 3:] = -_chain(self.seat_damping) / self.mass[:, None]
        return rates


def rail_waves(track: Track) -> RailWaves:
    """Build the waves of a rail on its track.

    The rail bends and shears; its rotary inertia is neglected (3 % of the receptance at 3 kHz). The
    seats are spread along the rail: the pinned-pinned mode between sleepers, near 1 kHz, and the passing
    of sleepers are absent. The waves stand under the wheel and so move along with it, which neglects that
    a load runs towards its own waves.

    The stretch is so long that a wave has died away before it comes round: a beam without end. Waves too
    short for it answer at once for all the wheel does; what they add to the static flexibility gives
    way with the time constant that makes the impedance that of a shear wave, 2 sqrt(G A m), when they are
    counted in.

    References
    ----------
    Zhai (2020), Vehicle-Track Coupled Dynamics, chapter 2: rail modes and the three layers. Knothe,
    Grassie (1993), Modelling of railway track and vehicle/track interaction at high frequencies,
    Vehicle System Dynamics 22: shear of the rail.
    """
    spacing, bending, shear = track.sleeper_spacing, track.rail_bending_stiffness, track.rail_shear_stiffness
    rail = track.rail_mass_per_length
    fastest = np.sqrt(shear / rail)
    decay = track.pad_damping / (2.0 * rail * spacing)
    length = float(np.clip(_DECAY * fastest / decay, _SHORTEST_STRETCH, _LONGEST_STRETCH))
    count = int(np.ceil(_WAVES_PER_METRE * length))
    share = np.full(count, 0.5 * length)
    share[0] = length

    def own(wave: NDArray[np.int64]) -> Float:
        square = np.asarray((2.0 * np.pi / length * wave) ** 2, dtype=np.float64)
        return square**2 * bending / (1.0 + square * bending / shear)

    # the tail beyond the waves summed here is that of shear alone
    residue = 2.0 / length * float(np.sum(1.0 / own(np.arange(count, count + _TAIL))))
    residue += length / (2.0 * np.pi**2 * shear * (count + _TAIL))
    return RailWaves(
        length=length,
        mass=np.array([rail, track.sleeper_mass / spacing, track.ballast_mass / spacing]),
        stiffness=own(np.arange(count)),
        seats=np.array([track.pad_stiffness, track.ballast_stiffness, track.subgrade_stiffness]) / spacing,
        seat_damping=np.array([track.pad_damping, track.ballast_damping, track.subgrade_damping]) / spacing,
        share=share,
        residual_flexibility=residue,
        residual_time=residue * 2.0 * float(np.sqrt(shear * rail)),
    )


def _chain(link: Float) -> Float:
    """Build the matrix of three masses on three links, the last one to the ground."""
    upper, middle, lower = link
    return np.array([[upper, -upper, 0.0], [-upper, upper + middle, -middle], [0.0, -middle, middle + lower]])
