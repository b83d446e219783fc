"""Coupling of laminae through the half-space: the influence of one on the others, and the coupled law.

A lamina under load sinks the surface next to it. With the influence matrix C of the laminae, normalised, and
its inverse root W = C^(-1/2), the surface depths u of the laminae store the energy of independent laminae
at the depths e = W u::

    Phi(u) = sum_k 9/19 K |e_k|^(19/9),    E(d) = minimum of Phi(u) over u >= d

for geometric penetrations d. Where the roller touches, the surface is at the roller, u = d; elsewhere it
sinks with its neighbours and carries nothing. The load of lamina j is dE/dd_j = (W^T f)_j with
f = K |e|^(1/9) e, never a pull. For uncoupled laminae, W = 1, this is Palmgren's law lamina by lamina, for
a linear law it is the contact problem of the half-space, and a uniform approach has Palmgren's total at any
load.

A lamina that lies partly over a patch joins the others at one depth. Of a lamina the part k stands higher and
the rest a gap g below: over a hole the part next to it, at a raised rim the part on it. Alone, at the depth d
of the higher part, both are to store::

    9/19 K (k^n d^(19/9) + (1 - k^n) (d - r g)^(19/9)) = 9/19 K D^(19/9),    r = (1 - k) / (1 - k^n),

each part where it touches. The whole lamina joins the others at the depth D, so that forces stay the
gradient of an energy. With n = 1 this is Palmgren's law for each part. Next to a hole the surface sinks away,
and a short part carries more than its length of it: n < 1. r keeps the mean gap, which counts where both
touch. Near a sharp edge of the patch the kernels multiply the term of the patch's part by its firmness.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float

_SWEEPS = 200
_TOLERANCE = 1.0e-14
_LOST_EXPONENT = 0.35  # fitted to lines of 240 laminae on the half-space over holes and rims
_SMALLEST = 1.0e-12


@dataclass(frozen=True)
class LaminaRoot:
    """Matrices of coupled laminae, shape [lamina, lamina], [-]."""

    root: A[Float, "W, symmetric"]
    stiffness: A[
        Float, "W W, the normalised inverse of the influence matrix; no element off its diagonal is positive"
    ]


def rectangle_influence(
    distance: Float, length: Float | float, half_width: Float | float, contact_modulus: float
) -> Float:
    """Compute the approach of both bodies at `distance` [m] along the line from a pressed rectangle, [m/N].

    The pressure on it is uniform; `length` is along the line, `half_width` half of it across, [m], and
    `contact_modulus` E', [Pa].

    References
    ----------
    Love, A. E. H. (1929), Stress produced in a semi-infinite solid by pressure on part of the boundary,
    Phil. Trans. A 228; Johnson, K. L. (1985), Contact Mechanics, Eq. 3.25, at y = 0.
    """

    def up_to(end: Float) -> Float:
        rest: Float = half_width * np.arcsinh(end / half_width)
        return end * np.arcsinh(half_width / np.abs(end)) + rest

    integral = 2.0 * (up_to(distance + 0.5 * length) - up_to(distance - 0.5 * length))
    return integral / (math.pi * 0.5 * contact_modulus * 2.0 * half_width * length)


def lamina_root(
    count: int, length: float, radius: float, contact_modulus: float, pressure: float, strength: float = 1.0
) -> LaminaRoot:
    """Compute the matrices of a line of equal laminae.

    The line has a `length` and an equivalent `radius`, [m]; `pressure` is the Hertz pressure whose contact
    width is taken, [Pa], `strength` the factor of the influence between different laminae, [-]. Normalised so
    that a uniform approach has the total force of independent laminae: sum_k (sum_j W_kj)^(19/9) = count.

    References
    ----------
    Teutsch, R. and Sauer, B. (2004), An alternative slicing technique to consider pressure concentrations in
    non-Hertzian line contacts, ASME J. Tribol. 126, 436-442: influence of every slice on every other from
    the half-space, scaled to the total of the line contact. The energy form is this model's own.
    """
    half_width = 2.0 * radius * pressure / (0.5 * contact_modulus)
    pitch = length / count
    influence = rectangle_influence(
        pitch * np.arange(count, dtype=np.float64), pitch, half_width, contact_modulus
    )
    index = np.arange(count)
    matrix = influence[np.abs(index[:, None] - index)] / influence[0]
    matrix = np.eye(count) + strength * (matrix - np.eye(count))
    values, vectors = np.linalg.eigh(matrix)
    root = (vectors * values**-0.5) @ vectors.T
    root = 0.5 * (root + root.T)
    root *= (count / np.sum(root.sum(axis=1) ** (19.0 / 9.0))) ** (9.0 / 19.0)
    return LaminaRoot(root, root @ root)


def coupled_law(depth: Float, factor: float, laminae: LaminaRoot) -> tuple[Float, Float, Float]:
    """Compute load, tangent stiffness and energy of coupled laminae, iterated to rounding.

    Parameters
    ----------
    depth : float64 array, shape [..., lamina]
        Geometric penetration, [m].
    factor : float
        K of one lamina, [N/m^(10/9)].

    Returns
    -------
    load : float64 array, shape [..., lamina]
        [N].
    stiffness : float64 array, shape [..., lamina, lamina]
        Change of the loads with the penetrations, the unloaded surface following, [N/m].
    energy : float64 array, shape [...]
        [J].

    Notes
    -----
    First each lamina in turn is taken to where it is in balance under a linear law, given the others, which
    rises monotonically, because no stiffness off the diagonal is positive; then Newton's method on the free
    ones.
    """
    count = depth.shape[-1]
    load, energy = np.zeros(depth.shape), np.zeros(depth.shape[:-1])
    stiffness = np.zeros((*depth.shape, count))
    touching = np.max(depth, axis=-1) > 0.0
    pressed = depth[touching]
    if pressed.size:
        surface = _surface(pressed, factor, laminae)
        local, force = _springs(surface, factor, laminae.root)
        loaded = (surface <= pressed) & (pressed > 0.0)
        load[touching] = np.where(loaded, np.maximum(force @ laminae.root, 0.0), 0.0)
        stiffness[touching] = _stiffness(local, loaded, laminae.root)
        energy[touching] = (9.0 / 19.0) * np.sum(force * (surface @ laminae.root), axis=-1)
    return load, stiffness, energy


def _surface(depth: Float, factor: float, laminae: LaminaRoot) -> Float:
    """Compute the depth of the surface at every lamina of touching lines, shape [line, lamina], [m]."""
    root, own = laminae.root, np.diag(laminae.stiffness)
    follow = (laminae.stiffness - np.diag(own)) / own[:, None]
    surface = np.maximum(depth, 0.0)
    for _ in range(3):
        for j in range(len(root)):
            surface[:, j] = np.maximum(depth[:, j], -(surface @ follow[j]))
    scale = np.max(surface, axis=-1, keepdims=True)
    for _ in range(_SWEEPS):
        local, force = _springs(surface, factor, root)
        load = force @ root
        free = surface > depth
        pulled = ~free & (load < 0.0)
        if not np.any(free | pulled):
            break
        hessian = (10.0 / 9.0) * (root * local[:, None, :]) @ root
        # Newton on the free laminae, each held where it would leave the roller's surface behind
        matrix = np.where(free[:, :, None] & free[:, None, :], hessian, np.eye(len(root)) * factor)
        step = np.linalg.solve(matrix, np.where(free, load, 0.0)[..., None])[..., 0]
        moved = np.maximum(surface - step, depth)
        # a lamina that would be pulled lets go
        diagonal = np.diagonal(hessian, axis1=-2, axis2=-1)
        moved = np.where(pulled, surface - load / diagonal, moved)
        settled = np.abs(moved - surface) <= _TOLERANCE * scale
        surface = moved
        if np.all(settled):
            break
    return surface


def _springs(surface: Float, factor: float, root: Float) -> tuple[Float, Float]:
    """Compute the secant stiffness and force of the independent laminae at W u."""
    depth = surface @ root
    local = factor * np.maximum(np.abs(depth), 1.0e-15) ** (1.0 / 9.0)
    return local, local * depth


def _stiffness(local: Float, loaded: NDArray[np.bool_], root: Float) -> Float:
    """Compute the tangent of the loads: inverse of the compliance among the loaded laminae."""
    inverse = np.linalg.inv(root)
    compliance = (inverse * (0.9 / local)[..., None, :]) @ inverse
    both = loaded[..., :, None] & loaded[..., None, :]
    isolated = np.where(both, compliance, np.eye(root.shape[0]) * compliance.max(initial=1.0e-12))
    tangent: Float = np.where(both, np.linalg.inv(isolated), 0.0)
    return tangent


def part_exponent(strength: float) -> float:
    """Compute the exponent n of the higher part of a lamina, for a strength of the coupling, [-]."""
    return 1.0 - _LOST_EXPONENT * strength


def joint_depth(depth: Float, gap: Float, cover: Float, exponent: float) -> tuple[Float, Float]:
    """Compute the depth D of laminae of which a patch covers a part.

    Parameters
    ----------
    depth, gap : float64 arrays, shape [..., lamina]
        Geometric penetration next to the patch; by which it is less over it, negative on a raised rim, [m].
    cover : float64 array, shape [..., lamina]
        Part of each lamina's length that the patch takes, [-].
    exponent : float
        From `part_exponent`.

    Returns
    -------
    joint, share : float64 arrays, shape [..., lamina]
        D, [m]; its slope over the depth: the part of its load that a lamina presses with, [-].
    """
    kept = np.clip(np.where(gap < 0.0, cover, 1.0 - cover), 0.0, 1.0)
    held = kept**exponent
    loose = np.maximum(1.0 - held, _SMALLEST)
    higher = depth - np.minimum(gap, 0.0)
    lower = np.maximum(higher - (1.0 - kept) / loose * np.abs(gap), 0.0)
    higher = np.maximum(higher, 0.0)
    energy = held * higher ** (19.0 / 9.0) + loose * lower ** (19.0 / 9.0)
    force = held * higher ** (10.0 / 9.0) + loose * lower ** (10.0 / 9.0)
    pressed = energy > 0.0
    some = np.where(pressed, energy, 1.0)
    joint = np.where(pressed, some ** (9.0 / 19.0), np.minimum(depth - cover * gap, 0.0))
    share = np.where(pressed, force * some ** (-10.0 / 19.0), 1.0)
    return np.where(cover > 0.0, joint, depth), np.where(cover > 0.0, share, 1.0)
