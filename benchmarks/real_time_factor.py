"""Real-time factor of the shipped scenes: simulated time over wall time, medians over blocks.

Run it on an idle machine: ``python benchmarks/real_time_factor.py [--blocks N]``. Prints a table and, with
``--json FILE``, writes the numbers.
"""

from __future__ import annotations

import argparse
import json
import platform
import statistics
import time

from beardyn_core.config import load_scene
from beardyn_core.rail.build import load_history
from beardyn_core.twin import Twin

SCENES = ("static_80kN", "static_5kN", "smooth_run", "cup_spall", "cone_spall")
SETTLING_BLOCKS = 3


def measure(name: str, laminae: int | None, blocks: int, tier: str = "full") -> dict[str, float | str | int]:
    """Median wall time of a block of one scene: kernel alone, and with all channels."""
    scene = load_scene(name, laminae=laminae, tier=tier)
    twin = Twin(scene)
    twin.warm()
    count = blocks + SETTLING_BLOCKS
    twin.start(load_history(scene.operation, scene.mounting, count * twin.block_ns * 1e-9, scene.seed))
    kernel, total = [], []
    for _ in range(count):
        began = time.perf_counter()
        block = twin.advance()
        total.append(time.perf_counter() - began)
        kernel.append(block.wall_s)
    simulated = twin.block_ns * 1e-9
    return {
        "scene": name,
        "tier": tier,
        "laminae": scene.numerics.laminae,
        "rtf": simulated / statistics.median(total[SETTLING_BLOCKS:]),
        "rtf_kernel": simulated / statistics.median(kernel[SETTLING_BLOCKS:]),
        "us_per_step": 1e6
        * statistics.median(kernel[SETTLING_BLOCKS:])
        / (512 * scene.numerics.steps_per_sample),
    }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--blocks", type=int, default=40)
    parser.add_argument("--json")
    arguments = parser.parse_args()
    rows = [measure(name, None, arguments.blocks) for name in SCENES]
    rows.append(measure("smooth_run", 20, arguments.blocks))
    rows += [
        measure(name, None, 4 * arguments.blocks, tier)
        for tier in ("quasistatic", "lumped")
        for name in ("static_80kN", "cup_spall")
    ]
    print(f"{platform.processor() or platform.machine()}, one core")
    print(f"{'scene':14}{'tier':12}{'laminae':>8}{'RTF':>8}{'kernel':>8}{'us/step':>9}")
    for row in rows:
        print(
            f"{row['scene']:14}{row['tier']:12}{row['laminae']:>8}{row['rtf']:>8.2f}{row['rtf_kernel']:>8.2f}"
            f"{row['us_per_step']:>9.2f}"
        )
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)


if __name__ == "__main__":
    main()
