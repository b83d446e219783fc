"""How kernels are compiled: flags, inlining, and the disk cache."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from types import FunctionType
from typing import Any

import numba
from numba.core import event, sigutils, types
from numba.core.codegen import JITCodeLibrary, get_host_cpu_features
from numba.core.compiler import Compiler, Flags
from numba.core.registry import CPUDispatcher

from beardyn_core.base.interrupts import held_back, seal, unseal
from beardyn_core.base.kernel_cache import KernelCache

# No nnan and no ninf: a NaN must stay visible. No reassoc: lanes and scalars then differ by the rounding of
# fused multiplications only, and one machine always gives the same bits.
FASTMATH = ("nsz", "arcp", "contract", "afn")
# Kernels allocate nothing: the caller holds every array that they see. Counting the references all the same,
# atomically, took a fifth of the time of a step.
OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy", "fastmath": set(FASTMATH), "_nrt": False}


# Rollers that a kernel takes at once: as many as fill one vector register, with AVX-512 or with AVX2. Twice
# as many cost 1.6 times the time of a step, half as many 1.7 times.
def lane_width() -> int:
    """Choose the lanes for the processor that numba compiles for: this one, unless another is set."""
    told = numba.config.CPU_FEATURES  # type: ignore[attr-defined]
    features = get_host_cpu_features() if told is None else told
    return 8 if "+avx512f" in features.split(",") else 4


LANE_WIDTH = lane_width()


class _PartLibrary(JITCodeLibrary):
    """Code that exists only to be linked into the code of others: no machine code is made of it."""

    def _optimize_final_module(self) -> None:
        """Leave it to the entry point, which sees all of its parts at once."""

    def _finalize_final_module(self) -> None:
        """Keep the code out of the engine, which would make machine code of all that it is given."""
        self._finalize_dynamic_globals()
        self._finalized = True

    def get_pointer_to_function(self, _name: str) -> int:
        """Return no address: there is no machine code."""
        return 0

    @property
    def codegen(self) -> Any:
        """Give a code generator that drops the environment of a function, which only running code uses."""
        return _NoEnvironment


class _NoEnvironment:
    @staticmethod
    def set_env(_name: str, _environment: Any) -> None:
        """Set nothing."""


class _PartCompiler(Compiler):
    """Compiles into a `_PartLibrary`."""

    def __init__(self, typing: Any, target: Any, library: Any, *rest: Any) -> None:
        made = _PartLibrary(target.codegen(), "part") if library is None else library
        super().__init__(typing, target, made, *rest)


class _SetFlags(Flags):
    """Flags that are distinguished by what has been set.

    numba finds its own work again by them a hundred thousand times while it compiles a step; with its own
    comparison, of all forty with their usual values, that took an eighth of the time.
    """

    def __hash__(self) -> int:
        return hash(tuple(self._values))

    def __eq__(self, other: object) -> bool:
        return self._values == other._values if isinstance(other, _SetFlags) else super().__eq__(other)


def _with_set_flags(dispatcher: Any) -> Any:
    """Have a function compiled with `_SetFlags`, and so what it calls by type."""
    dispatcher._compiler._customize_flags = _SetFlags
    return dispatcher


class _Part(CPUDispatcher):
    """A function that only compiled functions call, and always as a copy in their own code.

    numba makes three things of every function that kernels can do without: wrappers that unpack Python's
    arguments, hundreds of numbers here, machine code of the function by itself, and one more version for
    each constant it is called with. They were more than half of the time of compiling a step.
    """

    def compile(self, sig: Any) -> Any:
        """Compile for argument types; constants count as any number of their type."""
        arguments, result = sigutils.normalize_signature(sig)
        plain = tuple(types.unliteral(each) for each in arguments)
        return super().compile(plain if result is None else result(*plain))

    def add_overload(self, compiled: Any) -> None:
        """Keep a version for other compiled functions and not for Python, which could not call it."""
        self.overloads[tuple(compiled.signature.args)] = compiled

    def _compile_for_args(self, *_arguments: Any, **_named: Any) -> Any:
        """Compile it as a function of its own, when Python calls it after all, in a test."""
        return _whole(self.py_func)


@cache
def _whole(function: Callable[..., Any]) -> Any:
    return numba.njit(**OPTIONS)(function)


def inline(function: Callable[..., Any]) -> Any:
    """Compile a kernel part that is always inlined into its caller."""
    if numba.config.DISABLE_JIT:  # type: ignore[attr-defined]
        return function
    options = {"nopython": True, "forceinline": True, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    part = _Part(py_func=function, targetoptions={**options, **OPTIONS}, pipeline_class=_PartCompiler)
    return _with_set_flags(part)


def part_of(function: Callable[..., Any]) -> Any:
    """Compile a plain function as a kernel part, with those of its module that it calls.

    For formulas whose module must not bring the compiler along.
    """
    names = dict(function.__globals__)
    for name in function.__code__.co_names:
        called = names.get(name)
        if isinstance(called, FunctionType) and called.__module__ == function.__module__:
            names[name] = part_of(called)
    return inline(FunctionType(function.__code__, names, function.__name__, function.__defaults__))


@cache
def plain(function: Callable[..., Any]) -> Callable[..., Any]:
    """Give a kernel function and those that it calls in plain Python: a few numbers need no compiler."""
    python = getattr(function, "py_func", function)
    names = dict(python.__globals__)
    for name in python.__code__.co_names:
        if isinstance(names.get(name), _Part):
            names[name] = plain(names[name])
    return FunctionType(python.__code__, names, python.__name__, python.__defaults__, python.__closure__)


def entry(function: Callable[..., Any], *, flags: Iterable[str] = FASTMATH, allocates: bool = False) -> Any:
    """Compile an entry point and keep it in the disk cache.

    Parameters
    ----------
    function : callable
    flags : iterable of str
        LLVM fast-math flags.
    allocates : bool
        Whether the function makes arrays; their references are counted then, and no part that it calls may
        return an array.

    Returns
    -------
    callable
        The compiled function.
    """
    if numba.config.DISABLE_JIT:  # type: ignore[attr-defined]
        return function
    options = {**OPTIONS, "fastmath": set(flags), "_nrt": allocates, "no_cfunc_wrapper": True}
    compiled = numba.njit(**options)(function)
    compiled._cache = KernelCache(
        function, repr(sorted((key, _sort_keys(value)) for key, value in options.items()))
    )
    return _with_set_flags(compiled)


def _sort_keys(value: Any) -> Any:
    return sorted(value) if isinstance(value, set) else value


class _Sealed(event.Listener):
    """Keeps Ctrl-C out of the compiler: an exception in one of its callbacks crashes it or is swallowed."""

    def on_start(self, event: Any) -> None:
        """Begin to compile a function or to load it, perhaps inside of another one."""
        seal()

    def on_end(self, event: Any) -> None:
        """Be outside again."""
        unseal()


event.register("numba:compiler_lock", _Sealed())


class _Unswept(event.Listener):
    """Keeps the garbage collector from going through all that numba holds while it compiles.

    A step makes millions of objects, and each sweep over those that stay for good took its time: a sixth of
    the whole. What was there before is left out of the sweeps, and these come more rarely.
    """

    SELDOM = 50_000, 20, 20

    def __init__(self) -> None:
        self._depth, self._before, self._frozen = 0, gc.get_threshold(), False

    def on_start(self, event: Any) -> None:
        """Begin with a function, perhaps inside of another one."""
        self._depth += 1
        if self._depth == 1:
            self._before, self._frozen = gc.get_threshold(), gc.get_freeze_count() == 0
            if self._frozen:
                gc.freeze()
            if self._before[0]:  # 0: the program wants no sweeps at all
                gc.set_threshold(*self.SELDOM)

    def on_end(self, event: Any) -> None:
        """Be done with it."""
        self._depth -= 1
        if self._depth == 0:
            gc.set_threshold(*self._before)
            if self._frozen:
                gc.unfreeze()


event.register("numba:compile", _Unswept())


class _CompilerWatch(event.Listener):
    """Keeps what is compiled, and says so when it begins."""

    def __init__(self, say: Callable[[], None]) -> None:
        self.begun: list[str] = []
        self._say = say

    def on_start(self, event: Any) -> None:
        """Note a function that was not in the cache."""
        self.begun.append(str(event.data["dispatcher"]))
        if len(self.begun) == 1:
            self._say()

    def on_end(self, event: Any) -> None:
        """Have a function ready."""


@contextmanager
def when_compiling(say: Callable[[], None]) -> Iterator[list[str]]:
    """Call ``say`` once, when a kernel turns out not to be in the cache, before it is compiled.

    Yields
    ------
    list of str
        What has been compiled: empty when all came from the cache.
    """
    watch = _CompilerWatch(say)
    with held_back(), event.install_listener("numba:compile", watch):
        yield watch.begun
