"""Versions of what computed a run."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version


def versions() -> dict[str, str]:
    """By name: this package and what its numbers may depend on."""
    return {name: _version(name) for name in ("beardyn", "numba", "numpy")}


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "source"
