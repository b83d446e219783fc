"""A small file as one word of text, so that a recorded scene holds what it was computed from."""

from __future__ import annotations

import base64
import binascii
import zlib

from beardyn_core.errors import InputError

_LARGEST = 1 << 26  # bytes, unpacked


def packed(text: str) -> str:
    """Pack a text: zlib, then base64 of RFC 4648; the same word every time."""
    return base64.b64encode(zlib.compress(text.encode(), 9)).decode()


def unpacked(word: str, label: str) -> str:
    """Unpack what `packed` has made.

    Parameters
    ----------
    label : str
        What to call it in a complaint.

    Raises
    ------
    InputError
        When it was damaged, or is larger than any table.
    """
    try:
        reader = zlib.decompressobj()
        text = reader.decompress(base64.b64decode(word, validate=True), _LARGEST)
        if not reader.eof:
            raise zlib.error("it is cut off, or longer than 64 MB")
        return text.decode()
    except (binascii.Error, zlib.error, ValueError) as error:
        raise InputError(
            f"{label}: content cannot be unpacked ({error}); leave it out to read the file"
        ) from error
