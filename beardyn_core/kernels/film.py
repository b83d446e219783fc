"""Elastohydrodynamic film of a raceway line contact."""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.bearing.oil_layer import TRANSITION
from beardyn_core.kernels.lane_math import at_least, at_most, exp2, log2, log2_one_plus_exp2, magnitude
from beardyn_core.model.layout import LAMINA_FILM

_LOG2_LIGHTEST = -9.965784284662087  # 1 mN
_LOG2_THICKEST_RIGID_FILM = -13.287712379549449  # 0.1 mm, where an unloaded roller has no contact any more


@inline
def log2_entrainment(speed, film):
    """Work out what the film needs of the entrainment speed, once per contact.

    Returns ``speed_part``: speed part of the film thickness with the heating of the inlet [log2
    (m/s)^exponent]; ``log2_rolling``: the speed itself, not below 1 mm/s [log2 m/s].
    """
    log2_rolling = log2(magnitude(speed) + 1e-3)
    if film is None:
        return 0.0, log2_rolling
    return film.speed_exponent * log2_rolling + log2_thermal_factor(log2_rolling, film.thermal), log2_rolling


@inline
def log2_thermal_factor(log2_rolling, thermal):
    """Take log2 of the film reduction by inlet heating, 1 / (1 + c L^n), L = eta beta u^2 / k."""
    if thermal is None:
        return 0.0
    log2_loading = thermal.log2_loading + 2.0 * log2_rolling
    # log2(1) takes off the error that the logarithm has there, so that no heating is exactly none
    return log2(1.0) - log2(1.0 + thermal.coefficient * exp2(thermal.exponent * log2_loading))


@inline
def log2_load(load):
    """Work out the binary logarithm of the load of a lamina, not below that of 1e-12 N, [log2 N]."""
    return log2(at_least(load, 1e-12))


@inline
def log2_film_thickness(log2_force, log2_speed, lamina, ring, laminae, film):
    """Work out the binary logarithm of the film thickness of one lamina, [log2 m].

    Power law in speed and load, the rest of the formula is in the lamina table; with the guard of rigid
    surfaces the thicker of both films; thinner where there is too little oil. Loads below 1 mN are treated as
    1 mN.

    References
    ----------
    `beardyn_core.bearing.film_thickness` for the formulas.
    """
    if film is None:
        return 0.0
    bounded = at_least(log2_force, _LOG2_LIGHTEST)
    elastic = log2_speed[0] + film.load_exponent * bounded + laminae[LAMINA_FILM + ring, lamina]
    flooded = thicker_film(elastic, bounded, log2_speed[1], lamina, ring, film.rigid)
    return starved_film(flooded, log2_speed[1], film.layer)


@inline
def thicker_film(elastic, load_log2, log2_rolling, lamina, ring, rigid):
    """Take the elastohydrodynamic film, or that of rigid surfaces where it is thicker, [log2 m].

    References
    ----------
    Martin (1916): H = 4.9 U / W.
    """
    if rigid is None:
        return elastic
    film = log2_rolling - load_log2 + rigid.log2_factor[ring, lamina]
    return at_least(elastic, at_most(film, _LOG2_THICKEST_RIGID_FILM))


@inline
def starved_film(flooded, log2_rolling, layer):
    """Thin a flooded film to what a layer of oil leaves of it, [log2 m], within 4e-5 of the formula.

    References
    ----------
    Chevalier et al. (1998), see `bearing.oil_layer`.
    """
    if layer is None:
        return flooded
    ratio = flooded - layer.log2_thickness - layer.speed_exponent * log2_rolling
    return flooded - (1.0 / TRANSITION) * log2_one_plus_exp2(TRANSITION * ratio)


@inline
def film_output(load, log2_speed, ring, laminae, film):
    """Work out the film thickness of the middle lamina under the mean lamina load, [m]; 0 without a film."""
    if film is None:
        return 0.0
    middle = laminae.shape[1] // 2
    share = log2_load(load / laminae.shape[1])
    return exp2(log2_film_thickness(share, log2_speed, middle, ring, laminae, film))
