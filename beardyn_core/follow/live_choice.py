"""The estimator of a bearing whose measured axes show as the vibration comes, block by block."""

from __future__ import annotations

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.follow.descriptors import AXES
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.estimator_choice import estimator_for
from beardyn_core.follow.inference import finite_axes


class LiveChoice:
    """Chooses as `estimator_for` does, anew while further axes show.

    Parameters
    ----------
    bearing : RollerBearing or NamePlate

    Attributes
    ----------
    estimator : Estimator
        Of all axes until some have come.

    Raises
    ------
    InputError
        The bearing has no estimator, of whatever axes.
    """

    def __init__(self, bearing: RollerBearing | NamePlate) -> None:
        self._bearing = bearing
        self._axes: tuple[str, ...] = ()
        self._doubt: InputError | None = None
        self.estimator: Estimator = estimator_for(bearing)

    def take(self, acceleration: Float) -> Estimator:
        """Take a block of vibration, shape [sample, 3]; give the estimator of the axes that have come.

        Raises
        ------
        InputError
            There is none of these axes.
        """
        come = finite_axes(acceleration)
        axes = tuple(axis for axis in AXES if axis in come or axis in self._axes)
        if axes and axes != self._axes:
            self._axes, self._doubt = axes, None
            try:
                self.estimator = estimator_for(self._bearing, axes)
            except InputError as error:
                self._doubt = error
        if self._doubt is not None:
            raise self._doubt
        return self.estimator
