"""Libraries of finite elements, which a machine may lack."""

from __future__ import annotations

import importlib

import pytest


def need_finite_elements() -> None:
    """Skip a test or a module where gmsh, the graphics libraries that it loads, or scikit-fem are missing."""
    for name in ("gmsh", "skfem"):
        try:
            importlib.import_module(name)
        except (ImportError, OSError) as error:
            pytest.skip(f"{name}: {error}", allow_module_level=True)
