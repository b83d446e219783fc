"""How surprising lines would be in noise: the tail of their sum, and the threshold of a stated rate."""

from __future__ import annotations

from functools import cache
from math import exp, inf, log, pi, sqrt

import numpy as np
from scipy.optimize import brentq
from scipy.special import log_ndtr  # scipy.stats takes long to import

# lines a resolution apart are correlated by the window, and peaks lie between them
PLACES_PER_RESOLUTION = 3.0
_LARGEST_TOTAL = 300.0  # passed by noise once in e^300 places
_LARGEST_SUM = 1e6  # as far as the saddle point is found


@cache
def score_threshold(lines: int, places: float, rate: float) -> float:
    """Compute the score that noise exceeds somewhere at the false-alarm rate.

    Parameters
    ----------
    lines : int
        Of the pattern, L.
    places : float
        Independent places where the pattern is sought.
    rate : float
        [-].

    Returns
    -------
    float
        [dB].
    """
    wanted = min(log(rate / places), log_tail(lines, lines))
    total = brentq(lambda total: log_tail(total, lines) - wanted, lines, lines + _LARGEST_TOTAL)
    return float(10.0 * np.log10(total / (lines - 1)))


def evidence(total: float, lines: int, places: float) -> float:
    """Compute the evidence of a sum of lines less the largest against chance, [nat].

    That is minus the logarithm of how often noise has more somewhere; -inf below the mean of noise.
    ``places`` is the number of independent places that were searched.
    """
    return -log_tail(min(total, _LARGEST_SUM), lines) - log(places) if total > lines else -inf


def trimmed_tail(total: float, lines: int) -> float:
    """Compute the probability that L exponentials of mean 1, less the largest, sum to more than a total."""
    return exp(log_tail(total, lines))


def log_tail(total: float, lines: int) -> float:
    """Compute the logarithm of `trimmed_tail`, also where that is no number any more.

    The total is beyond the mean of the sum.

    References
    ----------
    Renyi (1953), On the theory of order statistics, Acta Math. Acad. Sci. Hung. 4: the representation.
    Lugannani, Rice (1980), Saddle point approximation for the distribution of the sum of independent
    random variables, Adv. Appl. Prob. 12: the tail.
    """
    means = 1.0 - 1.0 / np.arange(2.0, lines + 1.0)
    saddle = float(
        brentq(lambda t: np.sum(means / (1.0 - t * means)) - total, 1e-9, (1.0 - 1e-9) / means.max())
    )
    cumulant = -float(np.sum(np.log1p(-saddle * means)))
    signed = sqrt(2.0 * (saddle * total - cumulant))
    scaled = saddle * sqrt(float(np.sum((means / (1.0 - saddle * means)) ** 2)))
    log_density = -0.5 * signed**2 - 0.5 * log(2.0 * pi)
    mills = exp(float(log_ndtr(-signed)) - log_density)
    return log_density + log(mills + 1.0 / scaled - 1.0 / signed)
