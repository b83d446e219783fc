"""Write docs/evidence/sensors.md: ``python -m evidence.service.page``."""

from __future__ import annotations

import sys
from collections.abc import Iterator

from beardyn_core.choice import load_scene
from beardyn_core.config import load_background, load_sensor, shipped_names
from evidence.pages import REPORTS, write_page
from evidence.service.study import (
    LINES,
    OCTAVES_HZ,
    PARTS,
    SPANS_HZ,
    TIERS,
    Measurement,
    receive,
    services,
    with_parts,
    with_roughness,
)
from evidence.tables import markdown

PAGE = REPORTS / "sensors.md"


def _kinds() -> Iterator[tuple[str, ...]]:
    for name in shipped_names("sensors"):
        kind = load_sensor(name)
        resonance, low_pass = (
            "-" if value is None else f"{1e-3 * value:g}"
            for value in (kind.mounting_resonance, kind.low_pass)
        )
        noise, most = f"{kind.noise_density:.2g}", f"{kind.range:g}"
        yield f"`{name}`", noise, most, resonance, low_pass, kind.description


def _backgrounds() -> Iterator[tuple[str, ...]]:
    for name in shipped_names("backgrounds"):
        background = load_background(name)
        parts = ", ".join(part for part in PARTS if getattr(background, part) is not None)
        yield f"`{name}`", parts, background.description


def _table(first: str, found: list[tuple[str, Measurement]]) -> str:
    head = (first, *(f"{low:g}-{high:g} Hz" for low, high in SPANS_HZ), "peak", "kurtosis", "monitor")
    rows = []
    for name, received in found:
        said = ", ".join(f"{verdict} {count}" for verdict, count in sorted(received.verdicts.items()))
        levels = (f"{level:.3g}" for level in received.levels)
        rows.append((name, *levels, f"{received.peak:.0f}", f"{received.kurtosis:.2f}", said))
    return markdown(head, rows, f"l{'r' * (len(SPANS_HZ) + 2)}l")


def _lines() -> str:
    scene = load_scene("service_freight", tier="quasistatic")
    head = ("rail", "wheel", *(f"{low * 2**0.5:g} Hz" for low, _ in OCTAVES_HZ))
    rows = []
    for rail, wheel in LINES:
        received = receive(with_roughness(scene, rail, wheel))
        rows.append((f"`{rail}`", f"`{wheel}`", *(f"{level:.2g}" for level in received.octaves)))
    return markdown(head, rows, f"ll{'r' * len(OCTAVES_HZ)}")


def main() -> int:
    """Run and write."""
    scene = load_scene("service_high_speed", tier="quasistatic")
    choices: list[tuple[str, ...]] = [(), *((part,) for part in PARTS), PARTS]
    parts = [(", ".join(each) or "none", receive(with_parts(scene, *each))) for each in choices]
    values = {
        "kinds": list(_kinds()),
        "backgrounds": list(_backgrounds()),
        "parts": _table("background", parts),
        "lines": _lines(),
        "tiers": {
            tier: _table("scene", [(f"`{each.name}`", receive(each)) for each in services(tier)])
            for tier in TIERS
        },
    }
    write_page(__file__, PAGE, values)
    return 0


if __name__ == "__main__":
    sys.exit(main())
