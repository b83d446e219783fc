"""What samples of load must be to be used: finite, in order, and such as a wheelset can have."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from beardyn_core.scene.load import LoadHistory

LARGEST_FORCE = 1.0e7
LARGEST_MOMENT = 1.0e6
LARGEST_SPEED = 2000.0
LARGEST_DISPLACEMENT = 1.0
LARGEST_SPEED_JUMP = 50.0
QUANTITIES = (
    *((name, "N") for name in ("fx", "fy", "fz")),
    *((name, "N m") for name in ("mx", "my", "mz")),
    ("shaft_speed", "rad/s"),
    *((name, "m") for name in ("ux", "uy", "uz")),
)
SPEED_JUMP_WINDOW_NS = 100_000_000


def problem_with(load: LoadHistory, after_ns: int | None) -> str | None:
    """Say why samples of load cannot follow the one of a time [ns], if any; ``None`` when they can."""
    if len(load) == 0:
        return None
    values = load.columns()
    if not np.isfinite(values).all():
        return (
            "the load has a NaN or an infinite number; all of force, moment, speed and bogie must be finite"
        )
    if np.any(np.diff(load.time_ns) <= 0) or (after_ns is not None and load.time_ns[0] <= after_ns):
        return "the load goes back in time; samples must follow each other"
    limits = np.repeat([LARGEST_FORCE, LARGEST_MOMENT, LARGEST_SPEED, LARGEST_DISPLACEMENT], [3, 3, 1, 3])
    wild = np.argwhere(np.abs(values) > limits)
    if len(wild):
        sample, column = (int(each) for each in wild[0])
        name, unit = QUANTITIES[column]
        return (
            f"the load is absurd; {name} is {values[sample, column]:.4g} {unit} at "
            f"{load.time_ns[sample] * 1e-9:g} s, allowed is up to {limits[column]:g} {unit}"
        )
    jump = speed_jump(load.time_ns, load.shaft_speed)
    return f"the load is absurd; {jump}" if jump else None


def speed_jump(time_ns: NDArray[np.int64], shaft_speed: NDArray[np.float64]) -> str | None:
    """Report a jump of the shaft speed [rad/s] that no wheelset can make; ``None`` when there is none."""
    change = np.abs(np.diff(shaft_speed))
    jumps = np.flatnonzero((change > LARGEST_SPEED_JUMP) & (np.diff(time_ns) < SPEED_JUMP_WINDOW_NS))
    if len(jumps) == 0:
        return None
    first = int(jumps[0])
    return (
        f"shaft_speed jumps from {shaft_speed[first]:g} to {shaft_speed[first + 1]:g} rad/s within "
        f"{(time_ns[first + 1] - time_ns[first]) / 1e6:g} ms; allowed is a change of up to "
        f"{LARGEST_SPEED_JUMP:g} rad/s between samples closer than {SPEED_JUMP_WINDOW_NS / 1e9:g} s"
    )
