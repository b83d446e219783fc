"""Static equilibria that the tests of the choice share: a choice asks for the same ones again and again.

The solver is a pure function. Choices of one scene for other accuracies or quantities need the same
equilibria, and of one choice all time steps that have the same laminae.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from beardyn_core.choice import statics
from beardyn_core.integrate import step_choice
from beardyn_core.integrate.static import StaticSolution, solve


def remembering(function: Callable[..., StaticSolution]) -> Callable[..., StaticSolution]:
    """Keep what a function gives for equal arguments; an error is not kept."""
    known: dict[bytes, StaticSolution] = {}

    def look_up(*arguments: Any, **named: Any) -> StaticSolution:
        key = pickle.dumps((arguments, sorted(named.items())))
        if key not in known:
            known[key] = function(*arguments, **named)
        return known[key]

    return look_up


@contextmanager
def equilibria_kept() -> Iterator[None]:
    """Let choices share their equilibria."""
    with pytest.MonkeyPatch.context() as patched:
        kept = remembering(solve)
        patched.setattr(statics, "solve", kept)
        patched.setattr(step_choice, "solve", kept)
        yield
