"""Versions of what computed a run."""

from __future__ import annotations

from contextlib import suppress
from importlib.metadata import PackageNotFoundError, version


def versions() -> dict[str, str]:
    """Collect versions by name, of this package and what its numbers depend on; ``source``: not installed."""
    found = dict.fromkeys(("beardyn", "numba", "numpy"), "source")
    for name in found:
        with suppress(PackageNotFoundError):
            found[name] = version(name)
    return found
