"""Pages as one HTML file: style and pictures are in it, nothing is loaded, no program runs in it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape
from io import StringIO
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure

from beardyn_core.study.report_page.page import Facts, Headline, Page, PageReport, Part, Picture, Points, Rows

WIDTH = 186.0  # of the text on A4, [mm]
# [mm] around the axes of a panel
LEFT, RIGHT, BOTTOM, TOP = 11.5, 2.0, 8.0, 4.0
PICTURE_STYLE: dict[Any, Any] = {
    "font.size": 7.0,
    "axes.linewidth": 0.5,
    "axes.labelsize": 7.0,
    "axes.labelpad": 1.5,
    "xtick.major.width": 0.5,
    "ytick.major.width": 0.5,
    "xtick.labelsize": 6.5,
    "ytick.labelsize": 6.5,
    "xtick.major.pad": 1.5,
    "ytick.major.pad": 1.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.unicode_minus": True,
}
_MM = 25.4  # in an inch
_STYLE = """
@page { size: A4; margin: 6mm 11mm; }
* { box-sizing: border-box; }
body { font: 9pt/1.28 "DejaVu Sans", "Segoe UI", Helvetica, Arial, "Noto Sans", "Noto Sans CJK SC",
  "Microsoft YaHei", "PingFang SC", "WenQuanYi Micro Hei", sans-serif; color: #111; background: #fff;
  max-width: 186mm; margin: 4mm auto; padding: 0 2mm; -webkit-print-color-adjust: exact;
  print-color-adjust: exact; overflow-wrap: anywhere; }
section + section { break-before: page; margin-top: 12mm; }
h1 { font-size: 12.5pt; margin: 0 0 1.5mm; }
h2 { font-size: 9.5pt; margin: 1.4mm 0 0.6mm; border-bottom: 0.3mm solid #999; break-after: avoid; }
.verdict { border: 0.8mm solid; border-left-width: 5mm; padding: 1.6mm 3mm; break-inside: avoid; }
.verdict b { display: inline-block; border: 0.5mm solid; padding: 0 1.6mm; font-size: 11pt;
  margin-right: 1mm; }
.verdict strong { font-size: 11pt; }
.verdict p { margin: 0.8mm 0 0; color: #111; font-size: 8pt; }
dl { margin: 0; columns: 2; column-gap: 6mm; font-size: 7.1pt; }
dl.one { columns: 1; }
dl div { break-inside: avoid; padding: 0.15mm 0; }
dt { display: inline; font-weight: bold; }
dd { display: inline; margin: 0; }
figure { margin: 0; break-inside: avoid; }
figure svg { display: block; width: 100%; height: auto; }
table { border-collapse: collapse; width: 100%; table-layout: fixed; font-size: 7.8pt; }
thead { display: table-header-group; }
tr { break-inside: avoid; }
th, td { text-align: left; vertical-align: top; border-bottom: 0.2mm solid #bbb; padding: 0.3mm 1mm; }
ol { margin: 0.5mm 0 0; padding-left: 5mm; font-size: 7.8pt; }
li { break-inside: avoid; }
footer { margin-top: 2mm; font-size: 7pt; color: #444; }
@media print { body { margin: 0; padding: 0; max-width: none; } section + section { margin-top: 0; } }
"""


def html_of(report: PageReport) -> str:
    """Write the pages as an HTML document."""
    pages = "\n".join(_page(page, number, report.foot) for number, page in enumerate(report.pages))
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta name="viewport" content="width=device-width">\n<title>{escape(report.title)}</title>\n'
        f"<style>{_STYLE}</style>\n</head>\n<body>\n{pages}\n</body>\n</html>\n"
    )


def _page(page: Page, number: int, foot: str) -> str:
    parts = "\n".join(
        f"<h2>{escape(part.heading)}</h2>\n{_part(part, f'p{number}-{place}')}"
        for place, part in enumerate(page.parts)
    )
    return (
        f'<section id="p{number}">\n<h1>{escape(page.title)}</h1>\n{_headline(page.headline)}\n{parts}\n'
        f"<footer>{escape(foot)}</footer>\n</section>"
    )


def _headline(headline: Headline) -> str:
    details = "".join(f"<p>{escape(each)}</p>" for each in headline.details)
    colour = escape(headline.colour)
    return (
        f'<div class="verdict" style="border-color:{colour};color:{colour}">'
        f"<b>{escape(headline.word)}</b> <strong>{escape(headline.sentence)}</strong>{details}</div>"
    )


def _part(part: Part, name: str) -> str:
    if isinstance(part, Facts):
        rows = (f"<div><dt>{escape(key)}: </dt><dd>{escape(value)}</dd></div>" for key, value in part.rows)
        return f"<dl{'' if part.columns > 1 else ' class=one'}>{''.join(rows)}</dl>"
    if isinstance(part, Points):
        return f"<ol>{''.join(f'<li>{escape(each)}</li>' for each in part.points)}</ol>"
    if isinstance(part, Rows):
        return _table(part)
    words = "; ".join(panel.words for panel in part.panels)
    return f'<figure role="img" aria-label="{escape(words)}">{svg_of(part, name)}</figure>'


def _table(part: Rows) -> str:
    columns = "".join(f'<col style="width:{100 * width:g}%">' for width in part.widths)
    head = "".join(f"<th>{escape(each)}</th>" for each in part.head)
    links = part.links or ("",) * len(part.rows)
    rows = "".join(_row(row, link) for row, link in zip(part.rows, links, strict=True))
    return f"<table><colgroup>{columns}</colgroup><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"


def _row(row: tuple[str, ...], link: str) -> str:
    """Write a row; one that leads to a page does so by its second cell."""
    cells = [escape(cell) for cell in row]
    if link:
        cells[1] = f'<a href="#{escape(link)}">{cells[1]}</a>'
    return f"<tr>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>"


def panel_places(count: int, width: float, height: float) -> Iterator[tuple[float, float, float, float]]:
    """Give left, bottom, width and height of the axes of each panel in a picture of a size, all in mm."""
    each = width / count
    for number in range(count):
        yield (number * each + LEFT, BOTTOM, each - LEFT - RIGHT, height - BOTTOM - TOP)


def svg_of(picture: Picture, name: str) -> str:
    """Draw a picture as SVG to stand inside of a page; `name` sets its marks apart from those of others."""
    with rc_context({**PICTURE_STYLE, "svg.fonttype": "none", "svg.hashsalt": name}):
        figure = Figure(figsize=(WIDTH / _MM, picture.height / _MM))
        places = panel_places(len(picture.panels), WIDTH, picture.height)
        for panel, (left, bottom, width, height) in zip(picture.panels, places, strict=True):
            shares = (left / WIDTH, bottom / picture.height, width / WIDTH, height / picture.height)
            panel.draw(figure.add_axes(shares))
        file = StringIO()
        figure.savefig(file, format="svg", metadata={"Date": None})
    return _inside_a_page(file.getvalue(), name)


def _inside_a_page(svg: str, name: str) -> str:
    """Take out what only a file of its own has, and give every mark a name that no other picture has."""
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>\s*", "", svg, flags=re.DOTALL)
    svg = re.sub(r'\sxmlns(:\w+)?="[^"]*"', "", svg)
    svg = re.sub(r'(?<=\bid=")([^"]*)(?=")', rf"{name}-\1", svg)
    svg = re.sub(r'(?<=xlink:href="#)([^"]*)(?=")', rf"{name}-\1", svg).replace("xlink:href=", "href=")
    return re.sub(r"(?<=url\(#)([^)]*)(?=\))", rf"{name}-\1", svg)
