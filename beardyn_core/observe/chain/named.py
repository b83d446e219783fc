"""An algorithm by its name ``module:function``."""

from __future__ import annotations

import importlib
import sys
from typing import cast

from beardyn_core.errors import InputError
from beardyn_core.observe.chain.chain import REFERENCE, Algorithm

OURS = "beardyn_core.observe.chain:REFERENCE"


def algorithm_named(name: str) -> Algorithm:
    """Find the algorithm of a name; the working folder is searched for the module too.

    Parameters
    ----------
    name : str
        ``module:function``, where the function may be a `Chain`; '' for the reference chain.

    Raises
    ------
    InputError
        When there is no such module or function, or it cannot be called.
    """
    if not name or name == OURS:
        return REFERENCE
    module_name, colon, member = name.partition(":")
    if not (module_name and colon and member):
        raise InputError(f"{name!r} is no algorithm; write module:function, such as my_monitor:chain")
    if "" not in sys.path:
        sys.path.insert(0, "")
    try:
        module = importlib.import_module(module_name)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{module_name}.".startswith(f"{error.name}."):
            raise InputError(f"{name!r}: the module {module_name} needs {error.name}, not found") from None
        raise InputError(
            f"{name!r}: there is no module {module_name}; it must lie in the working folder or on PYTHONPATH"
        ) from None
    except Exception as error:
        raise InputError(f"{name!r}: the module {module_name} cannot be imported: {error!r}") from None
    if not hasattr(module, member):
        raise InputError(f"{name!r}: the module {module_name} has no {member}")
    found = getattr(module, member)
    if not callable(found) or isinstance(found, type):
        raise InputError(
            f"{name!r}: {member} is a {type(found).__name__}; it must be a function "
            "(stretch, orders, roller_count, settings) -> MonitorResult, or a Chain"
        )
    return cast(Algorithm, found)
