"""What a wheel brings for the default scene, in the cache: ``python release/compile_kernels.py choose``, then
``compile`` in the environment that `shipped_kernels.told_to_numba` gives.

Kernels are compiled without running any: they may be for another processor.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import numba
from numba.core import types
from numba.core.registry import CPUDispatcher

from beardyn_core.choice import load_scene
from beardyn_core.choice.load import complete_scene, with_coupled_laminae
from beardyn_core.config import read_scene
from beardyn_core.rail.build import load_of_run
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import TIERS
from beardyn_core.twin import Twin

SCENE = "cup_spall"


class NoStandInError(Exception):
    """A kernel has been compiled, and its caller cannot go on without what it returns."""


def compile_instead(kernel: CPUDispatcher, *arguments: Any) -> Any:
    """Compile a kernel for what it is called with, and return zeros."""
    kinds = tuple(map(numba.typeof, arguments))
    kernel.compile(kinds)
    return zero_of(kernel.overloads[kinds].signature.return_type)


def zero_of(kind: Any) -> Any:
    """Give a value of a type that kernels return."""
    if isinstance(kind, types.BaseTuple):
        return tuple(map(zero_of, kind))
    if isinstance(kind, types.Boolean):
        return False
    if isinstance(kind, types.Number):
        return 0
    if kind is types.none:
        return None
    raise NoStandInError(kind)


def scenes() -> Iterator[Scene]:
    """Give the scene with the tier that is chosen when none is named, in every tier, and what a twin takes.

    That is `quasistatic` with coupled laminae where `full` does not keep real time.
    """
    for tier in (None, *TIERS):
        yield load_scene(SCENE, tier=tier)
    coupled = with_coupled_laminae(read_scene(SCENE, {("tier",): "quasistatic"}))
    if coupled is not None:
        yield complete_scene(coupled, outside_load=True)


def main() -> None:
    """Do what is asked for."""
    if sys.argv[1:] == ["choose"]:
        list(scenes())
    else:
        CPUDispatcher.__call__ = compile_instead
        for scene in scenes():
            Twin(scene).warm()
            with suppress(NoStandInError):
                load_of_run(scene, 0.1)


if __name__ == "__main__":
    main()
