"""Libraries of an extra, imported when they are needed."""

from __future__ import annotations

import importlib
from typing import Any

from beardyn_core.base.errors import InputError


def missing(name: str, purpose: str, extra: str) -> list[str]:
    """Say what to install before something begins that needs a library in the end; empty when it is there.

    Parameters
    ----------
    name, purpose, extra : str
        As for `library`.
    """
    try:
        library(name, purpose, extra)
    except InputError as error:
        return error.problems
    return []


def library(name: str, purpose: str, extra: str) -> Any:
    """Import a library of an extra.

    Parameters
    ----------
    name : str
        Of the module.
    purpose : str
        What needs it, as the sentence begins.
    extra : str
        What installs it.

    Raises
    ------
    InputError
        It is not installed, or something that it needs itself.
    """
    try:
        return importlib.import_module(name)
    except (ImportError, OSError) as error:  # OSError: a library of the system is not there
        raise InputError(
            f"{purpose} needs {name.partition('.')[0]}, which is not installed ({error}); install it with: "
            f"pip install 'beardyn[{extra}]'"
        ) from error
