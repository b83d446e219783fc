"""Write docs/reference.md from the fields of the dataclasses: ``python docs/write_reference.py``.

``--check`` writes nothing and ends with 1 when the page is not what the declarations say.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from beardyn_core.base.edge import places
from beardyn_core.base.units import unit_of
from beardyn_core.cli.generated_parser import flag
from beardyn_core.config import SCHEMA_KINDS, json_schema
from beardyn_core.measured.options import Reading

PAGE = Path(__file__).with_name("reference.md")

HEAD = """# Reference of the files

Written by `python docs/write_reference.py` from the declarations in the code.

Every key of scenes, bearings, lubricants, vehicles, effects, trials, sweeps, boxes, sensors, backgrounds and
bearing data: what it means, in which unit, what is allowed, and what it is when it is not given
(**required**: it must be given; *none*: then there is none).
The unit of a number is the end of its key. A key with a mapping leads to its own table. Where a file of a
bearing, lubricant, vehicle, sensor, background or set of bearing data has a number it may as well have
`{value: 17, source: catalogue}`.

`beardyn schema KIND` prints the same as a JSON schema for editors.
"""
TITLES = {
    "scene": "Scene",
    "bearing": "Bearing",
    "cylindrical_bearing": "Cylindrical bearing",
    "spherical_bearing": "Spherical bearing",
    "lubricant": "Lubricant",
    "vehicle": "Vehicle",
    "effects": "Effects",
    "trial": "Trial",
    "sweep": "Sweep",
    "structure": "Structure",
    "fitted": "Structure like another one",
    "modes": "Structure by modes of another program",
    "sensor": "Sensor",
    "background": "Background",
    "bearing_data": "Bearing data",
}
_SIGNS = {"ge": "≥", "gt": ">", "le": "≤", "lt": "<"}
_LIMITS = {"minimum": "≥", "exclusiveMinimum": ">", "maximum": "≤", "exclusiveMaximum": "<"}
_TYPES = {"number": "number", "integer": "whole number", "string": "text", "boolean": "true or false"}


class Kind:
    """The tables of one kind of file, of every mapping that is in it and in no kind before."""

    def __init__(self, kind: str, known: dict[str, str]) -> None:
        self.schema = json_schema(kind)
        self.models: dict[str, Any] = self.schema.get("$defs", {})
        self.known = known  # name of a mapping -> its heading
        self.waiting: list[tuple[str, str]] = []
        self.title = TITLES[kind]

    def sections(self) -> Iterator[str]:
        """Write the table of the file itself and those of its mappings, in the order they are met."""
        yield f"## {self.title}"
        yield ""
        yield from self._table(self.schema, "")
        while self.waiting:
            name, heading = self.waiting.pop(0)
            yield f"### {heading}"
            yield ""
            yield from self._table(self.models[name], heading)

    def _table(self, model: dict[str, Any], above: str) -> Iterator[str]:
        yield _plain(model["description"])
        yield ""
        properties = model.get("properties", {})
        if not properties:
            yield "No keys: `true` or `{}`."
            yield ""
            return
        yield "| key | meaning | unit | allowed | usual |"
        yield "|---|---|---|---|---|"
        for key, found in properties.items():
            unit = unit_of(key) or ""
            required = key in model.get("required", ())
            cells = (f"`{key}`", _plain(found["description"]), unit, self._allowed(found, key, above))
            yield "| " + " | ".join((*cells, _usual(found, required))) + " |"
        yield ""

    def _allowed(self, found: dict[str, Any], key: str, above: str) -> str:
        """Describe what a value may be, with links to the tables of its mappings."""
        if "$ref" in found:
            return self._link(found["$ref"], key, above)
        if options := found.get("oneOf") or found.get("anyOf"):
            shown = [self._allowed(option, key, above) for option in options if not _is_sourced(option)]
            return ", ".join(dict.fromkeys(text for text in shown if text)) if shown else ""
        if "const" in found:
            return f"`{json.dumps(found['const']).strip(chr(34))}`"
        if "enum" in found:
            return ", ".join(f"`{json.dumps(value).strip(chr(34))}`" for value in found["enum"])
        if found.get("type") == "array":
            return self._list(found, key, above)
        if found.get("type") == "null":
            return ""
        if found.get("type") == "object":
            return "mapping"
        if "type" not in found:
            return "anything that a scene file may hold"
        kind = _TYPES[found["type"]]
        limits = [f"{sign} {_number(found[name])}" for name, sign in _LIMITS.items() if name in found]
        if "minimum" in found and "exclusiveMinimum" in found:
            limits = [text for text in limits if not text.startswith(">")]
        if not limits:
            return kind
        return ", ".join(limits) if kind == "number" else f"{kind} {', '.join(limits)}"

    def _list(self, found: dict[str, Any], key: str, above: str) -> str:
        if "prefixItems" in found:
            inner = self._allowed(found["prefixItems"][0], key, above)
            return f"list of {len(found['prefixItems'])}: {inner}"
        inner = self._allowed(found["items"], key, above)
        fewest = f" of at least {found['minItems']}" if found.get("minItems") else ""
        return f"list{fewest}: {inner}"

    def _link(self, reference: str, key: str, above: str) -> str:
        name = reference.rsplit("/", 1)[-1]
        if name not in self.known:
            kinds = self.models[name].get("properties", {}).get("kind", {})
            kind = kinds.get("const") if "const" in kinds else None
            if kind is None and len(kinds.get("enum", ())) > 1 and "default" not in kinds:
                kind = kinds["enum"][0]
            inside = above.removeprefix("`").split("`")[0]
            path = f"{inside}.{key}" if inside and above.startswith("`") else key
            heading = f"`{path}`" + (f" of kind `{kind}`" if kind else "")
            if heading in self.known.values():
                heading = f"{heading} in {self.title.lower()}s"
            self.known[name] = heading
            self.waiting.append((name, heading))
        heading = self.known[name]
        return f"[{heading.replace('`', '')}](#{_anchor(heading)})"


def _is_sourced(option: dict[str, Any]) -> bool:
    return set(option.get("properties", ())) == {"value", "source"}


def _number(limit: float) -> str:
    return str(int(limit)) if abs(limit) >= 1e6 else f"{limit:g}"


def _anchor(heading: str) -> str:
    """Make the anchor that Markdown gives a heading."""
    kept = "".join(letter for letter in heading.lower() if letter.isalnum() or letter in " _-")
    return kept.replace(" ", "-")


def _plain(text: str) -> str:
    return text.strip().splitlines()[0].replace("|", "\\|")


def _usual(found: dict[str, Any], required: bool) -> str:
    if required:
        return "**required**"
    value = found.get("default")
    if value is None or value == []:
        return "*none*"
    if isinstance(value, dict):
        return "as there"
    if isinstance(value, list) and any(isinstance(each, dict) for each in value):
        return f"{len(value)} as there"
    if isinstance(value, float):
        return f"`{value:.6g}`"
    return f"`{json.dumps(value).strip(chr(34))}`" if value != "" else "*none*"


def measured_options() -> Iterator[str]:
    """Write the table of what `beardyn import` and `beardyn monitor` take for measured files."""
    yield "## Options of measured files"
    yield ""
    yield (
        "`beardyn import` and `beardyn monitor` take them as options, `beardyn_core.read_measured` and "
        "`import_measured` as arguments of the names in the second column ([measured.md](measured.md))."
    )
    yield ""
    yield "| option | argument | meaning | unit | allowed |"
    yield "|---|---|---|---|---|"
    for place in places(Reading):
        allowed = ", ".join(f"`{each}`" for each in place.at.one_of if each)
        limits = [
            f"{sign} {_number(place.at.limits[name])}"
            for name, sign in _SIGNS.items()
            if abs(place.at.limits.get(name, math.inf)) < 1e12
        ]
        cells = (f"`{flag(place.key)}`", f"`{place.key}`", _plain(place.words), unit_of(place.key) or "")
        yield f"| {' | '.join((*cells, allowed or ', '.join(limits)))} |"
    yield ""


def page() -> str:
    """Write the whole page."""
    known: dict[str, str] = {}
    heads = {"BearingKeys": "Bearing", "LubricantKeys": "Lubricant", "VehicleKeys": "Vehicle"}
    known |= {**heads, "EffectSetKeys": "Effects"}
    lines = [HEAD]
    for kind in SCHEMA_KINDS:
        lines += Kind(kind, known).sections()
    lines += measured_options()
    return "\n".join(lines).rstrip() + "\n"


def main(arguments: list[str]) -> int:
    """Write, or check."""
    if arguments == ["--check"]:
        stale = not PAGE.exists() or PAGE.read_text(encoding="utf-8") != page()
        if stale:
            print("reference.md is not what the code says: python docs/write_reference.py", file=sys.stderr)
        return 1 if stale else 0
    if arguments:
        print(__doc__, file=sys.stderr)
        return 2
    PAGE.write_text(page(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
