"""Kernels compiled once on a machine, however many processes want them at the same time."""

from __future__ import annotations

import hashlib
import threading
from collections.abc import Hashable, Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

from beardyn_core.base.cache_root import cache_root
from beardyn_core.base.machine_code import code_digest
from beardyn_core.physics.tiers.imex import advance
from beardyn_core.physics.tiers.lumped import advance_lumped
from beardyn_core.physics.tiers.quasistatic import advance_quasistatic
from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin

try:
    import fcntl
except ImportError:  # a system without file locks
    fcntl = None  # type: ignore[assignment]

_ready: set[Hashable] = set()
_readying = threading.Lock()


def warm_once(scene: Scene, kind: Hashable = None) -> None:
    """Compile the kernels of a scene, or wait while another process of this machine does and read them.

    Parameters
    ----------
    kind : hashable, optional
        Of kernels: of each kind it is done once in a process. By default what decides it: tier, effects and
        sorts of faults.

    Notes
    -----
    A file next to the kernels says which kinds are there: a process that only reads them waits for nobody who
    compiles others.
    """
    if kind is None:
        kind = _kind_of(scene)
    with _readying:
        if kind in _ready:
            return
        known = _known_file(kind)
        if known.exists():
            Twin(scene).warm()
        else:
            with alone_on_this_machine():
                Twin(scene).warm()
            with suppress(OSError):
                known.parent.mkdir(parents=True, exist_ok=True)
                known.touch()
        _ready.add(kind)


def is_compiled(scene: Scene) -> bool:
    """Tell whether `warm_once` has compiled the kernels of a scene on this machine."""
    return _known_file(_kind_of(scene)).exists()


def _kind_of(scene: Scene) -> Hashable:
    faults = sorted({type(each).__name__ for each in scene.faults})
    return (scene.tier, repr(scene.effects), scene.effect_names, *faults)


def _known_file(kind: Hashable) -> Path:
    key = hashlib.sha256(repr((kind, _steps())).encode()).hexdigest()[:32]
    return cache_root() / "kernels" / "kinds" / key


@cache
def _steps() -> tuple[str, ...]:
    steps = (advance, advance_quasistatic, advance_lumped)
    return tuple(code_digest(getattr(each, "py_func", each)) for each in steps)


@contextmanager
def alone_on_this_machine() -> Iterator[None]:
    """Let no other process of this machine compile meanwhile; the lock of a process that dies is free."""
    if fcntl is None:
        yield
        return
    folder = cache_root() / "kernels"
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "compiling.lock").open("ab") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield
