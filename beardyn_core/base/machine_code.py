"""What the machine code of a kernel comes from, as a digest: neither how it is written down nor where.

A function counts by its bytecode, its constants and all that it reads or calls, directly or not; a named
tuple by its name and its fields. Docstrings, comments, the names of files and what only Python runs do not
count. What reaches numba by registration, such as lane values, is not called by name: a module with such
functions counts whole, and so do the modules that it takes something from.
"""

from __future__ import annotations

import ast
import dis
import hashlib
import inspect
import sys
from collections.abc import Callable, Iterable, Iterator
from enum import Enum
from functools import cache
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np
from numba.core import types
from numba.core.dispatcher import Dispatcher

# whose version stands for them in the name of a kernel
_LIBRARIES = {"numba", "llvmlite", "numpy", *sys.stdlib_module_names}

_PLAIN = (bool, int, float, complex, str, bytes, type(None), type(Ellipsis), np.dtype, np.generic)


def code_digest(function: Callable[..., Any]) -> str:
    """Hash all that the machine code of a function may come from but the types it is compiled for.

    Parameters
    ----------
    function : callable
        In plain Python; all that it reads is followed, but for numba, NumPy and what comes with Python.

    Raises
    ------
    TypeError
        When a function reads an object of which it is not known how it reaches machine code.
    """
    return _READER.function(function)


@cache
def how_parts_are_compiled() -> str:
    """Hash the module that makes numba compile parts of kernels."""
    return _READER.module(sys.modules["beardyn_core.base.jit"])


def spelled_type(kind: Any) -> str:
    """Spell the type of an argument, with the fields of named tuples and the source of types of one's own."""
    if isinstance(kind, (types.NamedTuple, types.NamedUniTuple)):
        members = (
            f"{name}: {spelled_type(each)}" for name, each in zip(kind.fields, kind.types, strict=True)
        )
        return f"{kind.instance_class.__name__}({', '.join(members)})"
    if isinstance(kind, (types.Tuple, types.UniTuple)):
        return f"({', '.join(map(spelled_type, kind.types))})"
    if isinstance(kind, types.Optional):
        return f"{spelled_type(kind.type)} or none"
    home = type(kind).__module__
    return f"{kind} of {_READER.module(sys.modules[home])}" if _is_followed(home) else str(kind)


class _Reader:
    """Reads functions; what it has read it remembers."""

    def __init__(self) -> None:
        self._functions: dict[Callable[..., Any], str] = {}

    def function(self, function: Callable[..., Any]) -> str:
        """Hash a function and what it reads and calls; one that calls itself counts by its name there."""
        if function not in self._functions:
            self._functions[function] = f"again {function.__name__}"
            self._functions[function] = _hash_parts(self._of_function(function))
        return self._functions[function]

    def _of_function(self, function: Any) -> Iterator[str]:
        yield from self._code(function.__code__, function.__globals__)
        yield from map(self.value, function.__defaults__ or ())
        for name, value in sorted((function.__kwdefaults__ or {}).items()):
            yield f"{name} = {self.value(value)}"
        for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
            yield f"{name} = {self.value(cell.cell_contents)}"

    def _code(self, code: CodeType, names: dict[str, Any]) -> Iterator[str]:
        yield " ".join(code.co_varnames[: code.co_argcount + code.co_kwonlyargcount])
        for each in dis.get_instructions(code):
            yield each.opname
            if isinstance(each.argval, CodeType):
                yield from self._code(each.argval, names)
            elif each.opname == "LOAD_GLOBAL" and each.argval in names:
                yield f"{each.argval} = {self._read(names[each.argval], code.co_names)}"
            elif each.opcode in dis.hasconst:
                yield self.value(each.argval)
            else:
                yield str(each.argval)

    def _read(self, value: Any, names: Iterable[str]) -> str:
        """Spell what a function reads; of a module what it may read there."""
        if not isinstance(value, ModuleType) or not _is_followed(value.__name__):
            return self.value(value)
        found = {name: vars(value)[name] for name in names if name in vars(value)}
        return ", ".join(f"{name} = {self._read(each, names)}" for name, each in found.items())

    def value(self, value: Any) -> str:
        """Spell a constant, or what stands for a function, a class or a module."""
        if isinstance(value, _PLAIN):
            return f"{type(value).__name__} {value!r}"
        if isinstance(value, np.ndarray):
            return f"{value.dtype} {value.shape} {_hash_parts([value.tobytes().hex()])}"
        if isinstance(value, (frozenset, set)):
            return f"{{{', '.join(sorted(map(self.value, value)))}}}"
        if isinstance(value, (tuple, list)):
            name = f"{type(value).__name__}{getattr(value, '_fields', '')}"
            return f"{name}({', '.join(map(self.value, value))})"
        if isinstance(value, dict):
            return f"{{{', '.join(f'{self.value(k)}: {self.value(v)}' for k, v in value.items())}}}"
        if isinstance(value, Enum):
            return f"{type(value).__name__}.{value.name} = {self.value(value.value)}"
        if isinstance(value, Dispatcher):
            options = self.value(dict(sorted(value.targetoptions.items())))
            return f"{options} {self.function(value.py_func)}"
        return self._name_of(value)

    def _name_of(self, value: Any) -> str:
        name = value.__name__ if isinstance(value, ModuleType) else getattr(value, "__module__", None) or ""
        if not _is_followed(name):
            return (
                f"{name}.{getattr(value, '__qualname__', getattr(value, '__name__', type(value).__name__))}"
            )
        if isinstance(value, type) and issubclass(value, tuple) and hasattr(value, "_fields"):
            return f"{value.__name__}{value._fields} {self.value(vars(value)['_field_defaults'])}"
        if isinstance(value, type) and issubclass(value, Enum):
            return self.value(dict(value.__members__))
        if isinstance(value, (FunctionType, type, ModuleType, BuiltinFunctionType)):
            return self.module(sys.modules[name])
        raise TypeError(f"{value!r} of {name} is read by a kernel: how it reaches machine code is not known")

    @cache  # noqa: B019  a reader lives as long as the program
    def module(self, module: ModuleType) -> str:
        """Hash a whole module, and those that it takes something from."""
        waiting, reached = [module], dict[str, str]()
        while waiting:
            each = waiting.pop()
            if each.__name__ not in reached:
                reached[each.__name__] = _hash_parts(self._of_module(each))
                waiting += self._taken_from(each)
        return _hash_parts(sorted(reached.values()))

    def _of_module(self, module: ModuleType) -> Iterator[str]:
        tree = ast.parse(inspect.getsource(module))
        # state, which changes while the program runs: no constant of a kernel
        state = {name for node in ast.walk(tree) if isinstance(node, ast.Global) for name in node.names}
        yield _without_words(tree)
        for name, value in sorted(vars(module).items()):
            if isinstance(value, _PLAIN) and not name.startswith("__") and name not in state:
                yield f"{name} = {self.value(value)}"

    def _taken_from(self, module: ModuleType) -> Iterator[ModuleType]:
        for value in vars(module).values():
            name = value.__name__ if isinstance(value, ModuleType) else getattr(value, "__module__", None)
            if isinstance(name, str) and _is_followed(name) and name in sys.modules:
                yield sys.modules[name]


_READER = _Reader()


def _is_followed(module: str) -> bool:
    """Whether a module counts by what is in it and not by its name."""
    source = getattr(sys.modules.get(module), "__file__", None) or ""
    return module.partition(".")[0] not in _LIBRARIES and source.endswith(".py")


def _hash_parts(parts: Iterable[str]) -> str:
    digest = hashlib.sha256()
    for part in parts:
        digest.update(part.encode())
        digest.update(b"\n")
    return digest.hexdigest()[:32]


def _without_words(tree: ast.Module) -> str:
    """Dump the syntax of a module without docstrings, imports and places."""
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if isinstance(body, list):
            node.body = [each for each in body if not _is_word(each)]  # type: ignore[attr-defined]
    return ast.dump(tree)


def _is_word(node: ast.AST) -> bool:
    text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    return text or isinstance(node, (ast.Import, ast.ImportFrom))
