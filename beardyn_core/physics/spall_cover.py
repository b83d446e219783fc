"""Share of each lamina that counts as lost over a patch, so that a contact loses what a half-space loses.

A lamina of a line contact is a spring of its own and loses its whole part over a hole; on a half-space the
ends next to a hole take over a part of it. What counts is a smaller share of a larger gap: share times gap
stays, which decides where the floor still presses, and a roller over a deep hole loses what
`bearing.holed_line` finds. Slices of a barrel count as they are: that line has an even load along the whole
roller, an ellipse may end within a hole.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from scipy.optimize import brentq

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.bearing.holed_line import PRESSURE, lost_share
from beardyn_core.bearing.lamina_coupling import coupled_law, joint_depth, part_exponent
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects import LaminaCoupling
from beardyn_core.effects.lamina_coupling import bearing_lamina_root
from beardyn_core.physics.lamina_table import contact_radii, lamina_places, surface_radius
from beardyn_core.scene.patch import Patch

_SMALLEST_PART = 1.0e-9  # of a lamina
_LEAST_FACTOR = 0.02  # of a cover, so that gaps stay finite
_DEEP = 1.0e-3  # a hole without a floor [m]


def lamina_cover(bearing: RollerBearing, patch: Patch, count: int) -> Float:
    """Compute the share of the length of each lamina that a patch covers, shape [lamina], [-].

    A part that is rounding is none: the surface under it does not exist.
    """
    place = lamina_places(bearing, count)
    half = 0.5 * bearing.effective_length / count
    low = np.maximum(place - half, patch.offset - 0.5 * patch.length)
    high = np.minimum(place + half, patch.offset + 0.5 * patch.length)
    cover = np.clip((high - low) / (2.0 * half), 0.0, 1.0)
    cover[cover < _SMALLEST_PART] = 0.0
    cover[cover > 1.0 - _SMALLEST_PART] = 1.0
    return np.asarray(cover)


def counted_cover(
    bearing: RollerBearing, patches: Sequence[Patch], count: int, coupling: LaminaCoupling | None
) -> Float:
    """Compute the share of each lamina that counts as lost over patches of a surface, [patch, lamina], [-].

    A roller meets the strips of one pit one after the other, the widest first: each counts for what the
    half-space loses more with it than without it. Strips that a roller does not meet together count by
    themselves, and a patch on others counts there as they do. Slices of self-aligning bearings lose all
    that is covered.

    Parameters
    ----------
    patches : sequence of Patch
        All of one surface; those of one row, and of one roller, act together.
    count : int
        Laminae.
    coupling : LaminaCoupling or None
        Coupled laminae lose less than others by themselves, and are corrected by less.
    """
    cover = np.array([lamina_cover(bearing, patch, count) for patch in patches]).reshape(-1, count)
    if bearing.self_aligning:
        return cover
    shared = _all_shared(bearing, patches, count)
    order = sorted(range(len(patches)), key=lambda index: -patches[index].width)
    counted, fresh, law = np.zeros_like(cover), np.zeros_like(cover), _lost_by_law(bearing, count, coupling)
    for place, index in enumerate(order):
        before = [each for each in order[:place] if _meet(patches[each], patches[index], bearing)]
        taken = [_interval(patches[each]) for each in before]
        wanted = _lost(bearing, [*taken, _interval(patches[index])])
        on_others = np.zeros(count)
        for each in before:
            part = np.minimum(shared[max(each, index), min(each, index)], cover[index] - on_others)
            on_others += part
            counted[index] += part * counted[each] / np.maximum(cover[each], _SMALLEST_PART)
        fresh[index] = _fitted(law, fresh[before].sum(axis=0), cover[index] - on_others, wanted)
        counted[index] += fresh[index]
    return counted


def shared_cover(bearing: RollerBearing, patches: Sequence[Patch], count: int) -> Float:
    """Compute the share of each lamina that two patches both cover, [patch, patch, lamina].

    Empty where no patches that a roller can meet lie over each other.
    """
    shared = _all_shared(bearing, patches, count)
    return shared if np.any(shared > 0.0) else np.zeros((0, 0, count))


def _all_shared(bearing: RollerBearing, patches: Sequence[Patch], count: int) -> Float:
    cover = [lamina_cover(bearing, patch, count) for patch in patches]
    shared = np.zeros((len(patches), len(patches), count))
    for first, one in enumerate(patches):
        for second, other in enumerate(patches[:first]):
            (low, high), (from_, to) = _interval(one), _interval(other)
            low, high = max(low, from_), min(high, to)
            if (one.row, one.roller) == (other.row, other.roller) and low < high:
                both = replace(one, offset=0.5 * (low + high), length=high - low)
                shared[first, second] = np.minimum(
                    lamina_cover(bearing, both, count), np.minimum(cover[first], cover[second])
                )
    return shared


def _interval(patch: Patch) -> tuple[float, float]:
    return patch.offset - 0.5 * patch.length, patch.offset + 0.5 * patch.length


def _meet(one: Patch, other: Patch, bearing: RollerBearing) -> bool:
    """Check whether a roller at the middle of a patch is over the other as well."""
    if (one.row, one.roller) != (other.row, other.roller):
        return False
    repeats = bearing.roller_count if "brinelling" in (one.kind, other.kind) else 1
    apart = math.remainder(repeats * (one.azimuth - other.azimuth), 2.0 * math.pi) / repeats
    return abs(apart) * surface_radius(bearing, one.on) < 0.5 * max(one.width, other.width)


def _lost(bearing: RollerBearing, holes: Sequence[tuple[float, float]]) -> float:
    """Take one radius for cup and cone: patches of ring and roller that meet then count alike."""
    radius = 0.5 * sum(float(contact_radii(bearing, ring, 1)[0]) for ring in ("cup", "cone"))
    return lost_share(holes, bearing.effective_length, radius, bearing.material.contact_modulus)


def _lost_by_law(
    bearing: RollerBearing, count: int, coupling: LaminaCoupling | None
) -> Callable[[Float], float]:
    """Take the share of the load that a contact loses by its law over deep holes that cover its laminae."""
    if coupling is None:
        return lambda cover: float(np.mean(cover))
    root, exponent = bearing_lamina_root(bearing, coupling, count), part_exponent(coupling.strength)
    radius = float(np.mean(contact_radii(bearing, "cup", 1)))
    half_width = 4.0 * radius * PRESSURE / bearing.material.contact_modulus
    load = math.pi * PRESSURE * half_width / 2.0 * bearing.effective_length
    factor = line_contact_factor(bearing.material, bearing.effective_length)
    depth = np.full((1, count), (load / factor) ** 0.9)
    intact = float(coupled_law(depth, factor / count, root)[0].sum())

    def lost(cover: Float) -> float:
        joint, share = joint_depth(depth, np.full((1, count), _DEEP), cover[None, :], exponent)
        carried = coupled_law(joint, factor / count, root)[0] * share
        return 1.0 - float(carried.sum()) / intact

    return lost


def _fitted(law: Callable[[Float], float], before: Float, cover: Float, wanted: float) -> Float:
    """Scale a cover so that a contact loses what it should, as far as a share of the cover can."""

    def miss(factor: float) -> float:
        return law(np.minimum(before + factor * cover, 1.0)) - wanted

    if miss(1.0) <= 0.0:
        return cover
    if miss(_LEAST_FACTOR) >= 0.0:
        return _LEAST_FACTOR * cover
    return float(brentq(miss, _LEAST_FACTOR, 1.0, xtol=1e-6)) * cover
