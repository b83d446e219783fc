"""A small file as one word of text, so that a recorded scene holds what it was computed from."""

from __future__ import annotations

import base64
import binascii
import zlib
from pathlib import Path

from beardyn_core.base.errors import InputError

_LARGEST = 1 << 26  # bytes, unpacked
_OF = "of "  # before the path, which is absolute


def pack_file(text: str, path: Path | str) -> str:
    """Pack the text of a file with its path: zlib, then base64 of RFC 4648; the same word every time."""
    return base64.b64encode(zlib.compress(f"{_OF}{path}\n{text}".encode(), 9)).decode()


def unpack_file(word: str, path: Path | str) -> str:
    """Unpack what `pack_file` has made.

    Parameters
    ----------
    path : Path or str
        The file that is named now: that of the word, perhaps seen from another folder.

    Raises
    ------
    InputError
        When it was damaged, is larger than any table, or is of another file than the one named.
    """
    try:
        reader = zlib.decompressobj()
        text = reader.decompress(base64.b64decode(word, validate=True), _LARGEST)
        if not reader.eof:
            raise zlib.error("it is cut off, or longer than 64 MB")
        whole = text.decode()
    except (binascii.Error, zlib.error, ValueError) as error:
        raise InputError(
            f"{path}: content cannot be unpacked ({error}); leave it out to read the file"
        ) from error
    if not whole.startswith(_OF):
        return whole
    origin, _, rest = whole.removeprefix(_OF).partition("\n")
    if not _slashed_path(path).endswith(_slashed_path(origin)):
        raise InputError(
            f"{path}: content next to it is that of {origin}; leave content out to read this file, or name "
            "that one"
        )
    return rest


def _slashed_path(path: Path | str) -> str:
    return str(path).replace("\\", "/")
