"""Files that are read: a pipe or a device would be waited for, or read for ever."""

from __future__ import annotations

import errno
import stat
from pathlib import Path


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
