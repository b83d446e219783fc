"""Inputs and outputs of a command: all complaints at once, doubts, and a folder that can be written."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import files_read

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene


@contextmanager
def check_inputs(more: Callable[[list[Path]], list[str]] = lambda _: []) -> Iterator[None]:
    """Read the inputs of a command in the context; raise `InputError` of them and of its options at once.

    ``more`` lists what is wrong with the options, from the files that were read.
    """
    problems: list[str] = []
    with files_read() as inputs:
        try:
            yield
        except InputError as error:
            # options are not quite the keys
            problems = [
                each.replace("--accuracy_percent", "--accuracy").replace("--vibration_to", "--vibration-to")
                for each in error.problems
            ]
    if problems := problems + more(inputs):
        raise InputError(problems)


def tell_doubts(scene: Scene) -> None:
    """Warn, on standard error, of what is possible in a scene but unusual."""
    for doubt in scene.doubts:
        print(f"beardyn: warning: {doubt}", file=sys.stderr)


@contextmanager
def made_folder(folder: Path) -> Iterator[None]:
    """Make the folder of ``--output``; raise `InputError` where a file of the context cannot be written."""
    try:
        folder.mkdir(exist_ok=True)
        yield
    except OSError as error:
        raise InputError(f"--output {folder}: cannot be written: {error.strerror or error}") from None
