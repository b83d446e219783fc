"""Profile of the roller generator: how far its surface drops below the straight cone."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from numpy.typing import ArrayLike

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import At

PROFILE_KINDS = ("straight", "crowned", "logarithmic", "lundberg", "johns_gohar", "iso_16281", "fujiwara")
# The logarithm is singular at the very end of the contact; the drop is held constant beyond this abscissa.
_LARGEST_SQUARED_ABSCISSA = 1.0 - 1.0e-6
# ISO/TS 16281: rollers longer than this many diameters have a straight middle.
_ISO_LONG_ROLLER = 2.5
_ISO_SHORT_FACTOR, _ISO_LONG_FACTOR = 0.00035, 0.0005
# Gauss points over one lamina, drawn to its ends so that the singular end of a logarithm costs nothing.
_GAUSS_NODES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(32)
_MEAN_NODES = 0.5 * _GAUSS_NODES * (3.0 - _GAUSS_NODES**2)
_MEAN_WEIGHTS = 1.5 * _GAUSS_WEIGHTS * (1.0 - _GAUSS_NODES**2)

_DESIGN = ("design_pressure_MPa", "design_load_kN")
# kind: keys it needs, keys of which it needs one, keys it may have
_KEYS_OF_KIND: dict[str, tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]] = {
    "straight": ((), (), ()),
    "crowned": (("drop_um",), (), ()),
    "logarithmic": (("design_pressure_MPa",), (), ()),
    "lundberg": ((), _DESIGN, ()),
    "johns_gohar": ((), _DESIGN, ()),
    "iso_16281": ((), (), ("design_pressure_MPa",)),
    "fujiwara": (("drop_um",), _DESIGN, ("load_factor", "crowned_share")),
}


@dataclass(frozen=True)
class Profile:
    """Generator profile of the rollers, against both raceways.

    ``crowned`` is a circular crown; ``lundberg`` logarithmic with a uniform pressure at the design load, and
    ``logarithmic`` the same by design pressure only; ``johns_gohar`` Lundberg's, finite at the very end;
    ``iso_16281`` the profile function of the standard, with its straight middle when the roller is longer
    than 2.5 diameters; ``fujiwara`` logarithmic with a straight middle and a given end drop.

    Notes
    -----
    One profile serves both raceways, so pressure and load per length are related by the radius of the roller,
    which lies between the equivalent radii at the cup and at the cone.
    """

    kind: A[str, At(one_of=PROFILE_KINDS), "law of the drop along the generator"] = "straight"
    drop: A[
        float | None,
        At("um", ge=0.0, lt=1000.0),
        "crowned, fujiwara: drop at the ends of the effective length",
    ] = None
    design_pressure: A[
        float | None,
        At("MPa", gt=0.0, le=10000.0),
        "contact pressure that the profile makes uniform; iso_16281 without it is the standard's "
        "own function, Lundberg's for 3000 MPa",
    ] = None
    design_load: A[
        float | None,
        At("kN", gt=0.0),
        "lundberg, johns_gohar, fujiwara: load of one contact, instead of the pressure",
    ] = None
    load_factor: A[float | None, At(gt=0.0), "fujiwara: K1, factor of the design load; 1"] = None
    crowned_share: A[
        float | None, At(gt=0.0, le=1.0), "fujiwara: K2, share of the generator that is crowned; 1"
    ] = None

    def rules(self) -> Iterator[str]:
        """Check that the profile has the numbers that its kind needs, and no other; report one mistake."""
        needed, one_of, optional = _KEYS_OF_KIND[self.kind]
        values = {
            "drop_um": self.drop,
            "design_pressure_MPa": self.design_pressure,
            "design_load_kN": self.design_load,
            "load_factor": self.load_factor,
            "crowned_share": self.crowned_share,
        }
        given = [key for key, value in values.items() if value is not None]
        foreign = [key for key in given if key not in (*needed, *one_of, *optional)]
        lacking = [key for key in needed if key not in given]
        chosen = [key for key in one_of if key in given]
        if foreign:
            yield f"gives {foreign[0]}, which a {self.kind} profile does not have; remove it"
        elif lacking:
            yield f"has no {lacking[0]}; a {self.kind} profile needs it"
        elif one_of and len(chosen) != 1:
            found = "both" if chosen else "neither"
            yield f"gives {found} of {' and '.join(one_of)}; a {self.kind} profile needs one"
        elif self.kind in ("crowned", "fujiwara") and self.drop == 0.0:
            yield f"gives drop_um 0; a {self.kind} profile needs a drop above 0"

    def drop_at(
        self, x: ArrayLike, half_length: float, roller_diameter: float, contact_modulus: float = 226.4e9
    ) -> Float:
        """Compute the drop of the roller surface along the generator, positive away from the raceway, [m].

        Parameters
        ----------
        x : array_like
            Abscissa from mid-length, [m].
        half_length, roller_diameter : float
            Half of the effective length; mean, [m].
        contact_modulus : float
            E' of the contact, [Pa].

        References
        ----------
        Lundberg, G. (1939), Elastische Beruehrung zweier Halbraeume: P = q/(pi E*) ln(1/(1 - (2x/L)^2)).
        Johns, P. M. and Gohar, R. (1981), Roller bearings under radial and eccentric loads, Tribology Int.
        14: (2x/L)^2 there times 1 - 0.3033 b/a, b half-width of the contact, a half of its length.
        ISO/TS 16281:2008: P = 0.00035 D ln(1/(1 - (2x/L)^2)) up to L = 2.5 D; for longer rollers 0 in the
        middle and P = 0.0005 D ln(1/(1 - ((2|x| - (L - 2.5 D))/(2.5 D))^2)) beyond.
        Fujiwara, H. and Kawase, T. (2007), Logarithmic profiles of rollers in roller bearings and
        optimization of the profiles, NTN Technical Review 75: P = K1 A ln(1/(1 - (1 - exp(-zm/(K1 A)))
        ((|x| - a)/(K2 a) + 1)^2)), A = q/(pi E*).
        """
        share = np.abs(np.asarray(x, dtype=np.float64)) / half_length
        radius, modulus = 0.5 * roller_diameter, 0.5 * contact_modulus
        if self.kind == "straight":
            return np.zeros_like(share)
        if self.kind == "crowned":
            return (self.drop or 0.0) * share**2
        if self.kind == "iso_16281":
            # Lundberg's at the design pressure, for a short roller
            pressure = self.design_pressure
            scale = 1.0 if pressure is None else (pressure / modulus) ** 2 / (2.0 * _ISO_SHORT_FACTOR)
            return scale * _iso_drop(share, 2.0 * half_length, roller_diameter)
        # per length, q = Q/L or pi R p0^2 / E*
        if self.design_load is not None:
            load = self.design_load / (2.0 * half_length)
        else:
            load = math.pi * radius * (self.design_pressure or 0.0) ** 2 / modulus
        scale = load / (math.pi * modulus)
        if self.kind in ("logarithmic", "lundberg"):
            return scale * _logarithm(share**2)
        if self.kind == "johns_gohar":
            half_width = math.sqrt(4.0 * load * radius / (math.pi * modulus))
            return scale * _logarithm((1.0 - 0.3033 * half_width / half_length) * share**2)
        if self.kind == "fujiwara":
            scale *= self.load_factor or 1.0
            crowned = np.maximum((share - 1.0) / (self.crowned_share or 1.0) + 1.0, 0.0)
            return scale * _logarithm(-np.expm1(-(self.drop or 0.0) / scale) * crowned**2)
        raise ValueError(f"profile kind is {self.kind!r}; allowed are {', '.join(PROFILE_KINDS)}")

    def lamina_drop(
        self, count: int, length: float, roller_diameter: float, contact_modulus: float = 226.4e9
    ) -> Float:
        """Drop of each of `count` equal laminae of a generator of `length`: its mean over the lamina, [m].

        Notes
        -----
        A lamina's load is nearly proportional to its mean approach. The drop at its middle would leave out
        the steep end of a logarithm: 0.31 q/(pi E*) of the last lamina, however many there are, 17 % of the
        drop of the last of eight.
        """
        pitch = length / count
        place = ((np.arange(count) + 0.5) / count - 0.5) * length
        inside = place[:, None] + 0.5 * pitch * _MEAN_NODES
        drop = self.drop_at(inside, 0.5 * length, roller_diameter, contact_modulus)
        mean: Float = 0.5 * drop @ _MEAN_WEIGHTS
        return mean


def _logarithm(squared: Float) -> Float:
    """Compute ln(1/(1 - s)), held constant where s gets too near 1."""
    result: Float = -np.log1p(-np.minimum(squared, _LARGEST_SQUARED_ABSCISSA))
    return result


def _iso_drop(share: Float, length: float, roller_diameter: float) -> Float:
    """Compute the profile function of ISO/TS 16281 at a share of the half length, [m]."""
    if length <= _ISO_LONG_ROLLER * roller_diameter:
        return _ISO_SHORT_FACTOR * roller_diameter * _logarithm(share**2)
    curved = _ISO_LONG_ROLLER * roller_diameter
    beyond = np.maximum(share * length - (length - curved), 0.0) / curved
    return _ISO_LONG_FACTOR * roller_diameter * _logarithm(beyond**2)
