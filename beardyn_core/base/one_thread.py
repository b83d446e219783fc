"""Linear algebra in one thread: matrices of a bearing are small, and further threads only wait."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import cache, wraps
from typing import ParamSpec, TypeVar

from threadpoolctl import ThreadpoolController

_P = ParamSpec("_P")
_R = TypeVar("_R")


def in_one_thread(function: Callable[_P, _R]) -> Callable[_P, _R]:
    """Keep the linear algebra of a function in one thread; afterwards it has as many as before."""

    @wraps(function)
    def limited(*given: _P.args, **named: _P.kwargs) -> _R:
        with _libraries("scipy.linalg" in sys.modules).limit(limits=1):
            return function(*given, **named)

    return limited


@cache
def _libraries(_with_scipy: bool) -> ThreadpoolController:
    """Find the libraries that are loaded; SciPy brings one of its own."""
    return ThreadpoolController()
