"""Files that are read: a pipe or a device would be waited for, or read for ever."""

from __future__ import annotations

import errno
import stat
from pathlib import Path

LONGEST_TEXT_FILE = 500_000_000  # bytes; tables of a finite-element program are long


def size_of_file(path: Path) -> int:
    """Return the size of a file, [byte].

    Raises
    ------
    OSError
        It is absent, or a pipe, a socket or a device; a folder is left to who opens it.
    """
    found = path.stat()
    if not (stat.S_ISREG(found.st_mode) or stat.S_ISDIR(found.st_mode)):
        raise OSError(errno.EINVAL, "it is a pipe or a device, not a file")
    return found.st_size


def text_of_file(path: Path, encoding: str = "utf-8") -> str:
    """Read a text file.

    Raises
    ------
    OSError
        The file is absent, too long, or a pipe or a device.
    UnicodeDecodeError
        The file is no text of this encoding.
    """
    if size_of_file(path) > LONGEST_TEXT_FILE:
        raise OSError(errno.EFBIG, f"it is longer than {LONGEST_TEXT_FILE // 1_000_000} MB")
    return path.read_text(encoding=encoding)
