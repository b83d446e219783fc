"""What takes long is announced on standard error, also where nobody has set up logging."""

from __future__ import annotations

import logging
import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def announced_on_stderr() -> Iterator[None]:
    """Print what is logged at INFO on standard error, unless the program has set up the logger itself.

    A command and a program with levels of its own keep theirs: the line appears once, where they want it.
    """
    logger = logging.getLogger("beardyn")
    if logger.level != logging.NOTSET or logger.isEnabledFor(logging.INFO):
        yield
        return
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(logging.Formatter("beardyn: %(message)s"))
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)
    try:
        yield
    finally:
        logger.setLevel(logging.NOTSET)
        logger.removeHandler(handler)
