"""The columns of a manifest: who each file is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

from beardyn_core.base.edge import At, kind_of, places
from beardyn_core.measured.options import Reading


@dataclass(frozen=True, kw_only=True)
class ManifestLine:
    """One line of a manifest, a file; columns that are empty or absent come from the path or the options."""

    file: A[str, At(), "path of the file, from the folder of the manifest"]
    vehicle: A[str, At(), "name or number of the vehicle"] = ""
    axle: A[str, At(), "name or number of the axle in the vehicle"] = ""
    side: A[str, At(), "left or right end of the axle, or L or R"] = ""
    time: A[
        str,
        At(),
        "begin of the recording, as 2026-03-01, 2026-03-01T14:05:00 or 20260301_140500; UTC without a zone",
    ] = ""
    mileage_km: A[float | None, At(), "of the axlebox at that time; empty: not known"] = None
    bearing: A[
        str,
        At(),
        "designation of the catalogue, shipped bearing or YAML file; a twin's recording has its own",
    ] = ""
    sensor: A[str, At(), "accelerometer in the file; empty: the first"] = ""
    source_box: A[str, At(), "axlebox in a recording of several, such as axle_1_left"] = ""
    train: A[str, At(), "whose axleboxes ride together; empty: the vehicle"] = ""
    temperature_C: A[float | None, At(), "of the axlebox at that time; empty: not known"] = None
    bearing_exchanged: A[str, At(), "yes where the bearing is another one from this recording on"] = ""


IDENTITY_COLUMNS = tuple(place.field for place in places(ManifestLine))
READING_COLUMNS = tuple(place.key for place in places(Reading))
NUMBERS = ("mileage_km", "temperature_C")


def manifest_schema() -> dict[str, Any]:
    """Write the JSON schema of a manifest in YAML."""
    words = {float: "number", int: "integer", str: "string"}
    columns: dict[str, Any] = {
        place.field: {
            "type": ["number", "null"] if place.field in NUMBERS else ["string", "number"],
            "description": place.words,
        }
        for place in places(ManifestLine)
    }
    columns["bearing_exchanged"]["type"] = ["string", "boolean"]
    for place in places(Reading):
        kind = words[kind_of(place)] if place.field != "channels" else "string"
        columns[place.key] = {"type": kind, "description": place.words}
    line = {"type": "object", "properties": columns, "additionalProperties": False}
    defaults = {key: value for key, value in columns.items() if key != "file"}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "manifest of recordings of a fleet",
        "type": "object",
        "properties": {
            "defaults": {
                "type": "object",
                "description": "columns of every line that does not have them",
                "properties": defaults,
                "additionalProperties": False,
            },
            "recordings": {"type": "array", "items": {**line, "required": ["file"]}, "minItems": 1},
        },
        "required": ["recordings"],
        "additionalProperties": False,
    }
