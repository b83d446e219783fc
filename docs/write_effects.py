"""Write docs/effects.md from the catalogue of effects: ``python docs/write_effects.py``."""

from __future__ import annotations

from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel

from beardyn_core.config.keys import keys_of
from beardyn_core.effects.catalogue import catalogue

PAGE = Path(__file__).with_name("effects.md")

HEAD = """# Effects

Written by `python docs/write_effects.py` from the catalogue in the code.

A scene that names no effects has those that it [needs](effects_auto.md) to stay
within 5 % of the full model. Or it names a preset
(`effects: standard`) or switches effects itself:

```yaml
effects:
  preset: standard
  film: {supply: fresh}   # options of an effect
  rib: true                 # with its usual options
  cage: false               # absent: compiled away, costs nothing
```

Faults are not listed: they are present when the scene has them. Costs are shares of the time step,
measured by `make costs` (good to 5 %): *low* below 3 %, *medium* below 15 %, *high* above. Friction that asks
for a film and that film are counted together.

| effect | kind | adds | states | cost | valid for | source |
|---|---|---|---|---|---|---|
"""


def kind_of(model: type[BaseModel]) -> str:
    """Value of the key that chooses among the kinds of an effect."""
    kind = model.model_fields.get("kind")
    return f"`{get_args(kind.annotation)[0]}`" if kind else ""


def option_rows(model: type[BaseModel]) -> list[str]:
    """Table rows of the options of one kind."""
    rows = []
    for name, field in model.model_fields.items():
        if name == "kind":
            continue
        default = (
            "required" if field.is_required() else f"`{_plain(field.get_default(call_default_factory=True))}`"
        )
        rows.append(f"| `{name}` | {default} | {field.description or ''} |")
    return rows


def _plain(value: Any) -> str:
    if value is None or isinstance(value, bool):
        return {None: "null", True: "true", False: "false"}[value]
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def page() -> str:
    """Write the whole page."""
    lines, options = [], []
    for entry in catalogue():
        model, about = keys_of(entry.options), entry.about
        cells = (f"`{entry.member}`", kind_of(model), about.adds, about.states, about.cost, about.validity)
        lines.append("| " + " | ".join((*cells, about.source)) + " |")
        if rows := option_rows(model):
            title = f"## {entry.member} {kind_of(model)}".rstrip()
            options += ["", title, "", "| option | usual | |", "|---|---|---|", *rows]
    return HEAD + "\n".join([*lines, *options]) + "\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
