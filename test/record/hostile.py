"""What a command says of a file that nobody would write."""

from __future__ import annotations

import io
from contextlib import redirect_stderr, redirect_stdout

from beardyn_core.cli import main as command

MAGIC = b"\x89MCAP0\r\n"


def told(*words: str) -> tuple[int, str]:
    """Exit code of a command and everything that it says; an exception that escapes fails the test."""
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        code = command.main(words)
    return code, out.getvalue() + err.getvalue()
