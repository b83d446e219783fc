"""Profile of the roller generator: how far its surface drops below the straight cone."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Float = NDArray[np.float64]

PROFILE_KINDS = (
    "straight",
    "crowned",
    "logarithmic",
    "lundberg",
    "johns_gohar",
    "iso_16281",
    "fujiwara",
)
# The logarithm is singular at the very end of the contact; the drop is held constant beyond this abscissa.
_LARGEST_SQUARED_ABSCISSA = 1.0 - 1.0e-6
# ISO/TS 16281: rollers longer than this many diameters have a straight middle.
_ISO_LONG_ROLLER = 2.5
_ISO_SHORT_FACTOR, _ISO_LONG_FACTOR = 0.00035, 0.0005
# Gauss points over one lamina, drawn to its ends so that the singular end of a logarithm costs nothing.
_GAUSS_NODES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(32)
_MEAN_NODES = 0.5 * _GAUSS_NODES * (3.0 - _GAUSS_NODES**2)
_MEAN_WEIGHTS = 1.5 * _GAUSS_WEIGHTS * (1.0 - _GAUSS_NODES**2)


@dataclass(frozen=True)
class Profile:
    """Profile of the roller against both raceways.

    Parameters
    ----------
    kind : str
        ``straight``; ``crowned`` (circular crown); ``lundberg`` (logarithmic, uniform pressure at the design
        load); ``logarithmic`` (the same, by design pressure only); ``johns_gohar`` (Lundberg's, finite at
        the very end); ``iso_16281`` (profile function of the standard, with its straight middle when the
        roller is longer than 2.5 diameters); ``fujiwara`` (logarithmic with a straight middle and a given
        end drop).
    drop : float
        Drop at the ends of the effective length, ``crowned`` and ``fujiwara``, [m].
    design_pressure : float
        Line-contact pressure for which a logarithmic profile gives a uniform load along the generator, 0 when
        it is not given, [Pa]. ``iso_16281``: scales the standard's function, which is Lundberg's for
        3.0 GPa on a short steel roller; 0 leaves it as it is.
    design_load : float
        Load of one contact instead of the pressure, 0 when it is not given, [N].
    load_factor : float
        ``fujiwara``: K1, factor of the design load.
    crowned_share : float
        ``fujiwara``: K2, share of the generator that is crowned; the middle is straight.

    Notes
    -----
    One profile serves both raceways, so pressure and load per length are related by the radius of the roller,
    which lies between the equivalent radii at the cup and at the cone.
    """

    kind: str = "straight"
    drop: float = 0.0
    design_pressure: float = 0.0
    design_load: float = 0.0
    load_factor: float = 1.0
    crowned_share: float = 1.0

    def drop_at(
        self,
        x: ArrayLike,
        half_length: float,
        roller_diameter: float,
        contact_modulus: float = 226.4e9,
    ) -> Float:
        """Profile drop along the generator.

        Parameters
        ----------
        x : array_like
            Abscissa from mid-length, [m].
        half_length : float
            Half of the effective length, [m].
        roller_diameter : float
            Mean roller diameter, [m].
        contact_modulus : float
            E' of the contact, [Pa].

        Returns
        -------
        float64 array, shape of `x`
            Drop of the roller surface, positive away from the raceway, [m].

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
            return self.drop * share**2
        if self.kind == "iso_16281":
            return self._iso_scale(modulus) * _iso_drop(share, 2.0 * half_length, roller_diameter)
        load = self._line_load(half_length, radius, modulus)
        scale = load / (math.pi * modulus)
        if self.kind in ("logarithmic", "lundberg"):
            return scale * _logarithm(share**2)
        if self.kind == "johns_gohar":
            half_width = math.sqrt(4.0 * load * radius / (math.pi * modulus))
            return scale * _logarithm((1.0 - 0.3033 * half_width / half_length) * share**2)
        if self.kind == "fujiwara":
            scale *= self.load_factor
            crowned = np.maximum((share - 1.0) / self.crowned_share + 1.0, 0.0)
            return scale * _logarithm(-np.expm1(-self.drop / scale) * crowned**2)
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

    def _line_load(self, half_length: float, radius: float, modulus: float) -> float:
        """Design load per length, q = Q/L or pi R p0^2 / E*, [N/m]."""
        if self.design_load > 0.0:
            return self.design_load / (2.0 * half_length)
        return math.pi * radius * self.design_pressure**2 / modulus

    def _iso_scale(self, modulus: float) -> float:
        """Factor of the standard's function: that of Lundberg's at the design pressure on a short roller."""
        if self.design_pressure == 0.0:
            return 1.0
        return (self.design_pressure / modulus) ** 2 / (2.0 * _ISO_SHORT_FACTOR)


def _logarithm(squared: Float) -> Float:
    """ln(1/(1 - s)), held constant where s gets too near 1."""
    result: Float = -np.log1p(-np.minimum(squared, _LARGEST_SQUARED_ABSCISSA))
    return result


def _iso_drop(share: Float, length: float, roller_diameter: float) -> Float:
    """Profile function of ISO/TS 16281 at a share of the half length, [m]."""
    if length <= _ISO_LONG_ROLLER * roller_diameter:
        return _ISO_SHORT_FACTOR * roller_diameter * _logarithm(share**2)
    curved = _ISO_LONG_ROLLER * roller_diameter
    beyond = np.maximum(share * length - (length - curved), 0.0) / curved
    return _ISO_LONG_FACTOR * roller_diameter * _logarithm(beyond**2)
