"""The general contact search: conditions of least distance as equations, and three ways to solve them.

P lies on body i and Q on body j, d = r_P - r_Q. A form is a list of scalar products that must vanish; it
suits a pair of shape kinds. Plain NumPy, one pair at a time; `compiled` holds the same search compiled.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from functools import partial
from typing import Annotated as A
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import fsolve

from beardyn_core.base.arrays import Float
from beardyn_core.laboratory.shapes import Frame, Shape

Method = Literal["fsolve", "numeric", "analytic"]

# rows of the table of vectors
D, T_P, B_P, N_P, T_Q, B_Q, N_Q = range(7)
ROWS = 7

TOLERANCE = 1e-11  # of a scalar product: [-], or [m] with d
MOST_ITERATIONS = 30
DIFFERENCE = 1e-7  # of a parameter for the numeric Jacobian, [rad] or [m]


@dataclass(frozen=True)
class Form:
    """One set of conditions."""

    name: str
    equations: A[tuple[tuple[int, int], ...], "pairs of rows, whose scalar products vanish"]
    signed: A[bool, "the gap is d . n_Q, negative inside the body; otherwise it is the length of d"] = True

    def encode(self) -> NDArray[np.int64]:
        """Return the equations as an array, shape [4, 2], unused rows -1."""
        found = np.full((4, 2), -1, dtype=np.int64)
        found[: len(self.equations)] = self.equations
        return found


# Eq. (3) as printed, with t along the meridian and b around the axis on both surfaces
SURFACES_PRINTED = Form("surface-surface, as printed", ((N_Q, T_P), (D, B_P), (N_P, T_Q), (D, B_Q)))
# Eq. (3) with t and b of Q exchanged
SURFACES_CROSSED = Form(
    "surface-surface, t and b of Q exchanged", ((N_Q, T_P), (D, B_P), (N_P, B_Q), (D, T_Q))
)
# parallel normals, and d along the normal of Q
SURFACES = Form("surface-surface, parallel normals", ((N_Q, T_P), (N_Q, B_P), (D, T_Q), (D, B_Q)))
# Eq. (4)
SURFACE_LINE = Form("surface-line", ((N_Q, T_P), (D, T_Q), (D, B_Q)))
# Eq. (5), first form: one displacement condition for each line
LINES = Form("line-line, least distance", ((D, T_P), (D, T_Q)), signed=False)
# Eq. (5), second form: d along the normal of Q
LINES_ALONG_NORMAL = Form("line-line, along the normal", ((D, B_Q), (D, T_Q)))
FORMS = (SURFACES_PRINTED, SURFACES_CROSSED, SURFACES, SURFACE_LINE, LINES, LINES_ALONG_NORMAL)


@dataclass(frozen=True)
class Pair:
    """Two shapes that may touch."""

    p: Shape
    q: Shape
    form: Form


@dataclass(frozen=True)
class Found:
    """What a search found."""

    parameters: A[Float, "of P, then of Q"]
    iterations: A[int, "Newton steps, or evaluations of the root finder"]
    converged: bool
    gap: A[float, "d . n_Q, or the length of d, [m]"]
    p: A[Float, "shape [3], point on P, [m]"]
    q: A[Float, "shape [3], point on Q, [m]"]


def _frames(pair: Pair, parameters: Float) -> tuple[Frame, Frame, Float]:
    """Return the frames of P and Q, and the rows d, t_P, b_P, n_P, t_Q, b_Q, n_Q, shape [ROWS, 3]."""
    cut = pair.p.parameter_count
    p, q = pair.p.frame(parameters[:cut]), pair.q.frame(parameters[cut:])
    return p, q, np.concatenate([[p.point - q.point], p.vectors, q.vectors])


def residual(pair: Pair, parameters: Float) -> Float:
    """Compute the scalar products that must vanish."""
    *_, table = _frames(pair, parameters)
    return np.array([table[a] @ table[b] for a, b in pair.form.equations])


def jacobian(pair: Pair, parameters: Float) -> Float:
    """Compute the derivatives of the residual, shape [equation, parameter]."""
    cut = pair.p.parameter_count
    p, q, table = _frames(pair, parameters)
    slopes = np.zeros((len(parameters), ROWS, 3))
    slopes[:cut, D], slopes[:cut, T_P : N_P + 1] = p.point_slopes, p.vector_slopes
    slopes[cut:, D], slopes[cut:, T_Q : N_Q + 1] = -q.point_slopes, q.vector_slopes
    return np.array([slopes[:, a] @ table[b] + slopes[:, b] @ table[a] for a, b in pair.form.equations])


def numeric_jacobian(pair: Pair, parameters: Float, here: Float) -> Float:
    """Compute the same by forward differences; ``here`` is the residual at ``parameters``."""
    found = np.empty((here.size, parameters.size))
    for i in range(parameters.size):
        moved = parameters.copy()
        moved[i] += DIFFERENCE
        found[:, i] = (residual(pair, moved) - here) / DIFFERENCE
    return found


def search(pair: Pair, start: ArrayLike, method: Method = "analytic") -> Found:
    """Solve the conditions of a pair from a start.

    Parameters
    ----------
    pair : Pair
    start : array_like
        Parameters of P, then of Q.
    method : str
        ``fsolve`` (SciPy's root finder, numeric Jacobian), ``numeric`` or ``analytic`` (Newton).
    """
    parameters = np.array(start, dtype=np.float64)
    if method == "fsolve":
        return _by_root_finder(pair, parameters)
    for iteration in range(MOST_ITERATIONS):
        here = residual(pair, parameters)
        if not np.isfinite(here).all():
            break
        if np.abs(here).max() < TOLERANCE:
            return _found_at(pair, parameters, iteration, True)
        slopes = (
            jacobian(pair, parameters) if method == "analytic" else numeric_jacobian(pair, parameters, here)
        )
        try:
            parameters = parameters - np.linalg.solve(slopes, here)
        except np.linalg.LinAlgError:
            return _found_at(pair, parameters, iteration, False)
    return _found_at(pair, parameters, MOST_ITERATIONS, False)


def _by_root_finder(pair: Pair, parameters: Float) -> Found:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # it warns of slow progress; `converged` says so here
        root, info, *_ = fsolve(partial(residual, pair), parameters, full_output=True, xtol=1e-13)
    return _found_at(pair, root, int(info["nfev"]), bool(np.abs(info["fvec"]).max() < 1e-9))


def _found_at(pair: Pair, parameters: Float, iterations: int, converged: bool) -> Found:
    with np.errstate(all="ignore"):
        p, q, table = _frames(pair, parameters)
    gap = float(table[D] @ table[N_Q]) if pair.form.signed else float(np.sqrt(table[D] @ table[D]))
    return Found(parameters, iterations, converged, gap, p.point, q.point)


def condition_number(pair: Pair, parameters: Float) -> float:
    """Return the condition number of the Jacobian; infinite where the conditions do not fix the points."""
    return float(np.linalg.cond(jacobian(pair, parameters)))
