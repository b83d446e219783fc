"""``beardyn warmup``: compile the kernels of scenes ahead of their first run."""

from __future__ import annotations

import argparse
import time


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "warmup",
        help="compile the kernels of a scene ahead of its first run",
        description="Compile the kernels that scenes need and keep them in the cache, so that the first run "
        "starts at once.",
    )
    parser.add_argument(
        "scene", nargs="*", metavar="SCENE", help="shipped scene or YAML file (all shipped ones)"
    )
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.config import load_scene, shipped_names
    from beardyn_core.twin import Twin

    scenes = [load_scene(name) for name in args.scene or shipped_names("scenes")]
    for scene in scenes:
        began = time.perf_counter()
        Twin(scene).warm()
        print(f"{scene.name:16} ready after {time.perf_counter() - began:.1f} s")
    return 0
