"""What `effects: auto` chooses for every shipped scene beside what its file has: docs/evidence/choices.md.

Nothing is run: ``python -m evidence.automatic.shipped [SCENE ...] [--to FILE]``, some minutes.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from beardyn_core.choice.costs import measured_costs
from beardyn_core.choice.load import choice_for, with_usual_step
from beardyn_core.choice.rule import Choice, error_text
from beardyn_core.config import shipped_names
from beardyn_core.config.automatic import AUTO
from beardyn_core.config.load import read_scene
from evidence.pages import REPORTS, write_page
from evidence.standard import standard_effects

PAGE = REPORTS / "choices.md"
_NOTABLE = 1e-3  # smaller errors are not written, whatever their unit


def row(name: str) -> str:
    """Choose for a scene, judge what it has, and write both as a row of the page."""
    chosen = choice_for(read_scene(name, {("effects",): AUTO}))
    own = read_scene(name)
    if own.free.effects:
        own = read_scene(name, {("effects",): standard_effects(name)})
    given = choice_for(with_usual_step(own))
    what = f"{chosen.tier}, {chosen.laminae} x {chosen.steps_per_sample:g}; {_less(chosen)}"
    return (
        f"| `{name}` | {what} | {_errors(chosen)} | {chosen.real_time_factor:.2g} | "
        f"{_errors(given)} | {given.real_time_factor:.2g} |"
    )


def _less(choice: Choice) -> str:
    """Name what is off, and what is on in another kind or only partly, with an error."""
    off = [each.effect for each in choice.decisions if not each.on]
    cheaper = [
        f"{each.effect} {each.word}"
        for each in choice.decisions
        if each.on and any(error > 0.0 for error in each.influence.values())
    ]
    return "; ".join(words for words in (f"no {', '.join(off)}" if off else "", ", ".join(cheaper)) if words)


def _errors(choice: Choice) -> str:
    found = ", ".join(
        f"{name} {error_text(name, error)}" for name, error in choice.expected.items() if not error < _NOTABLE
    )
    return (found or "none") if choice.within else f"**{found}**"


def main() -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scenes", nargs="*", default=shipped_names("scenes"), metavar="SCENE")
    parser.add_argument("--to", type=Path, default=PAGE, metavar="FILE")
    arguments = parser.parse_args()
    rows = []
    for name in arguments.scenes:
        rows.append(row(name))
        print(rows[-1], flush=True)
    costs = measured_costs()
    write_page(__file__, arguments.to, {"machine": costs.machine, "date": costs.date, "rows": rows})


if __name__ == "__main__":
    main()
