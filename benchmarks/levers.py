"""What the levers on speed give and cost: the time step, and where along the roller the laminae lie.

``python benchmarks/levers.py steps`` runs one steady load with every number of steps per sample, all of them
block by block in turn, and compares them with the finest: time, torque, chatter, third octaves.
``python benchmarks/levers.py laminae`` compares uniform laminae with Gauss-Legendre ones on one roller, at
constant approach and at constant load: load, moment of a tilt, tilt stiffness. Run on an idle machine.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.profile import Profile
from beardyn_core.choice import load_scene
from beardyn_core.config import load_bearing, load_effects
from beardyn_core.physics.bodies.layout import SIGNAL_TORQUE
from beardyn_core.physics.tiers.status import chatter_index
from beardyn_core.run import start
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.study.measures import NOMINAL_BANDS, third_octave_levels
from beardyn_core.twin import Twin

Float = NDArray[np.float64]
THIRDS = NOMINAL_BANDS[-9:]
SETTLING = 15


class Run:
    """One number of steps per sample: blocks in turn with the others."""

    def __init__(self, effects: str, load: float, speed: float, steps: int, blocks: int) -> None:
        scene = load_scene("static_80kN", effects="standard")
        scene = replace(
            scene,
            effects=load_effects(effects),
            operation=ConstantOperation(force=(0.0, 0.0, load), speed=speed),
            mounting=Mounting(),
            sensors=tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors),
            numerics=replace(scene.numerics, steps_per_sample=steps),
        )
        self.steps = steps
        self.twin = start(scene, blocks * Twin.block_ns * 1e-9).twin
        self.wall: list[float] = []
        self.torque: list[Float] = []
        self.vibration: list[Float] = []
        self.chatter: list[float] = []

    def advance(self) -> None:
        """Advance by one block."""
        began = time.perf_counter()
        block = self.twin.advance()
        self.wall.append(time.perf_counter() - began)
        signals = self.twin._signals
        self.torque.append(signals[:, SIGNAL_TORQUE].copy())
        self.vibration.append(block.acceleration[0, :, 2])
        assert self.twin._state is not None
        self.chatter.append(float(chatter_index(self.twin._state, len(signals)).max()))

    def row(self, finest: Run) -> dict[str, Any]:
        """Compute the ratio of times, and differences from the finest."""
        torque, reference = (np.concatenate(run.torque[SETTLING:]) for run in (self, finest))
        levels, wanted = (third_octaves(np.concatenate(run.vibration[SETTLING:])) for run in (self, finest))
        pairs = zip(self.wall[SETTLING:], finest.wall[SETTLING:], strict=True)
        return {
            "steps_per_sample": self.steps,
            "real_time_factor": 0.02 / statistics.median(self.wall[SETTLING:]),
            "time_ratio": statistics.median(a / b for a, b in pairs),
            "torque_percent": 100.0 * float(torque.mean() / reference.mean() - 1.0),
            "scatter_ratio": float(torque.std() / reference.std()),
            "chatter": max(self.chatter[SETTLING:]),
            "third_octaves_dB": [round(float(d), 1) for d in levels - wanted],
        }


def third_octaves(signal: Float) -> Float:
    """Compute levels of the bands of `THIRDS`, [dB]."""
    return third_octave_levels(signal[:, None])[-len(THIRDS) :]


def steps(arguments: argparse.Namespace) -> list[dict[str, Any]]:
    """Compare every number of steps per sample against the finest."""
    blocks = SETTLING + round(arguments.duration / 0.02)
    counts = sorted(set(arguments.steps))
    runs = [Run(arguments.effects, 1e3 * arguments.load, arguments.speed, count, blocks) for count in counts]
    for turn in range(blocks):
        for run in runs if turn % 2 else reversed(runs):
            run.advance()
    rows = [run.row(runs[-1]) for run in runs]
    print(
        f"{arguments.effects}, {arguments.load:g} kN, {arguments.speed:g} rad/s, against {counts[-1]} steps"
    )
    print("third octaves: " + " ".join(f"{c / 1e3:.3g}" for c in THIRDS) + " kHz")
    print(f"{'steps':>5}{'RTF':>7}{'time':>7}{'torque %':>10}{'scatter':>9}{'chatter':>9}  third octaves, dB")
    for row in rows:
        print(
            f"{row['steps_per_sample']:>5}{row['real_time_factor']:>7.2f}{row['time_ratio']:>7.3f}"
            f"{row['torque_percent']:>10.2f}{row['scatter_ratio']:>9.2f}{row['chatter']:>9.3f}  "
            + " ".join(f"{d:+.1f}" for d in row["third_octaves_dB"])
        )
    return rows


PROFILES = {
    "straight": Profile(),
    "crowned": Profile("crowned", drop=1.0e-5),
    "lundberg": Profile("lundberg", design_pressure=1.0e9),
    "iso_16281": Profile("iso_16281", design_pressure=1.0e9),
}
LINE_LOAD, TILT, TILT_STEP, FINE = 1.0e4, 2.0e-4, 2.0e-6, 2000


class Line:
    """One roller pressed on a plane, its laminae at given places with given shares of the length."""

    def __init__(self, bearing: Bearing, place: Float, share: Float, drop: Float) -> None:
        self.place, self.drop = place, drop
        self.factor = share * line_contact_factor(bearing.material, bearing.effective_length)

    def load_and_moment(self, approach: float, tilt: float) -> tuple[float, float]:
        """Compute load, [N], and moment about mid-length, [N m], at an approach and a tilt."""
        load = self.factor * np.maximum(approach + tilt * self.place - self.drop, 0.0) ** (10.0 / 9.0)
        return float(load.sum()), float((load * self.place).sum())

    def approach(self, load: float, tilt: float) -> float:
        """Approach under a load, [m]."""
        return float(brentq(lambda d: self.load_and_moment(d, tilt)[0] - load, -1e-4, 1e-3, xtol=1e-16))

    def moment(self, load: float, tilt: float) -> float:
        """Compute the moment of a tilt at constant load, [N m]."""
        return self.load_and_moment(self.approach(load, tilt), tilt)[1]

    def measures(self) -> Float:
        """Compute load at a set approach; approach, moment of a tilt and tilt stiffness at a set load."""
        stiffness = (self.moment(LINE_LOAD, TILT_STEP) - self.moment(LINE_LOAD, -TILT_STEP)) / (2 * TILT_STEP)
        load = self.load_and_moment(2.0e-5, 0.0)[0]
        return np.array([load, self.approach(LINE_LOAD, 0.0), self.moment(LINE_LOAD, TILT), stiffness])


def uniform(bearing: Bearing, profile: Profile, count: int) -> Line:
    """Cut equal laminae, each with the mean drop over its length."""
    length = bearing.effective_length
    place = ((np.arange(count) + 0.5) / count - 0.5) * length
    drop = profile.lamina_drop(count, length, bearing.roller_diameter, bearing.material.contact_modulus)
    return Line(bearing, place, np.full(count, 1.0 / count), drop)


def gauss(bearing: Bearing, profile: Profile, count: int) -> Line:
    """Compute Gauss-Legendre points with their weights, the drop taken at the point."""
    node, weight = np.polynomial.legendre.leggauss(count)
    half = 0.5 * bearing.effective_length
    drop = profile.drop_at(half * node, half, bearing.roller_diameter, bearing.material.contact_modulus)
    return Line(bearing, half * node, 0.5 * weight, drop)


def laminae(arguments: argparse.Namespace) -> list[dict[str, Any]]:
    """Compute errors in percent of uniform and of Gauss laminae."""
    bearing = load_bearing(arguments.bearing)
    rows = []
    print(f"{arguments.bearing}, {LINE_LOAD / 1e3:g} kN on a roller; errors in % against {FINE} laminae")
    print(
        f"{'profile':12}{'rule':9}{'count':>6}{'load':>9}{'approach':>10}{'moment':>9}{'tilt stiffness':>16}"
    )
    for name, profile in PROFILES.items():
        exact = uniform(bearing, profile, FINE).measures()
        for rule in (uniform, gauss):
            for count in arguments.counts:
                error = 100.0 * (rule(bearing, profile, count).measures() / exact - 1.0)
                rows.append(
                    {"profile": name, "rule": rule.__name__, "count": count, "errors": error.tolist()}
                )
                print(
                    f"{name:12}{rule.__name__:9}{count:>6}{error[0]:>9.3f}{error[1]:>10.3f}{error[2]:>9.3f}"
                    f"{error[3]:>11.3f}"
                )
    return rows


def main() -> None:
    """Measure one lever and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    levers = parser.add_subparsers(dest="lever", required=True)
    of_steps = levers.add_parser("steps", help="steps per sample")
    of_steps.add_argument("--effects", default="standard")
    of_steps.add_argument("--load", type=float, default=60.0, help="radial, [kN]")
    of_steps.add_argument("--speed", type=float, default=120.0, help="[rad/s]")
    of_steps.add_argument("--duration", type=float, default=2.0, help="[s]")
    of_steps.add_argument("--steps", type=int, nargs="+", default=[1, 2, 3, 4, 8, 16])
    of_laminae = levers.add_parser("laminae", help="uniform and Gauss laminae")
    of_laminae.add_argument("--bearing", default="HS130x230")
    of_laminae.add_argument("--counts", type=int, nargs="+", default=[3, 4, 6, 8, 12, 20])
    parser.add_argument("--json")
    arguments = parser.parse_args()
    rows = {"steps": steps, "laminae": laminae}[arguments.lever](arguments)
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)


if __name__ == "__main__":
    main()
