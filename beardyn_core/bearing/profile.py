"""Profile of the roller generator: how far its surface drops below the straight cone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

PROFILE_KINDS = ("straight", "crowned", "logarithmic")
# The logarithm is singular at the very end of the contact; the drop is held constant beyond this abscissa.
_LARGEST_SQUARED_ABSCISSA = 1.0 - 1.0e-6


@dataclass(frozen=True)
class Profile:
    """Profile of the roller against both raceways.

    Parameters
    ----------
    kind : str
        ``straight``, ``crowned`` (circular crown) or ``logarithmic`` (Lundberg).
    drop : float
        Drop of a crowned generator at the ends of the effective length, [m].
    design_pressure : float
        Line-contact pressure for which a logarithmic profile gives a uniform load along the
        generator, [Pa]. About 3.0 GPa reproduces the profile function of ISO/TS 16281.
    """

    kind: str = "straight"
    drop: float = 0.0
    design_pressure: float = 0.0

    def drop_at(
        self,
        x: ArrayLike,
        half_length: float,
        roller_diameter: float,
        contact_modulus: float = 226.4e9,
    ) -> NDArray[np.float64]:
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
        Lundberg, G. (1939), Elastische Beruehrung zweier Halbraeume: P = q/(pi E*) ln(1/(1 - (2x/L)^2)),
        written here with q = pi R p0^2 / E* and R the roller radius.
        """
        squared = np.square(np.asarray(x, dtype=np.float64) / half_length)
        if self.kind == "straight":
            return np.zeros_like(squared)
        if self.kind == "crowned":
            return self.drop * squared
        if self.kind == "logarithmic":
            scale = 0.5 * roller_diameter * (self.design_pressure / (0.5 * contact_modulus)) ** 2
            return -scale * np.log1p(-np.minimum(squared, _LARGEST_SQUARED_ABSCISSA))
        raise ValueError(f"profile kind is {self.kind!r}; allowed are {', '.join(PROFILE_KINDS)}")
