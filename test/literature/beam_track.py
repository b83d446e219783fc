"""A rail of finite elements on a long track, with a wheel on its Hertz spring: slow and plain, for tests."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix
from scipy.sparse.linalg import splu

from beardyn_core.scene.operation import Track

ELEMENT = 0.1
HALF_LENGTH = 15.0
DENSITY, YOUNG = 7850.0, 2.059e11


class BeamTrack:
    """Timoshenko beam of two-node elements (shear sampled in their middle), rotary inertia included.

    Seats, sleepers and ballast stand at every sleeper, or are spread over all nodes; the wheel stands in
    the middle, between two sleepers or over one. Newmark's average acceleration.
    """

    def __init__(self, track: Track, step: float, seats: str = "spread") -> None:
        nodes = round(2 * HALF_LENGTH / ELEMENT) + 1
        self.middle = nodes // 2
        apart = round(track.sleeper_spacing / ELEMENT)
        if seats == "spread":
            at, part = np.arange(nodes), ELEMENT / track.sleeper_spacing
        else:
            shift = apart // 2 if seats == "between" else 0
            at, part = np.arange((self.middle + shift) % apart, nodes, apart), 1.0
        size = 2 * nodes + 2 * len(at)
        entries: dict[str, list[tuple[int, int, float]]] = {"mass": [], "damping": [], "stiffness": []}

        def add(kind: str, places: list[int], matrix: np.ndarray) -> None:
            for i, row in enumerate(places):
                for j, column in enumerate(places):
                    entries[kind].append((row, column, float(matrix[i, j])))

        def link(upper: int, lower: int | None, spring: float, damper: float) -> None:
            places = [upper] if lower is None else [upper, lower]
            pull = np.array([1.0, -1.0][: len(places)])
            add("stiffness", places, spring * np.outer(pull, pull))
            add("damping", places, damper * np.outer(pull, pull))

        inertia = DENSITY * track.rail_bending_stiffness / YOUNG
        bend = np.array([0.0, -1.0, 0.0, 1.0]) / ELEMENT
        shear = np.array([-1.0 / ELEMENT, -0.5, 1.0 / ELEMENT, -0.5])
        for node in range(nodes - 1):
            places = [2 * node, 2 * node + 1, 2 * node + 2, 2 * node + 3]
            stiffness = track.rail_bending_stiffness * np.outer(bend, bend)
            stiffness += track.rail_shear_stiffness * np.outer(shear, shear)
            add("stiffness", places, ELEMENT * stiffness)
            add("mass", places, 0.5 * ELEMENT * np.diag([track.rail_mass_per_length, inertia] * 2))
        for k, seat in enumerate(int(place) for place in at):
            sleeper, ballast = 2 * nodes + 2 * k, 2 * nodes + 2 * k + 1
            link(2 * seat, sleeper, part * track.pad_stiffness, part * track.pad_damping)
            link(sleeper, ballast, part * track.ballast_stiffness, part * track.ballast_damping)
            link(ballast, None, part * track.subgrade_stiffness, part * track.subgrade_damping)
            add("mass", [sleeper], np.array([[part * track.sleeper_mass]]))
            add("mass", [ballast], np.array([[part * track.ballast_mass]]))
        self.mass, self.damping, self.stiffness = (
            csc_matrix(coo_matrix(tuple_of(entries[kind]), shape=(size, size)))
            for kind in ("mass", "damping", "stiffness")
        )
        self.step = step
        self.solve = splu(
            csc_matrix(self.mass + 0.5 * step * self.damping + 0.25 * step**2 * self.stiffness)
        ).solve
        self.place, self.speed = np.zeros(size), np.zeros(size)

    def sink(self, force: float) -> float:
        """Rail under the wheel after one more step with a downward force, upwards, [m]."""
        step, half = self.step, 0.5 * self.step
        load = -(self.damping @ self.speed) - self.stiffness @ (self.place + half * self.speed)
        load[2 * self.middle] -= force
        change = step * self.solve(load)
        self.place += step * (self.speed + 0.5 * change)
        self.speed += change
        return float(self.place[2 * self.middle])

    @property
    def point_stiffness(self) -> float:
        """Static, [N/m]."""
        load = np.zeros(len(self.place))
        load[2 * self.middle] = 1.0
        return 1.0 / float(splu(self.stiffness).solve(load)[2 * self.middle])


def tuple_of(entries: list[tuple[int, int, float]]) -> tuple[list[float], tuple[list[int], list[int]]]:
    rows, columns, values = zip(*entries, strict=True)
    return list(values), (list(rows), list(columns))


def wheel_on_beam(
    beam: BeamTrack, height: np.ndarray, mass: float, static_force: float, flexibility: float
) -> np.ndarray:
    """Contact force of a wheel that carries the static force, over a profile, [N]."""
    force = np.zeros(len(height))
    wheel = speed = rail = 0.0
    at_rest = flexibility * static_force ** (2 / 3)
    for n in range(len(height)):
        compression = max(at_rest + height[n] + rail - wheel, 0.0)
        force[n] = (compression / flexibility) ** 1.5
        speed += beam.step * (force[n] - static_force) / mass
        wheel += beam.step * speed
        rail = beam.sink(force[n] - static_force)
    return force
