"""How kernels are compiled: flags, inlining, and a disk cache that sees every edit.

numba's own cache looks only at the file of the entry point and would return stale code after an edit
of a function it calls. Here the cache folder is named by a hash of all kernel sources instead.
"""

from __future__ import annotations

import hashlib
import os
import signal
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import Any

import numba
from numba.core import event

# No nnan and no ninf: a NaN must stay visible. No reassoc: lanes and scalars then differ by the rounding of
# fused multiplications only, and one machine always gives the same bits.
FASTMATH = ("nsz", "arcp", "contract", "afn")
OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": set(FASTMATH)}

_CORE = Path(__file__).resolve().parent
_COMPILED_ROOMS = (".", "kernels", "integrate", "model", "observe", "rail", "scene")


def source_hash() -> str:
    """Hash of all sources that compiled code may come from, and of numba's version."""
    digest = hashlib.sha256(numba.__version__.encode())
    for room in _COMPILED_ROOMS:
        for path in sorted((_CORE / room).glob("*.py")):
            digest.update(path.name.encode())
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def cache_folder() -> Path:
    """Folder of the compiled kernels: ``$BEARDYN_CACHE_DIR`` or the user's cache folder."""
    root = os.environ.get("BEARDYN_CACHE_DIR")
    if root is None:
        root = os.path.join(os.environ.get("XDG_CACHE_HOME", os.path.expanduser("~/.cache")), "beardyn")
    return Path(root) / "kernels" / source_hash()


def inline(function: Callable[..., Any]) -> Any:
    """Compile a kernel part that is always inlined into its caller."""
    return numba.njit(forceinline=True, **OPTIONS)(function)


def entry(function: Callable[..., Any], *, flags: Iterable[str] = FASTMATH) -> Any:
    """Compile an entry point and keep it in the disk cache.

    Parameters
    ----------
    function : callable
    flags : iterable of str
        LLVM fast-math flags.

    Returns
    -------
    callable
        The compiled function.
    """
    before = numba.config.CACHE_DIR  # type: ignore[attr-defined]
    numba.config.CACHE_DIR = str(cache_folder())  # type: ignore[attr-defined]
    try:
        return numba.njit(cache=True, **{**OPTIONS, "fastmath": set(flags)})(function)
    finally:
        numba.config.CACHE_DIR = before  # type: ignore[attr-defined]


class _CompilerWatch(event.Listener):
    """Keeps what is compiled, and says so when it begins."""

    def __init__(self, say: Callable[[], None]) -> None:
        self.begun: list[str] = []
        self._say = say

    def on_start(self, event: Any) -> None:
        """A function was not in the cache."""
        self.begun.append(str(event.data["dispatcher"]))
        if len(self.begun) == 1:
            self._say()

    def on_end(self, event: Any) -> None:
        """A function is ready."""


@contextmanager
def when_compiling(say: Callable[[], None]) -> Iterator[list[str]]:
    """Call ``say`` once, when a kernel turns out not to be in the cache, before it is compiled.

    Yields
    ------
    list of str
        What has been compiled: empty when all came from the cache.
    """
    watch = _CompilerWatch(say)
    with _no_interrupt_lost(), event.install_listener("numba:compile", watch):
        yield watch.begun


@contextmanager
def _no_interrupt_lost() -> Iterator[None]:
    """Ctrl-C in one of the compiler's callbacks is swallowed there: then it comes at the end instead."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.getsignal(signal.SIGINT)
    pressed: list[int] = []

    def remember(number: int, frame: FrameType | None) -> None:
        pressed.append(number)
        if callable(before):
            before(number, frame)

    signal.signal(signal.SIGINT, remember)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before if before is not None else signal.SIG_DFL)
    if pressed and before is signal.default_int_handler:
        raise KeyboardInterrupt
