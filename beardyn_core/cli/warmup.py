"""``beardyn warmup``: compile the kernels of scenes ahead of their first run."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from typing import TYPE_CHECKING

from beardyn_core.api.simulating import simulate
from beardyn_core.base.interrupts import last_words
from beardyn_core.cli.generated_parser import add_parameter

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene

_PRESET_SCENE = "smooth_run"


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "warmup",
        help="compile the kernels of a scene ahead of its first run",
        description="Compile the kernels that scenes need and keep them in the cache, so that the first run "
        "starts at once. Without a scene: all shipped scenes, and each shipped set of effects in every tier.",
    )
    parser.add_argument(
        "scene", nargs="*", metavar="SCENE", help="shipped scene or YAML file; default all, see above"
    )
    add_parameter(parser, simulate, "effects", metavar="NAME", usual="the scene's, or every set")
    add_parameter(parser, simulate, "tier", metavar="T", usual="the scene's, or every tier")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.base.jit import when_compiling
    from beardyn_core.choice import load_scene
    from beardyn_core.twin import Twin

    if args.scene:
        named = [(name, load_scene(name, effects=args.effects, tier=args.tier)) for name in args.scene]
    else:
        named = list(_shipped_scenes(args.effects, args.tier))
    ready = 0
    with last_words(lambda: f"{ready} of {len(named)} are ready, and kept for the next time"):
        for name, scene in named:
            began = time.perf_counter()
            with when_compiling(lambda: None) as compiled:
                for each in _of_one_box(scene):
                    Twin(each).warm()
            took = time.perf_counter() - began
            came = "compiled" if compiled else "in the cache"
            print(f"{name:28} {scene.tier:12} {came}, ready after {took:.1f} s", flush=True)
            ready += 1
    return 0


def _of_one_box(scene: Scene) -> list[Scene]:
    """Give the scene, or of one with axleboxes those of a healthy and a faulty box: the others are alike."""
    from beardyn_core.config.boxes import scene_of_box

    if scene.axleboxes is None:
        return [scene]
    boxes = (scene_of_box(scene, box) for box in scene.axleboxes.boxes)
    return list({bool(box.faults): box for box in boxes}.values())


def _shipped_scenes(effects: str | None, tier: str | None) -> Iterator[tuple[str, Scene]]:
    """List shipped scenes as they are, then every preset in every tier, each with its name."""
    from beardyn_core.choice import load_scene
    from beardyn_core.config import shipped_names
    from beardyn_core.scene.tier import TIERS

    for name in shipped_names("scenes"):
        yield name, load_scene(name, effects=effects, tier=tier)
    for preset in [effects] if effects else shipped_names("effects"):
        for each in [tier] if tier else TIERS:
            yield f"{_PRESET_SCENE}, {preset}", load_scene(_PRESET_SCENE, effects=preset, tier=each)
