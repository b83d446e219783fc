"""Python in a child process that ends with its parent: ``python -I -S child.py PARENT_ID WORDS``.

Run by its path and with the standard library alone, so that it costs a few hundredths of a second.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys

PR_SET_PDEATHSIG = 1


def end_with(parent: int) -> None:
    """Ask the kernel, on Linux, to end this process when its parent is gone, however that happened.

    Parameters
    ----------
    parent : int
        Process id; when it has gone already, this process ends at once.
    """
    if sys.platform.startswith("linux"):
        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, int(signal.SIGTERM))
        if os.getppid() != parent:
            os._exit(0)
    # an interrupt that has come meanwhile ends the child without a traceback
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})


if __name__ == "__main__":
    end_with(int(sys.argv[1]))
    # The request is kept over exec, and the program finds itself as if it had been started alone.
    os.execv(sys.executable, [sys.executable, *sys.argv[2:]])
