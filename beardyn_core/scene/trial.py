"""A trial: the matrix of runs that a monitor is put to."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from math import pi
from pathlib import Path

HEALTHY = "none"
FAULTS = ("cup", "cone", "roller")


@dataclass(frozen=True)
class TrialWheel:
    """A wheel of the matrix.

    Parameters
    ----------
    name : str
    defects : tuple of dict
        As in a scene file under ``operation.wheel_defects``.
    """

    name: str
    defects: tuple[dict[str, object], ...] = ()


@dataclass(frozen=True)
class Spall:
    """How the spall of a size looks.

    Parameters
    ----------
    length_per_width, depth_per_width : float
        [-].
    deepest : float
        [m].
    """

    length_per_width: float
    depth_per_width: float
    deepest: float

    def depth(self, width: float) -> float:
        """Of a spall of a width, [m]."""
        return min(self.depth_per_width * width, self.deepest)


@dataclass(frozen=True)
class Cell:
    """One run of a trial.

    Parameters
    ----------
    fault : str
        ``none``, or the part that is spalled.
    size : float
        Width of the spall, 0 without, [m].
    speed : float
        Of the train, [m/s].
    track, wheel : str
    repeat : int
        Which of the runs that differ by their seed alone.
    tier : str
    checks : bool
        Whether it repeats a run of the matrix in the tier of the check.
    """

    fault: str
    size: float
    speed: float
    track: str
    wheel: str
    repeat: int
    tier: str
    checks: bool = False

    @property
    def conditions(self) -> str:
        """What the run is, without its tier."""
        return (
            f"{self.fault} {1e3 * self.size:g} mm, {3.6 * self.speed:g} km/h, {self.track}, {self.wheel}, "
            f"run {self.repeat}"
        )

    @property
    def key(self) -> str:
        """Name of the run in the folder of results."""
        return f"{self.conditions}, {self.tier}"

    def seed(self, trial_seed: int) -> int:
        """Of track, noise and place of the spall: the same in every tier and order of the matrix."""
        return zlib.crc32(f"{self.conditions}, {trial_seed}".encode())


@dataclass(frozen=True)
class Trial:
    """A matrix of scenes.

    Parameters
    ----------
    name, purpose : str
    scene : str
        What every run starts from, a shipped name or a file.
    folder : Path
        Of the trial's own file, where a scene file is looked for first.
    tier : str
    effects : str or dict or None
        As in a scene file; ``None``: the scene's.
    faults : tuple of str
    sizes : tuple of floats
        Widths of the spalls, [m].
    spall : Spall
    speeds : tuple of floats
        Of the train, [m/s].
    tracks : tuple of str
        Kinds of irregularity.
    wheels : tuple of TrialWheel
    repeats, healthy_repeats : int
        Runs of every combination with and without a fault.
    revolutions : float
        Shaft revolutions of a run, [-].
    interval : float
        Time between two analyses, [s].
    seed : int
    check_tier : str or None
        In which some runs are repeated.
    check_every : int
        Every how manieth run is.
    """

    name: str
    purpose: str
    scene: str
    folder: Path
    tier: str
    effects: object
    faults: tuple[str, ...]
    sizes: tuple[float, ...]
    spall: Spall
    speeds: tuple[float, ...]
    tracks: tuple[str, ...]
    wheels: tuple[TrialWheel, ...]
    repeats: int
    healthy_repeats: int
    revolutions: float
    interval: float
    seed: int
    check_tier: str | None = None
    check_every: int = 1

    def wheel(self, name: str) -> TrialWheel:
        """Wheel of a name."""
        return next(wheel for wheel in self.wheels if wheel.name == name)

    def duration(self, speed: float, wheel_diameter: float) -> float:
        """Of a run at a speed [m/s] on a wheel [m], [s]."""
        return self.revolutions * pi * wheel_diameter / speed

    def cells(self) -> tuple[Cell, ...]:
        """All runs, those of the check last."""
        own = tuple(self._matrix())
        if self.check_tier is None:
            return own
        # an odd stride walks through speeds, tracks and wheels
        checked = (cell for place, cell in enumerate(own) if place % self.check_every == 0)
        return (*own, *(_again(cell, self.check_tier) for cell in checked))

    def _matrix(self) -> Iterator[Cell]:
        loads = [(HEALTHY, 0.0, self.healthy_repeats)]
        loads += [(fault, size, self.repeats) for fault in self.faults for size in self.sizes]
        for fault, size, repeats in loads:
            for repeat in range(repeats):
                for speed in self.speeds:
                    for track in self.tracks:
                        for wheel in self.wheels:
                            yield Cell(fault, size, speed, track, wheel.name, repeat, self.tier)


def _again(cell: Cell, tier: str) -> Cell:
    return Cell(cell.fault, cell.size, cell.speed, cell.track, cell.wheel, cell.repeat, tier, checks=True)
