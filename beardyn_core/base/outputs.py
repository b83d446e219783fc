"""Files that a command writes: none is replaced unasked, an input never, and no two write the same."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from beardyn_core.base.errors import InputError

try:
    import fcntl
except ImportError:  # a system without file locks
    fcntl = None  # type: ignore[assignment]

# of files that are no recordings: `beardyn export` and other programs write or read them
_OTHER_ENDINGS = (".csv", ".parquet", ".npz", ".h5", ".wav", ".rrd", ".db3", ".bag", ".yaml", ".json")
_recorders: list[list[Path]] = []


@contextmanager
def files_read() -> Iterator[list[Path]]:
    """Collect the files that `note_read` is called with while the context lasts.

    Yields
    ------
    list of Path
        A scene, its bearing, lubricant, vehicle, effects and measured files, once the scene is loaded.
    """
    found: list[Path] = []
    _recorders.append(found)
    try:
        yield found
    finally:
        _recorders[:] = [each for each in _recorders if each is not found]


def note_read(path: Path | str) -> None:
    """Add a file to those that the contexts of `files_read` collect."""
    for found in _recorders:
        found.append(Path(path))


def file_problems(
    option: str,
    path: Path | None,
    *,
    inputs: Iterable[Path] = (),
    force: bool = False,
    ending: str = "",
) -> list[str]:
    """List why a file cannot be written, one sentence each; nothing is created.

    Parameters
    ----------
    option : str
        As on the command line; empty in Python.
    path : Path or None
        As given; ``None``: not given.
    inputs : iterable of Path
        Files that the command reads, or folders of them. The same file under another name, by a link, is the
        same file.
    force : bool
        Whether an existing file may be replaced.
    ending : str
        The only one that readers of such a file take; empty: any.
    """
    if path is None:
        return []
    where, folder = f"{option} {path}".strip(), path.parent
    if path.is_dir():
        return [f"{where}: is a folder; give the name of a file in it"]
    if not folder.is_dir():
        return [f"{where}: the folder {folder} does not exist; create it or choose another"]
    if any(_is_same(path, each) for given in inputs for each in _files_of(given)):
        return [
            f"{where}: the command reads this file; an input is never replaced, not even with --force: "
            "give another name"
        ]
    if path.is_symlink() and not path.exists():
        return [f"{where}: is a link to a file that does not exist; give another name"]
    if not os.access(path if path.exists() else folder, os.W_OK):
        return [f"{where}: cannot be written; choose a file you may write to"]
    if path.is_file() and is_being_written(path):
        return [f"{where}: another process is writing this file; wait for its end or give another name"]
    if path.is_file() and not force:
        return [f"{where}: the file exists; --force replaces it, or give another name"]
    if ending and path.suffix.lower() != ending:
        return [f"{where}: let its name end in {ending}, by which programs that read it know it"]
    return []


def recording_problems(
    option: str, path: Path | None, *, inputs: Iterable[Path] = (), force: bool = False
) -> list[str]:
    """List why a recording cannot be written: as `file_problems`, and the ending of another format."""
    problems = file_problems(option, path, inputs=inputs, force=force)
    if problems or path is None or path.suffix.lower() not in _OTHER_ENDINGS:
        return problems
    return [
        f"{option} {path}".strip() + f": a recording is an MCAP file, not {path.suffix}; let its name end in "
        ".mcap (beardyn export makes tables and WAV files of it)"
    ]


def folder_problems(
    option: str,
    folder: Path | None,
    names: Sequence[str] = (),
    *,
    inputs: Sequence[Path] = (),
    force: bool = False,
) -> list[str]:
    """List why files cannot be written to a folder, one sentence each; nothing is created.

    Parameters
    ----------
    option : str
        As on the command line.
    folder : Path or None
        As given; ``None``: not given. It is made when it is missing.
    names : sequence of str
        Files that will be written in it.
    inputs : sequence of Path
        Files that the command reads.
    force : bool
        Whether existing files may be replaced.
    """
    if folder is None:
        return []
    if folder.exists() and not folder.is_dir():
        return [f"{option} {folder}: is a file; give the name of a folder"]
    if not folder.is_dir() and not folder.parent.is_dir():
        return [f"{option} {folder}: the folder {folder.parent} does not exist; create it first"]
    if not os.access(folder if folder.is_dir() else folder.parent, os.W_OK):
        return [f"{option} {folder}: cannot be written; choose a folder you may write to"]
    if not folder.is_dir():
        return []
    return [
        problem
        for name in names
        for problem in file_problems(option, folder / name, inputs=inputs, force=force)
    ]


def _files_of(path: Path) -> Iterable[Path]:
    """List the files of a recording in several files, which is a folder; any other path is its own."""
    return path.iterdir() if path.is_dir() else (path,)


def _is_same(one: Path, other: Path) -> bool:
    try:
        return one.samefile(other)
    except OSError:
        return one.resolve() == other.resolve()


def is_being_written(path: Path) -> bool:
    """Tell whether another process holds the lock that `open_to_write` takes."""
    if fcntl is None:
        return False
    try:
        with path.open("rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:  # unreadable, or a file system without locks
        return False
    return False


def open_to_write(path: Path, *, replace: bool = False) -> BinaryIO:
    """Open a file for writing from its beginning, and lock it as long as it is open.

    The system releases the lock when the process ends, however it ends: what a crash leaves behind
    blocks nobody.

    Parameters
    ----------
    replace : bool
        Whether an existing file is replaced.

    Raises
    ------
    InputError
        The file exists, or another process is writing it.
    OSError
        The file cannot be opened.
    """
    try:
        handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o666)
    except FileExistsError:
        return _open_existing(path, replace)
    _lock(handle, path)
    return os.fdopen(handle, "wb")


def _open_existing(path: Path, replace: bool) -> BinaryIO:
    if not stat.S_ISREG(path.stat().st_mode):
        return path.open("wb")  # a device or a pipe
    handle = os.open(path, os.O_RDWR | os.O_CLOEXEC)
    try:
        _lock(handle, path)
        if not replace:
            raise InputError(f"{path}: the file exists; --force replaces it, or give another name")
        os.ftruncate(handle, 0)
    except BaseException:
        with suppress(OSError):
            os.close(handle)
        raise
    return os.fdopen(handle, "wb")


def open_to_append(path: Path, *, empty: bool = False) -> BinaryIO:
    """Open a file for writing at its end, behind a whole line, and lock it as long as it is open.

    Parameters
    ----------
    path : Path
        Made when it is missing.
    empty : bool
        Whether what it holds goes.

    Raises
    ------
    InputError
        Another process is writing it.
    OSError
        The file cannot be opened.
    """
    file = path.open("ab+", buffering=0)
    try:
        _lock(file.fileno(), path)
        if empty:
            file.truncate(0)
        end = file.seek(0, os.SEEK_END)
        if end:
            file.seek(end - 1)
            if file.read(1) != b"\n":  # a line that was cut off
                file.write(b"\n")
    except BaseException:
        file.close()
        raise
    return file


def _lock(handle: int, path: Path) -> None:
    if fcntl is None:
        return
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        if error.errno in (errno.EWOULDBLOCK, errno.EACCES):
            raise InputError(
                f"{path}: another process is writing this file; wait for its end or give another name"
            ) from None
        # a file system without locks: nothing more can be done


def write_whole(path: Path, text: str, *, replace: bool = True) -> None:
    """Write a text file so that it is there as a whole or not at all; see `as_a_whole`."""
    with as_a_whole(path, replace=replace) as fresh:
        fresh.write_text(text, encoding="utf-8")


@contextmanager
def as_a_whole(path: Path, *, replace: bool = True) -> Iterator[Path]:
    """Let a file be written so that it is there as a whole, or as it was before when that fails.

    Parameters
    ----------
    replace : bool
        Whether it takes the place of one that is there at the end, such as one that another process has
        written meanwhile.

    Yields
    ------
    Path
        Where to write: a file next to it that takes its place at the end; a device or a pipe itself.

    Raises
    ------
    InputError
        A file is there at the end, and `replace` is not set.
    """
    path = path.resolve()
    if path.exists() and not path.is_file():
        yield path
        return
    fresh = path.with_name(f".{path.name}.{os.getpid()}.new")
    try:
        yield fresh
        if not replace:
            _claim(path)
        fresh.replace(path)
    except BaseException:
        with suppress(OSError):
            fresh.unlink()
        raise


def _claim(path: Path) -> None:
    """Make an empty file of a name that is free; of two processes only one can."""
    try:
        path.open("xb").close()
    except FileExistsError:
        raise InputError(
            f"{path}: another process has written this file meanwhile, and it stays; give another name, or "
            "--force to replace it"
        ) from None
