"""What both demonstrations share on the console: arguments and progress."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of this demo and of the one with nodes."""
    parser.add_argument(
        "--scene", default="cup_spall", metavar="SCENE", help="shipped scene or YAML file; default cup_spall"
    )
    parser.add_argument(
        "-o",
        "--output",
        metavar="DIR",
        type=Path,
        help="folder for the results; default demo, or the next free one: demo_2, demo_3, ...",
    )
    parser.add_argument(
        "--effects",
        metavar="NAME",
        help="set or file of effects, or auto; default the scene's, or what it needs to be "
        "within 5 %% of the full model",
    )
    parser.add_argument("--duration", type=float, metavar="S", help="simulated time, s; default the scene's")
    parser.add_argument("--force", action="store_true", help="replace the results of an earlier demo")
    parser.add_argument(
        "--no-view", action="store_true", help="take no picture of the rerun view (saves some ten seconds)"
    )


def say(line: str) -> None:
    """Print at once, also into a pipe."""
    print(line, flush=True)


class Progress:
    """One line that is overwritten on a terminal, one line a simulated second elsewhere."""

    def __init__(self, duration: float) -> None:
        self._duration = duration
        self._said = 0.0
        self._monitor = "no verdict yet"
        self._terminal = sys.stdout.isatty()
        self._open = False

    def receive(self, verdict: str) -> None:
        """Keep the latest verdict of the monitor."""
        from beardyn_core.monitor.chain.explanations import PART_NAMES

        self._monitor = {
            "waiting": "no verdict yet",
            "healthy": "no fault",
            "not_diagnosable": "not diagnosable",
            "unexplained": "strikes that fit no part",
            "hot_box": "hot box",
            **{part: f"fault of the {name}" for part, name in PART_NAMES.items()},
        }.get(verdict, verdict)

    def show(self, simulated: float, real_time_factor: float) -> None:
        """Show where the run is, in simulated seconds."""
        if not self._terminal and simulated - self._said < 1.0:
            return
        self._said = simulated
        line = (
            f"simulated {simulated:6.2f} of {self._duration:.2f} s   "
            f"real-time factor {real_time_factor:5.2f}   monitor: {self._monitor}"
        )
        if self._terminal:
            print(f"\r{line}\033[K", end="", flush=True)
            self._open = True
        else:
            say(line)

    def close(self) -> None:
        """Leave the line as it is."""
        if self._open:
            print(flush=True)
            self._open = False
