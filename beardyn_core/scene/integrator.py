"""How the full tier takes a time step: implicitly, or explicitly for references."""

from __future__ import annotations

# Time steps per waveform sample that a scene may ask for; 391 explicit ones are 0.1 us each.
LARGEST_STEPS = {"implicit": 64, "explicit": 512}


def integrator_problems(integrator: str, tier: str, steps_given: bool, automatic: bool) -> list[str]:
    """List the reasons why a scene cannot use its integrator, with what is allowed.

    Parameters
    ----------
    integrator : str
        ``implicit``: each roller's velocities are solved for under its contacts, linearised. ``explicit``:
        contact forces of the beginning of the step on roller and ring alike, symplectic Euler. With steps
        above 0.5 us (dry friction at 150 kN) to 5 us (films) slips flip from step to step while mean forces
        stay about right: it is nothing but a reference for the other.
    tier : str
    steps_given : bool
        Whether the scene gives `steps_per_sample` as a number.
    automatic : bool
        Whether anything in the scene is ``auto``.
    """
    if integrator != "explicit":
        return []
    if automatic:
        return [
            "'explicit' is for references and goes with nothing that is auto; write tier, effects, laminae "
            "and steps_per_sample down, or take 'implicit'"
        ]
    found = []
    if tier != "full":
        found.append(f"'explicit' needs the tier 'full', not {tier!r}; change it, or take 'implicit'")
    if not steps_given:
        found.append(
            "'explicit' needs numerics.steps_per_sample: 391 for the 0.1 us of a reference, some 80 or more"
        )
    return found
