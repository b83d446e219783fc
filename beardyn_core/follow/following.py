"""Follow one bearing: what each stretch says, put together with what was known, as it changes."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import isfinite, log
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.follow.condition import ConditionBelief
from beardyn_core.follow.conditioning import VERTICAL, condition_estimates, estimate_of
from beardyn_core.follow.cubature_filter import Belief, correct_belief, predict_belief
from beardyn_core.follow.estimator import (
    AS_WIDE,
    ELSEWHERE,
    UNLIKE,
    Estimate,
    Estimates,
    Estimator,
    within_learnt,
)
from beardyn_core.follow.forecast import SOON, Forecast, forecast
from beardyn_core.follow.growth import NORMAL_90, GrowthLaw
from beardyn_core.follow.known_load import KnownLoad
from beardyn_core.follow.life_assumptions import LifeAssumptions
from beardyn_core.follow.load_checks import AxleLoads
from beardyn_core.follow.quantities import BY_NAME, Quantity
from beardyn_core.follow.rated_life import LifeCounter, RatedLife
from beardyn_core.follow.service import Service
from beardyn_core.sensors.labels import HEALTHY

SPALLED, TAKE_OUT, UNEXPLAINED, WAITING = "spalled", "take_out", "unexplained", "waiting"
NORMAL_50 = 0.6745
_MINUTE, _HOUR, _YEAR = 60.0, 3600.0, 3.2e7
# how long a number takes to wander over the range learnt from, [s]; a spall grows by its law alone
_WANDERS = {"vertical_load": _MINUTE, "lateral_load": _MINUTE, "temperature": _HOUR, "end_play": _HOUR}
_LEAST_SHARED = 0.5  # of the error: stretches of one run have load, speed and track in common too; assumed
_LEAST_OWN = 0.5  # of the error's variance, that is every stretch's own
_JUMP, _JUMP_STRETCHES = 3.0, 2  # standard deviations, and stretches in a row on one side: a step
_KEPT = 0.8  # of the surprise so far, at each stretch
_SURPRISING = 4.0  # mean square miss from which what is measured does not fit what was known
_FEWEST = 2  # stretches before anything is said
_FAR = 2.0  # strangeness of one stretch that counts at once
_LATE = 5  # stretches whose middle strangeness says whether the box is another one: one in twenty is strange
_NOT_HEARD = "not identifiable from the stretches so far: the interval is as wide as the range learnt from"


@dataclass(frozen=True, eq=False)
class Followed:
    """What is known of a bearing after a stretch."""

    time: A[float, "end of the stretch, [s]"]
    distance: A[float, "since the first one, [m]"]
    estimates: A[Estimates, "of the filter"]
    received: A[Estimates, "of this stretch alone"]
    names: A[tuple[str, ...], "of the numbers of the covariance"]
    covariance: A[Float, "shape [number, number], on the scales of learning; see `Quantity.scaled`"]
    rate: A[tuple[float, float], "growth of the spall: median, and factor that holds 90 %, [m^2/m]; NaN"]
    surprise: A[float, "mean square of the misses of late, in variances of what was expected; 1 is usual"]
    changed: A[tuple[str, ...], "numbers that have made a step"]
    remains: A[Forecast | None, "of a whole bearing; none of bearing data alone"]
    health: A[str, "waiting, healthy, spalled, take_out or unexplained"]
    doubts: A[tuple[str, ...], "what the model does not explain, in sentences"]

    @property
    def sentence(self) -> str:
        """Say it in a line."""
        part = self.estimates.part
        words = [f"{self.time:9.2f} s  {self.health:11}"]
        if part is not None:
            words.append(f"{part.condition} {100 * part.probability:3.0f} %")
        for each in self.estimates.quantities:
            if isfinite(each.value):
                show, (low, high) = each.quantity.text, each.intervals[-1]
                words.append(f"{each.quantity.name} {show(each.value)} ({show(low)} to {show(high)})")
        words += [f"{BY_NAME[name].words} has changed" for name in self.changed]
        return "; ".join([*words, *self.doubts])


@dataclass
class Follower:
    """Filter on the slow numbers of one bearing.

    Notes
    -----
    Each stretch is an observation of every number that the estimator has, as wide as its interval. Part of
    its error stays with bearing and box, and part with the run: they are numbers of their own in the filter,
    which no repetition takes away, so that the intervals do not shrink to nothing. Another recording has
    another part of the run (`begin`), and the same one of bearing and box. Loads, end play
    and temperature wander; the width of a spall grows by `GrowthLaw` with a rate that is learnt. A number
    missed by three standard deviations twice in a row on one side has made a step, and is learnt anew.
    The filter is written out here: prediction by cubature points, correction in closed form, as every
    observation is linear. A library (filterpy) would have brought the same two functions without missing
    observations.
    """

    estimator: Estimator
    bearing: A[RollerBearing | None, "for what remains; none of bearing data alone"] = None
    lubricant: A[Lubricant | None, "of the rating life"] = None
    service: A[Service, "mileage at the first stretch, wheel"] = field(default_factory=Service)
    law: A[GrowthLaw, "of spalls"] = field(default_factory=GrowthLaw)
    axle_loads: A[AxleLoads | None, "that the vehicle can have, against which a known load is checked"] = None
    assumptions: A[LifeAssumptions, "of the rating life under a known load"] = field(
        default_factory=LifeAssumptions
    )
    temperature: A[tuple[float, float] | None, "of the lubricant, ends of 90 %, [K]; none: assumed"] = None
    stretches: A[int, "so far"] = 0

    def __post_init__(self) -> None:
        known = self.estimator.card["quantities"]
        self.names = tuple(name for name in BY_NAME if name in self.estimator.regressions)
        ends = [BY_NAME[name].scaled(np.array(known[name]["ranges"][-1])) for name in self.names]
        self._middle = np.array([each.mean() for each in ends])
        self._spread = np.array([np.ptp(each) / (2.0 * NORMAL_90) for each in ends])
        unexplained = np.array([1.0 - known[name]["explained"] for name in self.names])
        shared = np.array([known[name].get("shared", _LEAST_SHARED) for name in self.names])
        # of the errors' variance, what bearing and box have in all recordings, and what a run adds
        whole = unexplained * self._spread**2
        kept, added = np.clip(shared, 0.0, 1.0) * whole, np.maximum(_LEAST_SHARED - shared, 0.0) * whole
        self._common = kept + added
        self._grows = {"width", "length"} <= set(self.names)
        rate = [(log(self.law.rate), log(self.law.rate_spread) / NORMAL_90)] if self._grows else []
        mean = np.concatenate([self._middle, np.zeros(2 * len(self.names)), [each[0] for each in rate]])
        variance = np.concatenate([self._spread**2, added, kept, [each[1] ** 2 for each in rate]])
        self._unknown = self.belief = Belief(mean, np.diag(variance))
        rule = self.estimator.part
        self.condition = None if rule is None else ConditionBelief(rule.conditions)
        self._aside = np.zeros(len(self.names))  # stretches in a row that missed, with their side
        self._surprise, self._time, self._distance = 1.0, 0.0, 0.0
        self._is_to_come_out = False
        self._strange: list[float] = []  # strangeness of the latest stretches
        self._known: KnownLoad | None = None
        self._is_new_load = self._is_new_run = True
        self._counter = (
            None
            if self.bearing is None or self.lubricant is None
            else LifeCounter(self.bearing, self.lubricant, self.service.wheel_diameter, self.assumptions)
        )

    def know_load(self, load: KnownLoad | None) -> None:
        """Take the vertical load as known from now on, until another one is; none: not known any more."""
        self._is_new_load = self._is_new_load or load != self._known
        self._known = load

    def begin(self) -> None:
        """Begin another recording: load, end play, temperature and what a run adds may all be others by now.

        They are as unknown as at first. Condition, spall, its rate of growth and what bearing and box add
        stay as they are believed.
        """
        count = len(self.names)
        wander = [k for k, name in enumerate(self.names) if name in _WANDERS]
        opened = [*wander, *range(count, 2 * count)]
        mean, covariance = self.belief.mean.copy(), self.belief.covariance.copy()
        mean[opened] = self._unknown.mean[opened]
        covariance[opened, :] = covariance[:, opened] = 0.0
        covariance[opened, opened] = np.diag(self._unknown.covariance)[opened]
        self.belief = Belief(mean, covariance)
        self._aside[:] = 0.0
        self._is_new_load = self._is_new_run = True

    def take(self, descriptors: Float, time: float, distance: float = 0.0) -> Followed:
        """Take a stretch.

        Parameters
        ----------
        descriptors : float64 array, shape [descriptor]
        time : float
            Of its end, [s].
        distance : float
            That the wheel has run since the first stretch, [m].
        """
        received = self.estimator.estimates(descriptors[None])
        self._strange = [*self._strange, received.strangeness][-_LATE:]
        self._carry(
            max(time - self._time, 0.0) if self.stretches else 0.0, max(distance - self._distance, 0.0)
        )
        self._time, self._distance = time, distance
        if self.condition is not None and self.estimator.part is not None:
            chances = self.estimator.part.probabilities(self.estimator.standardise(descriptors[None]))[0]
            self.condition.take(dict(zip(self.condition.conditions, chances.tolist(), strict=True)))
        self._condition_on_load()
        changed = self._correct(received)
        self.stretches += 1
        known = self._estimates(received)
        service = replace(self.service, mileage=self.service.mileage + distance)
        law = self._law()
        rated = self._rate(known, service.mileage)
        remains = (
            None
            if self.bearing is None or self.lubricant is None
            else forecast(known, self.bearing, self.lubricant, service, law, rated)
        )
        doubts = self._doubts()
        against = () if known.known_load is None else known.known_load.doubts
        count = len(self.names)
        return Followed(
            time, distance, known, received, self.names, self.belief.covariance[:count, :count].copy(),
            (law.rate, law.rate_spread) if self._grows else (np.nan, np.nan),
            self._surprise, changed, remains, self._health(known, remains, doubts),
            (*doubts, *against),
        )  # fmt: skip

    def _condition_on_load(self) -> None:
        """Condition the belief on a load that is new: it is observed once, for it is the same every time.

        What was known before goes with it; where no load is known any more, it is as unknown as at first.
        """
        if not self._is_new_load or VERTICAL not in self.names:
            return
        self._is_new_load = False
        k = self.names.index(VERTICAL)
        mean, covariance = self.belief.mean.copy(), self.belief.covariance.copy()
        mean[k] = self._middle[k]
        covariance[k, :] = covariance[:, k] = 0.0
        covariance[k, k] = self._spread[k] ** 2
        self.belief = Belief(mean, covariance)
        if self._known is None:
            return
        row = np.zeros((1, len(mean)))
        row[0, k] = 1.0
        observed = BY_NAME[VERTICAL].scaled(np.array([self._known.value]))
        variance = np.array([self._known.deviation**2])
        self.belief = correct_belief(self.belief, row, observed, variance).belief

    def _rate(self, known: Estimates, mileage: float) -> RatedLife | None:
        """Rate the life under a load that is known, and count what is used."""
        if self._counter is None or known.known_load is None:
            return None
        if self._is_new_run:
            self._counter.begin(mileage)
            self._is_new_run = False
        return self._counter.rate(known.known_load, known, mileage, self.temperature)

    def _carry(self, seconds: float, metres: float) -> None:
        """Let the numbers wander for a time, and the spall grow over a distance."""
        count = len(self.names)
        noise = np.zeros(len(self.belief.mean))
        noise[:count] = self._spread**2 * [seconds / _WANDERS.get(name, _YEAR) for name in self.names]
        if self._known is not None and VERTICAL in self.names:
            noise[self.names.index(VERTICAL)] = 0.0  # the load that is known is that of the whole recording
        if not (self._grows and metres and self._spalled):
            self.belief = Belief(self.belief.mean, self.belief.covariance + np.diag(noise))
            return
        wide, across = self.names.index("width"), self.names.index("length")

        def grown(points: Float) -> Float:
            area = np.exp(points[:, wide] + points[:, across])
            after = points.copy()
            after[:, wide] = (
                np.log(self.law.grow_areas(area, np.exp(points[:, -1]), metres)) - points[:, across]
            )
            return after

        self.belief = predict_belief(self.belief, grown, noise)

    @property
    def _spalled(self) -> bool:
        return self.condition is None or self.condition.estimate.condition != HEALTHY

    def _correct(self, received: Estimates) -> tuple[str, ...]:
        """Correct the belief by what a stretch says; gives the numbers that have made a step."""
        told = [
            k
            for k, name in enumerate(self.names)
            if isfinite(received[name].value) and self._fits(received, name)
        ]
        if not told:
            return ()
        count = len(self.names)
        rows, observed, variance = np.zeros((len(told), len(self.belief.mean))), [], []
        for row, k in zip(rows, told, strict=True):
            row[[k, count + k, 2 * count + k]] = 1.0
            each = received[self.names[k]]
            low, high = each.quantity.scaled(np.array(each.intervals[-1]))
            whole = ((high - low) / (2.0 * NORMAL_90) * max(received.strangeness, 1.0)) ** 2
            observed.append(float(each.quantity.scaled(np.array(each.value))))
            variance.append(max(whole - self._common[k], _LEAST_OWN * whole))
        seen, errors = np.array(observed), np.array(variance)
        ready = correct_belief(self.belief, rows, seen, errors)
        stepped = self._find_stepped(told, ready.misses)
        if stepped:  # learnt anew, from this stretch on
            opened = self.belief.covariance.copy()
            for k in stepped:
                opened[k, k] += self._spread[k] ** 2
            ready = correct_belief(self.belief._replace(covariance=opened), rows, seen, errors)
        self.belief = ready.belief
        self._surprise = _KEPT * self._surprise + (1.0 - _KEPT) * float(np.mean(ready.misses**2))
        return tuple(self.names[k] for k in stepped)

    def _fits(self, received: Estimates, name: str) -> bool:
        """Say whether a number is of the part that is believed to be spalled, or of none."""
        if not BY_NAME[name].of_fault or self.condition is None or received.part is None:
            return True
        return received.part.condition == self.condition.estimate.condition

    def _find_stepped(self, told: list[int], misses: Float) -> list[int]:
        """Find the numbers that have been missed on one side often enough."""
        found = []
        for k, miss in zip(told, misses, strict=True):
            side = np.sign(miss) if abs(miss) > _JUMP else 0.0
            self._aside[k] = self._aside[k] + side if side and side * self._aside[k] >= 0.0 else side
            if abs(self._aside[k]) >= _JUMP_STRETCHES:
                self._aside[k] = 0.0
                found.append(k)
        return found

    def _law(self) -> GrowthLaw:
        """Give the law with the rate that is known by now."""
        if not self._grows:
            return self.law
        rate, spread = float(self.belief.mean[-1]), float(self.belief.deviation[-1])
        factor = min(max(float(np.exp(NORMAL_90 * spread)), 1.0), 100.0)
        return replace(self.law, rate=float(np.exp(rate)), rate_spread=factor)

    def _estimates(self, received: Estimates) -> Estimates:
        """Give the belief in the words of an estimate."""
        part = None if self.condition is None else self.condition.estimate
        found = replace(
            received,
            part=part,
            stretches=self.stretches,
            quantities=tuple(
                # a least width stands for itself: the belief may be the narrow one of two that look alike
                each if isfinite(each.at_least) and self._spalled else self._estimate(each.quantity)
                for each in received.quantities
            ),
        )
        return found if self._known is None else self._with_load(found, received, self._known)

    def _with_load(self, found: Estimates, received: Estimates, load: KnownLoad) -> Estimates:
        """Check a known load against this stretch, and give it, or what the belief makes of it."""
        wheel = self.service.wheel_diameter
        believed = found[VERTICAL] if VERTICAL in self.names else None
        others = tuple(each for each in found.quantities if each.quantity.name != VERTICAL)
        # what the vibration says alone is in `received`: the belief has the known load in it already
        alone = tuple(each for each in received.quantities if each.quantity.name == VERTICAL)
        checked = condition_estimates(
            replace(found, quantities=(*alone, *others)), load, self.bearing, wheel, self.axle_loads
        )
        if believed is None or not isfinite(believed.value):
            return checked
        assert checked.known_load is not None
        if checked.known_load.doubts:
            return checked  # the wider of both
        low, high = believed.intervals[-1]
        half = 0.5 * log(high / low) * believed.value
        kept = replace(checked.known_load, value=believed.value, half_width=half)
        return replace(checked, quantities=(estimate_of(kept), *others), known_load=kept)

    def _estimate(self, quantity: Quantity) -> Estimate:
        if quantity.of_fault and not self._spalled:
            return Estimate(quantity, np.nan, (), "no part is called spalled")
        if quantity.name not in self.names:
            return self.estimator.prior_estimate(quantity)
        if self._strangeness > 1.0:
            return Estimate(quantity, np.nan, (), ELSEWHERE.format(self._strangeness))
        k = self.names.index(quantity.name)
        middle, spread = self.belief.mean[k], self.belief.deviation[k]
        ends = [quantity.restored(middle + spread * np.array([-by, by])) for by in (NORMAL_50, NORMAL_90)]
        intervals = tuple((float(low), float(high)) for low, high in ends)
        if spread >= AS_WIDE * self._spread[k]:
            return Estimate(quantity, np.nan, intervals, _NOT_HEARD)
        value = float(quantity.restored(np.array(middle)))
        return within_learnt(quantity, value, intervals, self.estimator.ends_of(quantity))

    @property
    def _strangeness(self) -> float:
        """Middle strangeness of the latest stretches, or that of the last one where it is far beyond."""
        if not self._strange:
            return 0.0
        return self._strange[-1] if self._strange[-1] > _FAR else float(np.median(self._strange))

    def _doubts(self) -> tuple[str, ...]:
        """Say what the model does not explain."""
        found = []
        if self._strangeness > 1.0:
            found.append(UNLIKE.format(self._strangeness))
        if self._surprise > _SURPRISING:
            found.append(
                f"the signal differs from the known state, {self._surprise:.1f} times the usual square"
            )
        return tuple(found)

    def _health(self, known: Estimates, remains: Forecast | None, doubts: tuple[str, ...]) -> str:
        """Say the most urgent thing that holds: a doubt, reported next to it, takes no warning back."""
        if self.stretches < _FEWEST:
            return WAITING
        if remains is not None and isfinite(remains.remaining[0]):
            self._is_to_come_out = remains.remaining[0] < SOON
        elif self._strangeness <= 1.0 and not self._spalled:
            self._is_to_come_out = False  # a stretch that knows less takes no warning back
        if self._is_to_come_out:
            return TAKE_OUT
        if doubts:
            return UNEXPLAINED
        return HEALTHY if known.part is None or known.part.condition == HEALTHY else SPALLED
