"""An algorithm by its name ``module:function``, and its answer."""

from __future__ import annotations

import importlib
import sys
import traceback
from math import isnan
from pathlib import Path
from typing import cast

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain.chain import REFERENCE, Algorithm
from beardyn_core.monitor.chain.fault_lines import FAULTS
from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.chain.result import VERDICTS, MonitorResult
from beardyn_core.monitor.chain.timeout import NoAnswerError, within

_CORE = Path(__file__).resolve().parents[2]
_STANDARD_LIBRARY = Path(traceback.__file__).parent
PATIENCE_S = 300.0  # with one analysis of a monitor of one's own: it may search, but a trial goes on
OURS = "beardyn_core.monitor.chain:REFERENCE"


def algorithm_named(name: str) -> Algorithm:
    """Import an algorithm by its name; the working folder is searched for the module too.

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


def answer_of(
    algorithm: Algorithm,
    stretch: Stretch,
    orders: FaultFrequencies,
    roller_count: int,
    settings: MonitorSettings,
) -> MonitorResult:
    """Call an algorithm with its arguments; a failure or a wrong answer raises an error with a sentence.

    Raises
    ------
    InputError
        It has failed, has not answered within `PATIENCE_S`, or its answer is not a `MonitorResult` that can
        be used.
    """
    if algorithm is REFERENCE:
        return algorithm(stretch, orders, roller_count, settings)
    name = f"{getattr(algorithm, '__module__', '?')}:{getattr(algorithm, '__qualname__', algorithm)}"
    try:
        result = within(PATIENCE_S, lambda: algorithm(stretch, orders, roller_count, settings))
    except NoAnswerError as error:
        sentence = f"the monitor {name} has not answered within {PATIENCE_S:g} s{_place(error.frames)}"
        raise InputError(sentence) from None
    except (Exception, SystemExit) as error:
        raise InputError(f"the monitor {name} has failed: {_failure(error)}") from error
    if not isinstance(result, MonitorResult):
        raise InputError(f"the monitor {name} answered a {type(result).__name__}; it must be a MonitorResult")
    if result.verdict not in VERDICTS:
        raise InputError(
            f"the monitor {name} answered the verdict {result.verdict!r}; allowed are {', '.join(VERDICTS)}"
        )
    if len(result.scores) != len(FAULTS):
        raise InputError(
            f"the monitor {name} answered {len(result.scores)} scores; there must be one for each of "
            f"{', '.join(FAULTS)}"
        )
    if not (isnan(result.confidence) or 0.0 <= result.confidence <= 1.0):
        raise InputError(
            f"the monitor {name} answered the confidence {result.confidence:g}; it must be 0 to 1, or NaN"
        )
    return result


def _failure(error: BaseException) -> str:
    """Write the exception, and where in the monitor's own code it was."""
    return f"{type(error).__name__}: {error}{_place(traceback.extract_tb(error.__traceback__))}"


def _place(frames: traceback.StackSummary) -> str:
    """Write the innermost line of frames that is the monitor's own code; '' without any frame beyond ours."""
    beyond = [frame for frame in frames if not Path(frame.filename).is_relative_to(_CORE)]
    own = [frame for frame in beyond if not _is_of_a_library(frame.filename)] or beyond
    return f", {own[-1].filename}, line {own[-1].lineno}, in {own[-1].name}" if own else ""


def _is_of_a_library(filename: str) -> bool:
    return "site-packages" in filename or Path(filename).is_relative_to(_STANDARD_LIBRARY)
