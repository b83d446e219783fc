"""The 6x6 system of one roller: velocity change under linearly implicit contacts.

Matrices are the lower triangle of a symmetric 6x6 as a tuple of 21 lane values, row by row; the unknowns
are three velocities and three angular velocities.
"""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.physics.lanes.vectors import Twist, add_scaled, cross, scale


@inline
def inertia_matrix(mass, axial, transverse, axis, zero):
    """Fill the matrix with mass and inertia of a body of revolution with unit axis `axis`."""
    d = axial - transverse
    x, y, z = axis
    m = mass + zero
    return (
        m,
        zero, m,
        zero, zero, m,
        zero, zero, zero, transverse + d * x * x,
        zero, zero, zero, d * x * y, transverse + d * y * y,
        zero, zero, zero, d * x * z, d * y * z, transverse + d * z * z,
    )  # fmt: skip


@inline
def add_line(matrix, direction, arm, arm_slope, weights):
    """Add contacts along a line that resist the velocity in one direction.

    ``direction``: unit direction of the resistance; ``arm``, ``arm_slope``: contact at abscissa x from the
    centre of mass: ``arm + x arm_slope``; ``weights`` (3 numbers): sums of the resistance with x^0, x^1, x^2,
    [N s/m], times the step.
    """
    k0, k1, k2 = weights
    p = cross(arm, direction)
    r = cross(arm_slope, direction)
    b, c = add_scaled(scale(k0, p), k1, r), add_scaled(scale(k1, p), k2, r)
    return _add_blocks(matrix, direction, scale(k0, direction), b, p, c, r)


@inline
def add_twists(matrix, level, slope, weights):
    """Add contacts along a line whose direction and lever change along it.

    ``level``, ``slope`` (2 vectors): at abscissa x a velocity v and an angular velocity w are resisted where
    v . (level[0] + x slope[0]) + w . (level[1] + x slope[1]) is not 0; ``weights``: as in `add_line`.
    """
    k0, k1, k2 = weights
    d, p, e, r = level[0], level[1], slope[0], slope[1]
    a, b = add_scaled(scale(k0, d), k1, e), add_scaled(scale(k1, d), k2, e)
    f, g = add_scaled(scale(k0, p), k1, r), add_scaled(scale(k1, p), k2, r)
    m = matrix
    return (
        m[0] + (a[0] * d[0] + b[0] * e[0]),
        m[1] + (a[1] * d[0] + b[1] * e[0]), m[2] + (a[1] * d[1] + b[1] * e[1]),
        m[3] + (a[2] * d[0] + b[2] * e[0]), m[4] + (a[2] * d[1] + b[2] * e[1]),
        m[5] + (a[2] * d[2] + b[2] * e[2]),
        m[6] + (f[0] * d[0] + g[0] * e[0]), m[7] + (f[0] * d[1] + g[0] * e[1]),
        m[8] + (f[0] * d[2] + g[0] * e[2]), m[9] + (f[0] * p[0] + g[0] * r[0]),
        m[10] + (f[1] * d[0] + g[1] * e[0]), m[11] + (f[1] * d[1] + g[1] * e[1]),
        m[12] + (f[1] * d[2] + g[1] * e[2]), m[13] + (f[1] * p[0] + g[1] * r[0]),
        m[14] + (f[1] * p[1] + g[1] * r[1]),
        m[15] + (f[2] * d[0] + g[2] * e[0]), m[16] + (f[2] * d[1] + g[2] * e[1]),
        m[17] + (f[2] * d[2] + g[2] * e[2]), m[18] + (f[2] * p[0] + g[2] * r[0]),
        m[19] + (f[2] * p[1] + g[2] * r[1]), m[20] + (f[2] * p[2] + g[2] * r[2]),
    )  # fmt: skip


@inline
def add_point(matrix, direction, arm, weight):
    """Add one contact that resists the velocity in one direction; arguments as in `add_line`."""
    p = cross(arm, direction)
    force, b = scale(weight, direction), scale(weight, p)
    m, d = matrix, direction
    return (
        m[0] + force[0] * d[0],
        m[1] + force[1] * d[0], m[2] + force[1] * d[1],
        m[3] + force[2] * d[0], m[4] + force[2] * d[1], m[5] + force[2] * d[2],
        m[6] + b[0] * d[0], m[7] + b[0] * d[1], m[8] + b[0] * d[2], m[9] + b[0] * p[0],
        m[10] + b[1] * d[0], m[11] + b[1] * d[1], m[12] + b[1] * d[2],
        m[13] + b[1] * p[0], m[14] + b[1] * p[1],
        m[15] + b[2] * d[0], m[16] + b[2] * d[1], m[17] + b[2] * d[2],
        m[18] + b[2] * p[0], m[19] + b[2] * p[1], m[20] + b[2] * p[2],
    )  # fmt: skip


@inline
def add_line_everywhere(matrix, arm, arm_slope, weights):
    """Add contacts along a line that resist the velocity in every direction; arguments as in `add_line`.

    The sum of `add_line` over three orthogonal directions: with r = arm + x arm_slope the force block is
    w 1, the mixed one w [r], the rotary one w (r.r 1 - r r).
    """
    k0, k1, k2 = weights
    a, s = arm, arm_slope
    u, v = add_scaled(scale(k0, a), k1, s), add_scaled(scale(k1, a), k2, s)
    return _add_everywhere(matrix, k0, u, a, v, s)


@inline
def add_point_everywhere(matrix, arm, weight):
    """Add one contact that resists the velocity in every direction; arguments as in `add_line`."""
    nothing = (0.0, 0.0, 0.0)
    return _add_everywhere(matrix, weight, scale(weight, arm), arm, nothing, nothing)


@inline
def _add_everywhere(m, weight, u, a, v, s):
    xx = u[0] * a[0] + v[0] * s[0]
    yy = u[1] * a[1] + v[1] * s[1]
    zz = u[2] * a[2] + v[2] * s[2]
    return (
        m[0] + weight,
        m[1], m[2] + weight,
        m[3], m[4], m[5] + weight,
        m[6], m[7] - u[2], m[8] + u[1], m[9] + (yy + zz),
        m[10] + u[2], m[11], m[12] - u[0], m[13] - (u[1] * a[0] + v[1] * s[0]), m[14] + (xx + zz),
        m[15] - u[1], m[16] + u[0], m[17], m[18] - (u[2] * a[0] + v[2] * s[0]),
        m[19] - (u[2] * a[1] + v[2] * s[1]), m[20] + (xx + yy),
    )  # fmt: skip


@inline
def add_couple(matrix, direction, weight):
    """Add a rotary damper about one direction; `weight` is its coefficient times the step."""
    m = matrix
    x, y, z = direction
    b = scale(weight, direction)
    return (
        m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9] + b[0] * x,
        m[10], m[11], m[12], m[13] + b[1] * x, m[14] + b[1] * y,
        m[15], m[16], m[17], m[18] + b[2] * x, m[19] + b[2] * y, m[20] + b[2] * z,
    )  # fmt: skip


@inline
def _add_blocks(m, d, force, b, p, c, r):
    return (
        m[0] + force[0] * d[0],
        m[1] + force[1] * d[0], m[2] + force[1] * d[1],
        m[3] + force[2] * d[0], m[4] + force[2] * d[1], m[5] + force[2] * d[2],
        m[6] + b[0] * d[0], m[7] + b[0] * d[1], m[8] + b[0] * d[2], m[9] + b[0] * p[0] + c[0] * r[0],
        m[10] + b[1] * d[0], m[11] + b[1] * d[1], m[12] + b[1] * d[2],
        m[13] + b[1] * p[0] + c[1] * r[0], m[14] + b[1] * p[1] + c[1] * r[1],
        m[15] + b[2] * d[0], m[16] + b[2] * d[1], m[17] + b[2] * d[2],
        m[18] + b[2] * p[0] + c[2] * r[0], m[19] + b[2] * p[1] + c[2] * r[1],
        m[20] + b[2] * p[2] + c[2] * r[2],
    )  # fmt: skip


@inline
def solve(matrix, right):
    """Solve the symmetric positive definite 6x6 system by L D L^T: the `Twist` that changes the motion."""
    (
        a00, a10, a11, a20, a21, a22, a30, a31, a32, a33, a40,
        a41, a42, a43, a44, a50, a51, a52, a53, a54, a55,
    ) = matrix  # fmt: skip
    f0, f1, f2, f3, f4, f5 = right
    i0 = 1.0 / a00
    l10, l20, l30, l40, l50 = a10 * i0, a20 * i0, a30 * i0, a40 * i0, a50 * i0
    a11 = a11 - l10 * a10
    a21, a31, a41, a51 = a21 - l20 * a10, a31 - l30 * a10, a41 - l40 * a10, a51 - l50 * a10
    a22 = a22 - l20 * a20
    a32, a42, a52 = a32 - l30 * a20, a42 - l40 * a20, a52 - l50 * a20
    a33 = a33 - l30 * a30
    a43, a53 = a43 - l40 * a30, a53 - l50 * a30
    a44 = a44 - l40 * a40
    a54 = a54 - l50 * a40
    a55 = a55 - l50 * a50
    i1 = 1.0 / a11
    l21, l31, l41, l51 = a21 * i1, a31 * i1, a41 * i1, a51 * i1
    a22 = a22 - l21 * a21
    a32, a42, a52 = a32 - l31 * a21, a42 - l41 * a21, a52 - l51 * a21
    a33 = a33 - l31 * a31
    a43, a53 = a43 - l41 * a31, a53 - l51 * a31
    a44 = a44 - l41 * a41
    a54 = a54 - l51 * a41
    a55 = a55 - l51 * a51
    i2 = 1.0 / a22
    l32, l42, l52 = a32 * i2, a42 * i2, a52 * i2
    a33 = a33 - l32 * a32
    a43, a53 = a43 - l42 * a32, a53 - l52 * a32
    a44 = a44 - l42 * a42
    a54 = a54 - l52 * a42
    a55 = a55 - l52 * a52
    i3 = 1.0 / a33
    l43, l53 = a43 * i3, a53 * i3
    a44 = a44 - l43 * a43
    a54 = a54 - l53 * a43
    a55 = a55 - l53 * a53
    i4 = 1.0 / a44
    l54 = a54 * i4
    a55 = a55 - l54 * a54
    f1 = f1 - l10 * f0
    f2 = f2 - l20 * f0 - l21 * f1
    f3 = f3 - l30 * f0 - l31 * f1 - l32 * f2
    f4 = f4 - l40 * f0 - l41 * f1 - l42 * f2 - l43 * f3
    f5 = f5 - l50 * f0 - l51 * f1 - l52 * f2 - l53 * f3 - l54 * f4
    x5 = f5 / a55
    x4 = f4 * i4 - l54 * x5
    x3 = f3 * i3 - l43 * x4 - l53 * x5
    x2 = f2 * i2 - l32 * x3 - l42 * x4 - l52 * x5
    x1 = f1 * i1 - l21 * x2 - l31 * x3 - l41 * x4 - l51 * x5
    x0 = f0 * i0 - l10 * x1 - l20 * x2 - l30 * x3 - l40 * x4 - l50 * x5
    return Twist((x0, x1, x2), (x3, x4, x5))
