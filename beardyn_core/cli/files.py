"""Inputs and outputs of a command: all complaints at once, doubts, and a folder that can be written."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.errors import InputError
from beardyn_core.outputs import files_read

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene


@contextmanager
def checked(more: Callable[[list[Path]], list[str]] = lambda _: []) -> Iterator[None]:
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


def foreign_folder_problems(
    folder: Path | None, own: Sequence[str], what: str, inputs: Iterable[Path] = ()
) -> list[str]:
    """Say why ``--output`` is a folder of something else: it holds files, and none of ``own``.

    Files that the command reads may lie there.
    """
    if folder is None or not folder.is_dir() or any((folder / name).exists() for name in own):
        return []
    read = {path.resolve() for path in inputs}
    if all(path.resolve() in read for path in folder.iterdir()):
        return []
    return [f"--output {folder}: holds files and no {what}; give a new folder, for nothing there is replaced"]


@contextmanager
def made_folder(folder: Path) -> Iterator[None]:
    """Make the folder of ``--output``; raise `InputError` where a file of the context cannot be written."""
    try:
        folder.mkdir(exist_ok=True)
        yield
    except OSError as error:
        raise InputError(f"--output {folder}: cannot be written: {error.strerror or error}") from None
