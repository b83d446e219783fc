"""A real-time digital twin of a railway axlebox bearing, without ROS.

What a Python program uses is here and explained in docs/python.md::

    import beardyn_core as bd

    run = bd.simulate("cup_spall", tier="quasistatic", duration=2.0)
    run.vibration.values, run.vibration.time, run.truth

=========== =====================================================================
module      responsibility
=========== =====================================================================
base        errors, units, files, arrays, and how kernels are compiled and kept
experiments a set of runs: one plan, one engine, one store, one loop
bearing     geometry, kinematics, materials, lubricants
effects     the catalogue of effects and sets of them
scene       one bearing under one operation: loads, mounting, defects, sensors
structure   modes of axleboxes: meshes, finite elements, tables of modes
rail        wheel-rail scenario to load on the journal
physics     contacts, bodies, statics and the steps of every tier: an idea a file
config      YAML files to bearings and scenes, all mistakes at once
sensors     from the motion of bodies to the readings of sensors
monitor     from vibration and speed to a verdict
choice      tier, effects, laminae and step for an accuracy, with reasons
twin        a scene that advances block by block
record      the topic table, MCAP files, runs as arrays, the rerun view
run         the one loop: load, kernels, equilibrium, blocks to the end
measured    files of measuring programs as recordings and runs
study       desk runs, ladders, trials, summaries, pictures
laboratory  general contact search against closed forms: `beardyn contacts`
population  sweeps: sets of labelled runs, and a learner to compare with
follow      load, end play and spall from vibration, with intervals
calibration the scene of one measured axlebox
fleet       recordings of many axleboxes in a store, and one ranked list
api         the functions of this module
cli         the beardyn command, a module a subcommand
=========== =====================================================================

The order is that of imports: a module takes only from rows above it; `pyproject.toml` holds the contract.
This module imports nothing before it is asked for.
"""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from beardyn_core.api import plot
    from beardyn_core.api.calibrating import calibrate
    from beardyn_core.api.estimating import estimate, forecast, rating_life, train
    from beardyn_core.api.exporting import export
    from beardyn_core.api.finding import catalogue, which_bearing
    from beardyn_core.api.fleets import Fleet, fleet
    from beardyn_core.api.following import Following, follow
    from beardyn_core.api.heat import heat_interval, steady_heat
    from beardyn_core.api.making import bearing, lubricant, name_plate, save, scene
    from beardyn_core.api.measuring import import_measured, read_measured, trend
    from beardyn_core.api.reading import monitor, read, severity
    from beardyn_core.api.report_pages import report
    from beardyn_core.api.sensitivity import smallest_spalls
    from beardyn_core.api.simulating import simulate
    from beardyn_core.api.statics import (
        equilibrium,
        fault_frequencies,
        film,
        life,
        load_distribution,
        stiffness,
        torque,
    )
    from beardyn_core.api.sweeping import open_set, sweep
    from beardyn_core.api.training import make_estimators
    from beardyn_core.base.errors import InputError, ValidityError
    from beardyn_core.bearing.cylindrical import CylindricalBearing
    from beardyn_core.bearing.geometry import Bearing
    from beardyn_core.bearing.lubricant import Lubricant
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.bearing.spherical import SphericalBearing
    from beardyn_core.calibration.calibration_result import Calibration
    from beardyn_core.effects import EffectSet
    from beardyn_core.follow.estimator import Estimates, Estimator
    from beardyn_core.follow.forecast import Forecast
    from beardyn_core.follow.growth import GrowthLaw
    from beardyn_core.follow.known_load import KnownLoad
    from beardyn_core.follow.life_assumptions import LifeAssumptions
    from beardyn_core.follow.rated_life import RatedLife
    from beardyn_core.follow.service import Service
    from beardyn_core.monitor.chain import Chain, MonitorSettings
    from beardyn_core.population.labelled_set import LabelledSet
    from beardyn_core.record.run import Run
    from beardyn_core.run import blocks
    from beardyn_core.scene.scene import Scene
    from beardyn_core.sensors.block import Block
    from beardyn_core.sensors.summary import RunSummary
    from beardyn_core.twin import Twin
else:
    from beardyn_core import bearing, fleet, follow, monitor, scene

__all__ = ["Bearing", "Block", "Calibration", "Chain", "CylindricalBearing", "EffectSet"]
__all__ += ["Estimates", "Estimator", "Fleet", "Following"]
__all__ += [
    "Forecast",
    "GrowthLaw",
    "InputError",
    "KnownLoad",
    "LabelledSet",
    "LifeAssumptions",
    "Lubricant",
    "MonitorSettings",
    "NamePlate",
]
__all__ += [
    "RatedLife",
    "Run",
    "RunSummary",
    "Scene",
    "Service",
    "SphericalBearing",
    "Twin",
    "ValidityError",
    "bearing",
    "blocks",
    "calibrate",
    "catalogue",
]
__all__ += ["equilibrium", "estimate", "export", "fault_frequencies", "film", "fleet", "follow"]
__all__ += ["forecast", "heat_interval", "import_measured"]
__all__ += [
    "life",
    "load_distribution",
    "lubricant",
    "make_estimators",
    "monitor",
    "name_plate",
    "open_set",
    "plot",
]
__all__ += ["rating_life"]
__all__ += ["read"]
__all__ += [
    "read_measured",
    "report",
    "save",
    "scene",
    "severity",
    "simulate",
    "smallest_spalls",
    "steady_heat",
    "stiffness",
]
__all__ += ["sweep", "torque", "train", "trend", "which_bearing"]

_MODULES = {
    "api.calibrating": ("calibrate",),
    "api.estimating": ("estimate", "forecast", "rating_life", "train"),
    "api.exporting": ("export",),
    "api.finding": ("catalogue", "which_bearing"),
    "api.sensitivity": ("smallest_spalls",),
    "api.fleets": ("Fleet",),
    "api.following": ("Following",),
    "api.heat": ("heat_interval", "steady_heat"),
    "api.making": ("lubricant", "name_plate", "save"),
    "api.measuring": ("import_measured", "read_measured", "trend"),
    "api.plot": ("plot",),
    "api.reading": ("read", "severity"),
    "api.report_pages": ("report",),
    "api.simulating": ("simulate",),
    "api.statics": (
        *("equilibrium", "fault_frequencies", "film", "life", "load_distribution", "stiffness", "torque"),
    ),
    "api.sweeping": ("open_set", "sweep"),
    "api.training": ("make_estimators",),
    "bearing.cylindrical": ("CylindricalBearing",),
    "bearing.geometry": ("Bearing",),
    "bearing.lubricant": ("Lubricant",),
    "bearing.name_plate": ("NamePlate",),
    "bearing.spherical": ("SphericalBearing",),
    "calibration.calibration_result": ("Calibration",),
    "effects": ("EffectSet",),
    "follow.forecast": ("Forecast",),
    "follow.service": ("Service",),
    "follow.growth": ("GrowthLaw",),
    "follow.known_load": ("KnownLoad",),
    "follow.life_assumptions": ("LifeAssumptions",),
    "follow.rated_life": ("RatedLife",),
    "follow.estimator": ("Estimates", "Estimator"),
    "base.errors": ("InputError", "ValidityError"),
    "sensors.block": ("Block",),
    "monitor.chain": ("Chain", "MonitorSettings"),
    "sensors.summary": ("RunSummary",),
    "population.labelled_set": ("LabelledSet",),
    "record.run": ("Run",),
    "run": ("blocks",),
    "scene.scene": ("Scene",),
    "twin": ("Twin",),
}
_ROOMS = {
    **dict.fromkeys(("bearing", "scene"), "api.making"),
    "fleet": "api.fleets",
    "follow": "api.following",
    "monitor": "api.reading",
}
"""Rooms whose name is also that of a function, and where that is."""
_PLOTS = "plot"  # a module of functions
_PLACE = {name: module for module, names in _MODULES.items() for name in names}


class _CallableRoom(ModuleType):
    """A room whose name is also that of a function: ``bd.scene("cup_spall")`` makes a scene."""

    def __call__(self, *arguments: Any, **options: Any) -> Any:
        """Call the function of `beardyn_core.api` with the name of the room."""
        return self._function(*arguments, **options)

    @property
    def __doc__(self) -> str:  # type: ignore[override]
        """What the function does, and then what the room holds: for help."""
        from inspect import getdoc

        return f"{getdoc(self._function)}\n\nThe package of this name: {self.__dict__['__doc__']}"

    @property
    def __signature__(self) -> Any:
        """Signature of that function, for help and completion."""
        from inspect import signature

        return signature(self._function)

    @property
    def _function(self) -> Any:
        name = self.__name__.rpartition(".")[2]
        return getattr(import_module(f"beardyn_core.{_ROOMS[name]}"), name)


if not TYPE_CHECKING:
    bearing.__class__ = fleet.__class__ = follow.__class__ = monitor.__class__ = scene.__class__ = (
        _CallableRoom
    )

    def __getattr__(name: str) -> Any:
        """Import a name of `__all__` when it is first asked for."""
        if name not in _PLACE:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        room = import_module(f"{__name__}.{_PLACE[name]}")
        found = room if name == _PLOTS else getattr(room, name)
        globals()[name] = found
        return found


def __dir__() -> list[str]:
    """List what a program may use."""
    return [*__all__, *(name for name in globals() if name.startswith("__"))]
