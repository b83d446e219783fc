"""Quaternions x, y, z, w in arrays."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float


def quaternion_product(a: Float, b: Float) -> Float:
    """Product of quaternions, shape [..., 4]: the turn `b` followed by `a`."""
    vector = a[..., 3:] * b[..., :3] + b[..., 3:] * a[..., :3] + np.cross(a[..., :3], b[..., :3])
    scalar = a[..., 3:] * b[..., 3:] - np.sum(a[..., :3] * b[..., :3], axis=-1, keepdims=True)
    return np.concatenate([vector, scalar], axis=-1)


def first_axis(quaternion: Float) -> Float:
    """Direction of the body's x axis, that of a roller, shape [..., 3]."""
    x, y, z, w = np.moveaxis(quaternion, -1, 0)
    return np.stack([1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)], axis=-1)
