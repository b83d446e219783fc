"""``beardyn schema``: JSON schema of the configuration files, for editors."""

from __future__ import annotations

import argparse
import json

KINDS = (
    "scene",
    "bearing",
    "cylindrical_bearing",
    "spherical_bearing",
    "lubricant",
    "vehicle",
    "effects",
    "trial",
    "sweep",
    "structure",
    "fitted",
    "modes",
    "sensor",
    "background",
    "bearing_data",
)
MANIFEST = "fleet_manifest"  # of recordings, no configuration
_FORMER = {"plate": "bearing_data"}  # an older name


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "schema",
        help="print the JSON schema of a scene or another file, for editors",
        description="Print the JSON schema of a configuration file. With the YAML extension of an editor: "
        "`beardyn schema > scene.schema.json`, and as first line of the scene "
        "`# yaml-language-server: $schema=scene.schema.json`.",
    )
    parser.add_argument(
        "kind",
        nargs="?",
        type=lambda name: _FORMER.get(name, name),
        choices=(*KINDS, MANIFEST),
        default="scene",
        help="kind of file; default scene",
    )
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.config import json_schema
    from beardyn_core.fleet.manifest_line import manifest_schema

    found = manifest_schema() if args.kind == MANIFEST else json_schema(args.kind)
    print(json.dumps(found, indent=2))
    return 0
