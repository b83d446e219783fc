"""Says which Python packages of a distribution are too old, instead of an import that fails somewhere.

rosdep installs what the distribution has: numba 0.56 and pydantic 1.10 in Debian 12, for one.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from re import match

# what the code cannot do without, from setup.py: first version, and the first that is too new
NEEDED: dict[str, tuple[str, str | None]] = {
    "numba": ("0.68", "0.69"),
    "numpy": ("1.26", None),
    "pydantic": ("2.7", None),
    "rosbags": ("0.11", "0.12"),
    "scipy": ("1.13", None),
}


def requirement(name: str) -> str:
    """Write what pip needs to install a package: ``numba>=0.68,<0.69``."""
    first, beyond = NEEDED[name]
    return f"{name}>={first}" + (f",<{beyond}" if beyond else "")


def missing_requirements(installed: Callable[[str], str] = version) -> list[str]:
    """List in sentences what is missing, too old or too new, and what to do.

    Parameters
    ----------
    installed : callable
        Gives the version of a package by its name; `PackageNotFoundError` when there is none.
    """
    found = []
    for name, (first, beyond) in NEEDED.items():
        try:
            have = installed(name)
        except PackageNotFoundError:
            found.append(f"{name} is not installed")
            continue
        number = _number(have)
        if number < _number(first):
            found.append(f"{name} {have} is too old")
        elif beyond and number >= _number(beyond):
            found.append(f"{name} {have} is too new")
    if not found:
        return []
    needs = " ".join(f"'{requirement(name)}'" for name in NEEDED)
    return [
        *found,
        "the packages of this distribution do not do: make a virtual environment that sees the sourced ROS 2 "
        f"(python3 -m venv --system-site-packages DIR) and install there: DIR/bin/pip install {needs}; "
        "docs/quality.md says more",
    ]


def _number(text: str) -> tuple[int, ...]:
    found = match(r"\d+(\.\d+)*", text)
    return tuple(int(part) for part in found[0].split(".")) if found else (0,)
