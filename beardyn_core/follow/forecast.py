"""What remains: mileage until a spall is too wide, and the share of the rating life that loads have used."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite, nan, pi
from typing import TYPE_CHECKING
from typing import Annotated as A

import numpy as np

from beardyn_core.bearing.any_bearing import with_play
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.follow.estimator import Estimate, Estimates
from beardyn_core.follow.growth import GrowthLaw, PowerLaw, drawn_between, other_laws
from beardyn_core.follow.rated_life import RatedLife, usual_play
from beardyn_core.follow.service import Service
from beardyn_core.sensors.labels import HEALTHY

if TYPE_CHECKING:
    from beardyn_core.physics.statics.rating_life import LoadClass, RatingLife

_DRAWS, _SEED = 4000, 1
_QUANTILES = (0.05, 0.5, 0.95)
_NOTHING = (0.0, 0.0, 0.0)  # remaining mileage of a spall that must come out now
_USUAL_TEMPERATURE = 333.15
SOON = 1.0e6  # [m], below which a forecast counts as now
WIDEST_FORECAST = 20.0e-3  # width from which no mileage is given: the spall must come out, [m]; assumed


@dataclass(frozen=True)
class Forecast:
    """What remains of a bearing."""

    condition: A[str, "of the bearing"]
    widest: A[float, "width at which it is taken out, [m]"]
    remaining: A[tuple[float, float, float], "mileage to it, 5, 50 and 95 of 100; NaN without a spall, [m]"]
    equivalent_load: A[float, "P of ISO 281 at the estimated load; NaN where it is not known, [N]"]
    life: A[float, "L10 of ISO 281 at that load, [m]"]
    reference_life: A[float, "L10r of ISO 16281, from the load distribution, [m]"]
    used: A[
        tuple[float, float, float],
        "share of L10r that is used, least, likely, most; NaN unknown",
    ]
    rated: A[RatedLife | None, "rating life under a load that is known, with intervals"] = None
    other_laws: A[
        Mapping[str, tuple[float, float, float]],
        "the same mileage by other laws of growth, by their names; empty without one",
    ] = field(default_factory=dict)

    @property
    def sentences(self) -> list[str]:
        """Write it in lines."""
        lines = []
        if self.remaining == _NOTHING:
            limit = 1e3 * _limit(self.widest)
            lines.append(
                f"spall of the {self.condition}: can be wider than {limit:.3g} mm already: take it out now; "
                "no mileage is given"
            )
        elif isfinite(self.remaining[1]):
            low, middle, high = (f"{each / 1e3:,.0f}" for each in self.remaining)
            when = "take it out now" if self.remaining[0] < SOON else "by then it must come out"
            lines.append(
                f"spall of the {self.condition}: {1e3 * self.widest:.0f} mm wide in {middle} km, 90 % "
                f"interval {low} to {high} km; {when}"
            )
            if self.other_laws:
                others = ", ".join(
                    f"{name} {middle / 1e3:,.0f} km ({low / 1e3:,.0f} to {high / 1e3:,.0f})"
                    for name, (low, middle, high) in self.other_laws.items()
                )
                lines.append(f"by other laws of growth with the same rate at the critical area: {others}")
        elif self.condition != HEALTHY:
            lines.append(
                f"spall of the {self.condition}: how wide it can be is not known, so no mileage is given"
            )
        if self.rated is not None:
            return [*lines, *self.rated.sentences]
        if isfinite(self.life):
            lines.append(
                f"rating life at {1e-3 * self.equivalent_load:.1f} kN: {self.life / 1e9:.2f} million km (ISO "
                f"281), {self.reference_life / 1e9:.2f} (ISO 16281), which one in ten bearings does not reach"
            )
        else:
            lines.append("rating life: the load is not known")
        if isfinite(self.used[1]):
            low, middle, high = (f"{100 * each:.1f}" for each in self.used)
            lines.append(f"used of it so far: {middle} %, {low} to {high} % for the load's interval of 90 %")
        return lines


def forecast(
    found: Estimates,
    bearing: RollerBearing,
    lubricant: Lubricant,
    service: Service,
    law: GrowthLaw | None = None,
    rated: RatedLife | None = None,
) -> Forecast:
    """Forecast what remains from estimates of load, end play and spall.

    Parameters
    ----------
    found : Estimates
    bearing : RollerBearing
        Whose rating life and roller distance count.
    lubricant : Lubricant
        Of the rating life.
    service : Service
    law : GrowthLaw, optional
    rated : RatedLife, optional
        Under a load that is known; it takes the place of lives at the estimated load.

    Notes
    -----
    Width and rate of growth are drawn from their distributions. The length of a spall, across the raceway, is
    drawn from its interval, or from the lengths learnt from where it is not identifiable; it stays while the
    spall grows along the raceway. A spall whose interval reaches 20 mm, or the end of what was learnt from,
    has no mileage left: its width is known too badly for one. The load of the stretches stands for the
    whole mileage.
    """
    law = law or GrowthLaw()
    condition = HEALTHY if found.part is None else found.part.condition
    widest = service.widest or min(WIDEST_FORECAST, pi * bearing.pitch_diameter / bearing.roller_count)
    remaining, others = _remaining(found, widest, law)
    if rated is not None:
        return Forecast(
            condition,
            widest,
            remaining,
            rated.equivalent_load[1],
            rated.basic[1],
            rated.reference_basic[1],
            rated.used_basic,
            rated,
            others,
        )
    classes = [_class_of(found, k) for k in range(3)]
    life = [None if each is None else _life_of(each, found, bearing, lubricant) for each in classes]
    around = pi * service.wheel_diameter
    likely = life[1]
    used = [nan if each is None else service.revolutions / each.reference_basic for each in life]
    return Forecast(
        condition,
        widest,
        remaining,
        nan if likely is None else likely.equivalent_load,
        nan if likely is None else likely.basic * around,
        nan if likely is None else likely.reference_basic * around,
        (used[0], used[1], used[2]) if service.mileage else (nan, nan, nan),
        other_laws=others,
    )


Mileages = tuple[float, float, float]


def _remaining(found: Estimates, widest: float, law: GrowthLaw) -> tuple[Mileages, dict[str, Mileages]]:
    """Draw mileages until the spall is too wide; give their quantiles, and those by other laws, [m]."""
    width = _estimate(found, "width")
    length = _estimate(found, "length")
    if width is not None and _must_come_out(width, widest):
        return _NOTHING, {}
    if width is None or not isfinite(width.value) or length is None or not length.intervals:
        return (nan, nan, nan), {}
    random = np.random.default_rng(_SEED)
    across = drawn_between(length.intervals[-1], _DRAWS, random)
    area = across * drawn_between(width.intervals[-1], _DRAWS, random)
    rates = law.rates(_DRAWS, random)

    def mileages(grows: GrowthLaw | PowerLaw) -> Mileages:
        low, middle, high = np.quantile(grows.distance(area, across * widest, rates), _QUANTILES).tolist()
        return low, middle, high

    return mileages(law), {name: mileages(each) for name, each in other_laws(law).items()}


def _must_come_out(width: Estimate, widest: float) -> bool:
    """Tell whether a width reaches the one from which no mileage is left, or is 10 mm at least."""
    reaches = isfinite(width.value) and width.intervals[-1][1] >= _limit(widest)
    return reaches or width.at_least >= min(widest, 0.5 * WIDEST_FORECAST)


def _limit(widest: float) -> float:
    """Give the width from which no mileage is left, [m]."""
    return min(widest, WIDEST_FORECAST)


def _estimate(found: Estimates, name: str) -> Estimate | None:
    return next((each for each in found.quantities if each.quantity.name == name), None)


def _class_of(found: Estimates, which: int) -> LoadClass | None:
    """Take the load at the low end, the middle or the high end of its interval; `None`: not known."""
    from beardyn_core.physics.statics.rating_life import LoadClass  # brings the compiler along

    vertical, lateral = _estimate(found, "vertical_load"), _estimate(found, "lateral_load")
    if vertical is None or not isfinite(vertical.value):
        return None
    low, high = vertical.intervals[-1]
    size = (low, vertical.value, high)[which]
    sideways = 0.0 if lateral is None or not isfinite(lateral.value) else lateral.value
    return LoadClass(1.0, (0.0, sideways, size), (0.0, 0.0, 0.0), 2.0 * pi * found.shaft_frequency)


def _life_of(
    load: LoadClass, found: Estimates, bearing: RollerBearing, lubricant: Lubricant
) -> RatingLife | None:
    """Compute the rating life at a load, temperature and play as estimated where they are."""
    from beardyn_core.physics.statics.rating_life import rating_life

    warm, play = _estimate(found, "temperature"), _estimate(found, "end_play")
    known = usual_play(bearing) if play is None or not isfinite(play.value) else play.value
    fitted, end_play = with_play(bearing, known)
    return rating_life(
        fitted, (load,), lubricant,
        _USUAL_TEMPERATURE if warm is None or not isfinite(warm.value) else warm.value,
        end_play=end_play, tilt="locked",
    )  # fmt: skip
