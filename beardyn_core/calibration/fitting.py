"""The fit of one axlebox: scatter of the twin, search, what is determined, least squares for that."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Annotated as A
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import ValidityError
from beardyn_core.calibration.identify import Identified, common_slope, identify
from beardyn_core.calibration.search import Tried, misfit, search, weights
from beardyn_core.calibration.spectra import tolerance_of
from beardyn_core.calibration.twin import Beside
from beardyn_core.calibration.unknowns import NOISE, UNKNOWNS, Unknown

SEEDS = 4  # twins on other tracks with other bearings of the lot
_STEPS = 3  # of least squares, behind the search
FEWEST_RUNS = SEEDS * (1 + _STEPS) + 2 * len(UNKNOWNS) + 16  # twins at each speed, of the smallest budget
_FARTHEST = 0.2  # that one of them goes, of the unit box
_NOISE_STEP = 0.01  # of the unit box
_HEARD = 2.0  # halves of an interval, by which noise is above none
AS_WIDE = 0.8  # of the range: an interval says nothing more than it
TOGETHER = 0.95  # correlation from which two numbers are not distinguished
_FAILED = 1.0e6  # misfit of a twin that ended early

Tell = Callable[[str, int], None]


@dataclass(frozen=True)
class Fit:
    """What is known of an unknown."""

    unknown: Unknown
    base: A[float, "of the scene, at the edge"]
    value: A[float, "fitted; the base value where it is not determined"]
    interval: A[tuple[float, float], "of 90 %"]
    share: A[float, "width of the interval over the range thought of; 1 is no information"]
    partner: A[str, "unknown that it is most correlated with; empty with one alone"]
    correlation: A[float, "with that one"]
    reason: A[str, "why it is left at its base value; empty when it is fitted"] = ""
    unjudged: A[bool, "the search was interrupted before it was known how far this is determined"] = False

    @property
    def sentence(self) -> str:
        """Say it in a line."""
        show, (low, high) = self.unknown.text, self.interval
        if self.reason:
            return f"{self.unknown.words}: left at {show(self.base)}, {self.reason}"
        return (
            f"{self.unknown.words}: {show(self.value)}, 90 % interval {show(low)} to {show(high)}; "
            f"{show(self.base)} in the scene"
        ) + ("; best so far, how well it is known was not worked out" if self.unjudged else "")


class Fitted(NamedTuple):
    """A fit."""

    fits: tuple[Fit, ...]
    before: Float  # measured minus twin at the base values, shape [ride, axis, band], [dB]
    after: Float  # the same at the fitted ones
    tolerance: Float  # of each band, of the same shape, [dB]
    runs: int  # of twins
    interrupted: bool


def rms(difference: Float) -> float:
    """Root mean square of all bands, [dB]."""
    return float(np.sqrt(np.mean(difference**2)))


@dataclass
class Fitter:
    """Fits unknowns of a scene to what was measured."""

    beside: Beside
    unknowns: tuple[Unknown, ...]
    bases: A[tuple[float, ...], "of the unknowns, at the edge"]
    budget: A[int, "twins at each speed"]
    tell: A[Tell, "receives what is done and how many twins have run"] = lambda _what, _runs: None
    _tried: list[Tried] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._received = np.stack([ride.middle for ride in self.beside.rides])
        names = [each.name for each in self.unknowns]
        self._noise = names.index(NOISE.name) if NOISE.name in names else None
        self._base_noise = self.beside.scene.sensors[self.beside.sensor].noise_density
        ends = [
            [unknown.scaled(end) for end in unknown.ends(base)]
            for unknown, base in zip(self.unknowns, self.bases, strict=True)
        ]
        self._low, self._high = np.array(ends).T
        scaled = np.array([each.scaled(base) for each, base in zip(self.unknowns, self.bases, strict=True)])
        self._begin = (scaled - self._low) / (self._high - self._low)
        self._free = list(range(len(self.unknowns)))
        self._simulated = [k for k in self._free if k != self._noise]
        self._slope = np.zeros((self._received.size, len(self.unknowns)))
        self._besides = SEEDS * (1 + _STEPS) + 2 * (1 + len(self._simulated))

    def fit(self) -> Fitted:
        """Fit; Ctrl-C ends it with the best so far once the search has begun."""
        base = self._seeds(self._begin)
        self._tolerance = tolerance_of(self.beside.rides, base, self.beside.reception)
        self._scatter = (base - base.mean(axis=0)).reshape(SEEDS, -1)
        before = self._received - base.mean(axis=0)
        reasons, twins, known = dict[int, str](), 1, None
        sensed = False
        try:
            best = self._search_from(self._begin, self.budget - self._besides)
            self._slope = self._level_sensitivities(best)
            sensed = True
            known = self._identify_unknowns(self._difference(best))
            reasons = self._find_undetermined(known, best)
            for k in reasons:
                best[k] = self._begin[k]
            self._free = [k for k in self._free if k not in reasons]
            best, after = self._settle_on_mean(best)
            twins = SEEDS
        except KeyboardInterrupt:
            if not self._tried:
                raise
            best = min(self._tried, key=lambda each: each.misfit).point.copy()
            for k in reasons:
                best[k] = self._begin[k]
            after = self._difference(best)
        last = self._identify_unknowns(after, twins)
        known = known or last
        fits = tuple(
            replace(self._report_unknown(k, best, known, last, reasons.get(k, "")), unjudged=not sensed)
            for k in range(len(self.unknowns))
        )
        return Fitted(fits, before, after, self._tolerance, self.beside.runs, interrupted=twins < SEEDS)

    def values(self, point: Float) -> dict[str, float]:
        """Take a point of the unit box to values at the edge."""
        scaled = self._low + point * (self._high - self._low)
        return {
            each.name: each.restored(float(value)) for each, value in zip(self.unknowns, scaled, strict=True)
        }

    def _levels(self, power: Float, point: Float) -> Float:
        noise = self._base_noise if self._noise is None else self.values(point)[NOISE.name]
        return self.beside.levels(power, noise)

    def _seeds(self, point: Float) -> Float:
        """Run twins with other seeds, levels of shape [seed, ride, axis, band], [dB]."""
        found = []
        for seed in range(SEEDS):
            found.append(self.beside.power(self.values(point), seed))
            self.tell("twins with other tracks and bearings", self.beside.runs)
        return self._levels(np.stack(found), point)

    def _search_from(self, begin: Float, budget: int) -> Float:
        """Search from a point; gives the best one."""
        for each in search(self._look, begin, self._simulated, budget):
            self._tried.append(each)
            least = min(one.misfit for one in self._tried)
            self.tell(f"search, misfit {least:.2f} of the tolerance", self.beside.runs)
        return min(self._tried, key=lambda each: each.misfit).point.copy()

    def _look(self, point: Float) -> Tried:
        try:
            power = self.beside.power(self.values(point), 0)
        except ValidityError:  # far from the scene, a twin may end early
            return Tried(point, np.full(self._received.shape, np.nan), _FAILED)
        if self._noise is not None:  # no twin is needed for it
            point = point.copy()
            point[self._noise] = self._noisy(power, point)
        return Tried(point, power, misfit(self._received - self._levels(power, point), self._tolerance))

    def _noisy(self, power: Float, point: Float) -> float:
        """Find the noise that fits best, on the unit box."""

        def misfit_at(noise: float) -> float:
            at = point.copy()
            at[self._noise] = noise
            return misfit(self._received - self._levels(power, at), self._tolerance)

        grid = np.linspace(0.0, 1.0, 21)
        best = int(np.argmin([misfit_at(each) for each in grid]))
        ends = (grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)])
        return float(minimize_scalar(misfit_at, bounds=ends, method="bounded").x)

    def _difference(self, point: Float) -> Float:
        """Measured minus twin with the seed of the search, at a point that was tried, [dB]."""
        return self._received - self._levels(self._nearest(point).power, point)

    def _nearest(self, point: Float) -> Tried:
        ran = [each for each in self._tried if each.misfit < _FAILED]
        return min(ran, key=lambda each: float(np.sum((each.point - point) ** 2)))

    def _identify_unknowns(self, difference: Float, twins: int = SEEDS) -> Identified:
        """Work out what is determined of the free unknowns by a fit to the mean of so many twins."""
        weight = weights(difference, self._tolerance).ravel()
        excess = misfit(difference, self._tolerance)
        slope, model = self._slope[:, self._free], self.beside.reception.model
        return identify(slope, weight, self._scatter, excess, model, difference.shape, twins)

    def _level_sensitivities(self, point: Float) -> Float:
        """Work out how levels change with each unknown at a point, shape [level, unknown], [dB]."""
        weight = weights(self._difference(point), self._tolerance).ravel()
        found = np.zeros((2, weight.size, len(self.unknowns)))
        powers = []
        for seed, slope in enumerate(found):
            powers.append(self._run(point, seed))
            at = self._levels(powers[-1], point)
            for k in self._simulated:
                step = self.unknowns[k].step * (1.0 if point[k] < 0.5 else -1.0)
                moved = point.copy()
                moved[k] += step
                slope[:, k] = (self._levels(self._run(moved, seed), point) - at).ravel() / step
        if self._noise is not None:
            above, below = point.copy(), point.copy()
            above[self._noise] += _NOISE_STEP
            below[self._noise] -= _NOISE_STEP
            for power, slope in zip(powers, found, strict=True):
                change = self._levels(power, above) - self._levels(power, below)
                slope[:, self._noise] = change.ravel() / (2.0 * _NOISE_STEP)
        return common_slope(found[0], found[1], weight)

    def _run(self, point: Float, seed: int) -> Float:
        power = self.beside.power(self.values(point), seed)
        self.tell("how spectra change with each number", self.beside.runs)
        return power

    def _find_undetermined(self, known: Identified, point: Float) -> dict[int, str]:
        """Find what is to be left, with the reason: of two that are alike one, then what is still wide."""
        reasons = dict[int, str]()
        for k in sorted(self._free, key=lambda each: -known.share[each]):
            others = [j for j in self._free if j != k and j not in reasons]
            if not others:
                continue
            j = max(others, key=lambda each: abs(known.correlation[k, each]))
            if abs(known.correlation[k, j]) >= TOGETHER:
                reasons[k] = (
                    f"not distinguishable from {self.unknowns[j].name}: "
                    f"correlation {known.correlation[k, j]:.2f}"
                )
        self._free = [k for k in self._free if k not in reasons]
        for k, share in zip(self._free, self._identify_unknowns(self._difference(point)).share, strict=True):
            if share >= AS_WIDE:
                reasons[k] = f"not determined: its interval is {100 * share:.0f} % as wide as its range"
            elif k == self._noise and self._silent(known, point):
                reasons[k] = "not determined: other noise hides it"
        return reasons

    def _silent(self, known: Identified, point: Float) -> bool:
        """Check whether an accelerometer without noise would measure the same: its logarithm has no end."""
        power = self._nearest(point).power
        change = self._levels(power, point) - self.beside.levels(power, 0.0)
        shift = float(known.gain[self._noise] @ change.ravel())
        return shift < _HEARD * known.factor * float(known.deviation[self._noise])

    def _take_step(self, point: Float, difference: Float) -> Float:
        """Take a step of least squares from a point."""
        step = self._identify_unknowns(difference).gain @ difference.ravel()
        moved = point.copy()
        moved[self._free] += np.clip(step, -_FARTHEST, _FARTHEST)
        return np.clip(moved, 0.0, 1.0)

    def _settle_on_mean(self, point: Float) -> tuple[Float, Float]:
        """Go by least squares from the best point, by the mean of twins on several tracks."""
        found = []
        for _ in range(_STEPS):
            difference = self._received - self._seeds(point).mean(axis=0)
            found.append((misfit(difference, self._tolerance), point, difference))
            point = self._take_step(point, difference)
        _, best, after = min(found, key=lambda each: each[0])
        return best, after

    def _report_unknown(self, k: int, point: Float, known: Identified, last: Identified, reason: str) -> Fit:
        """Tell what is known of an unknown: of one that is left what was known before it was."""
        fitted = k in self._free
        place = self._free.index(k) if fitted else k
        of = last if fitted else known
        half = of.factor * of.deviation[place]
        low, high = (self.values(np.clip(point + side * half, 0.0, 1.0)) for side in (-1.0, 1.0))
        name = self.unknowns[k].name
        beside = np.abs(known.correlation[k])
        beside[k] = -1.0
        partner = int(np.argmax(beside))
        alone = len(self.unknowns) == 1
        return Fit(
            self.unknowns[k],
            self.bases[k],
            self.values(point)[name] if fitted else self.bases[k],
            (low[name], high[name]),
            float(of.share[place]),
            "" if alone else self.unknowns[partner].name,
            0.0 if alone else float(known.correlation[k, partner]),
            reason,
        )
