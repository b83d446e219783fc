"""Compiled kernels on disk: found again by what their machine code comes from, wherever that is written.

numba's own cache looks at the file of the entry point alone: it returns stale code after an edit of a
function that it calls, and compiles anew after an edit of a comment or in another copy of the package.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from typing import Any

import llvmlite
import numba
import numpy as np
from numba.core import environment
from numba.core.compiler import CompileResult
from numba.core.serialize import dumps

from beardyn_core.base.cache_root import cache_root, shipped_root
from beardyn_core.base.machine_code import code_digest, how_parts_are_compiled, spelled_type
from beardyn_core.base.shipped_kernels import shipped_processor

_CHECK_BYTES = 32


class KernelCache:
    """Machine code of an entry point for every set of argument types, one file each; numba asks it.

    Parameters
    ----------
    function : callable
        The entry point in plain Python.
    options : str
        All that it is compiled with.

    Notes
    -----
    Files appear as a whole, so that several processes may compile the same. One that is damaged or cannot be
    read counts as none, and one that cannot be written is left out. What is not in the user's folder may be
    in `shipped_root`.
    """

    def __init__(self, function: Callable[..., Any], options: str) -> None:
        self._function, self._options = function, options

    @property
    def cache_path(self) -> str:
        """Folder of the files."""
        return str(cache_root() / "kernels")

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        """Find the code for argument types; `None` where it has to be compiled."""
        target_context.refresh()
        for path in self._places(signature, target_context):
            with suppress(OSError):
                data = path.read_bytes()
                check, code = data[:_CHECK_BYTES], data[_CHECK_BYTES:]
                if hashlib.sha256(code).digest() == check:
                    payload = _Unpickler(BytesIO(code)).load()
                    return CompileResult._rebuild(target_context, *payload)
        return None

    def save_overload(self, signature: Any, result: Any) -> None:
        """Keep the code for argument types."""
        code = dumps(result._reduce())
        path = self._own_place(signature, result.target_context)
        part = path.with_name(f"{path.name}.{os.getpid()}")
        with suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True)
            try:
                part.write_bytes(hashlib.sha256(code).digest() + code)
                part.replace(path)
            finally:
                part.unlink(missing_ok=True)

    def _places(self, signature: Any, target_context: Any) -> Iterator[Path]:
        yield self._own_place(signature, target_context)
        shipped = shipped_processor()
        if shipped is not None:
            triple = target_context.codegen().magic_tuple()[0]
            yield shipped_root() / "kernels" / self._name(signature, (triple, *shipped))

    def _own_place(self, signature: Any, target_context: Any) -> Path:
        return Path(self.cache_path) / self._name(signature, target_context.codegen().magic_tuple())

    def _name(self, signature: Any, processor: tuple[str, str, str]) -> str:
        """Name the file; ``processor``: triple, name and features for which LLVM compiles."""
        kinds = signature.args if hasattr(signature, "args") else signature
        parts = (
            *(numba.__version__, llvmlite.__version__, np.__version__, sys.version),
            *(self._options, how_parts_are_compiled(), code_digest(self._function)),
            *(repr(processor), *map(spelled_type, kinds)),
        )
        key = hashlib.sha256("\n".join(parts).encode()).hexdigest()[:32]
        return f"{self._function.__name__}-{key}"


class _Unpickler(pickle.Unpickler):
    """Reads code of modules that have moved since: named tuples are found by their name alone."""

    def find_class(self, module: str, name: str) -> Any:
        """Find what a pickle names."""
        if (module, name) == (environment.__name__, environment._rebuild_env.__name__):
            return _rebuild_env
        try:
            return super().find_class(module, name)
        except (ImportError, AttributeError):
            package = module.partition(".")[0]
            for place, each in list(sys.modules.items()):
                if place.partition(".")[0] == package and name in vars(each):
                    return vars(each)[name]
            raise


def _rebuild_env(module: str, *rest: Any) -> Any:
    """Make the environment of a function, which only code that calls Python reads the module of."""
    try:
        return environment._rebuild_env(module, *rest)
    except ImportError:
        return environment._rebuild_env(__name__, *rest)
