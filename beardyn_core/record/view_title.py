"""Title of a view: scene, axlebox, bearing and faults of a recording, and faults in its other axleboxes."""

from __future__ import annotations

from collections.abc import Mapping

from beardyn_core.record.description import RunDescription
from beardyn_core.record.run import Run


def view_title(run: RunDescription, box: str = "", elsewhere: Mapping[str, str] | None = None) -> str:
    """Name in a line what is shown.

    Parameters
    ----------
    run : RunDescription
    box : str
        Name of the axlebox where a recording has several.
    elsewhere : mapping of str to str, optional
        Faults of the other axleboxes by their names, as `faults_elsewhere` finds them.
    """
    faults = faults_of(run) or ("no fault here" if elsewhere else "no fault")
    where = f", axlebox {box}" if box else ""
    others = "".join(f"; in {name}: {fault}" for name, fault in (elsewhere or {}).items())
    return f"{run.scene}{where}: bearing {run.shape.name}, {faults}{others}"


def faults_of(run: RunDescription) -> str:
    """Name the faults of a bearing, with commas between; empty for a healthy one."""
    return ", ".join(each.described() for each in run.defects)


def faults_elsewhere(run: Run) -> dict[str, str]:
    """Find the faults of the other axleboxes of a recording; healthy ones are left out."""
    others = (each for name, each in run.boxes.items() if run.box and name != run.box)
    named = ((each.box, faults_of(each.description)) for each in others if each.description is not None)
    return {name: faults for name, faults in named if faults}
