"""What a command says of the line of the catalogue that it took: name, maker, size and source."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from beardyn_core.bearing.catalogue_entry import CatalogueEntry


def catalogue_sentence(entry: CatalogueEntry) -> str:
    """Say which line of the catalogue was taken, with the beginning of its source."""
    what = ", ".join(each for each in (entry.maker, entry.kind, entry.about, size_text(entry)) if each)
    return f"{entry.name} of the catalogue: {what}; source: {entry.source.split(', ')[0]}, {entry.place}"


def catalogue_object(entry: CatalogueEntry | None) -> dict[str, Any] | None:
    """Gather the same for JSON, with the whole source."""
    if entry is None:
        return None
    return {
        "name": entry.name,
        "maker": entry.maker or None,
        "kind": entry.kind,
        "source": entry.source,
        "place": entry.place,
    }


def size_text(entry: CatalogueEntry) -> str:
    """Write the boundary dimensions of a bearing; '' where they are not stated."""
    sizes = (entry.bore, entry.outer_diameter, entry.width)
    return f"{' x '.join(f'{1e3 * each:g}' for each in sizes)} mm" if sizes[0] == sizes[0] else ""
