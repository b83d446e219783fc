"""The temperature rule: an axlebox is hot by its temperature, or by how fast it warms."""

from __future__ import annotations

from math import isnan

from beardyn_core.observe.chain.settings import MonitorSettings

UNKNOWN, NORMAL, WARM, HOT = "unknown", "normal", "warm", "hot"


def temperature_state(temperature: float, heating: float, settings: MonitorSettings) -> str:
    """Judge the temperature: ``unknown``, ``normal``, ``warm`` or ``hot``.

    Parameters
    ----------
    temperature : float
        Of the axlebox, NaN when unknown, [K].
    heating : float
        Its rise, NaN when unknown, [K/s].

    References
    ----------
    EN 15437-2 (2012), Axlebox condition monitoring, part 2: on-board systems alarm on temperature, with
    levels of the vehicle's own. Those of `MonitorSettings` are assumed.
    """
    if isnan(temperature):
        return UNKNOWN
    if temperature >= settings.hot:
        return HOT
    if temperature >= settings.heating_floor and heating >= settings.heating:
        return HOT
    return WARM if temperature >= settings.warm else NORMAL
