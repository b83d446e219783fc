"""HTML and PDF of a report: all mistakes before anything is read, each file written as a whole."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import missing
from beardyn_core.base.outputs import as_a_whole, file_problems, write_whole
from beardyn_core.study.inspection import Inspection


def page_problems(html: Path | None, pdf: Path | None, inputs: Sequence[Path], *, force: bool) -> list[str]:
    """List why the pages cannot be written; nothing is created."""
    problems: list[str] = []
    if html is not None or pdf is not None:
        asked = "--html" if html is not None else "--pdf"
        problems += missing("matplotlib", asked, "plot")
    problems += file_problems("--html", html, inputs=inputs, force=force, ending=".html")
    problems += file_problems("--pdf", pdf, inputs=inputs, force=force, ending=".pdf")
    if html is not None and pdf is not None and html.resolve() == pdf.resolve():
        problems.append(f"--html and --pdf are the same file, {html}; give two names")
    return problems


def write_pages(
    records: Sequence[Sequence[Inspection]],
    *,
    html: Path | None = None,
    pdf: Path | None = None,
    train: str = "",
    axlebox: str = "",
    force: bool = False,
) -> tuple[str, ...]:
    """Write the pages of inspections; gives the sentences that a user should read.

    Parameters
    ----------
    records : sequence of sequence of Inspection
        The bearings of each recording or measurement, in the order of time.
    html, pdf : Path, optional
        Files to write, after `page_problems`.
    train, axlebox : str
        As they stand on the page; empty: what the files say.
    force : bool
        Whether an existing file is replaced.
    """
    from beardyn_core.base.versions import versions
    from beardyn_core.study.report_page.page_content import Names, page_report
    from beardyn_core.study.report_page.page_html import html_of
    from beardyn_core.study.report_page.page_pdf import write_pdf

    labels = {each.mounted.label for record in records for each in record}
    if axlebox and len(labels) > 1:
        raise InputError(
            f"axlebox is {axlebox!r}, the name of one, and the files have {len(labels)}: "
            f"{', '.join(sorted(labels))}; choose one with box, or leave the name out"
        )
    foot = f"beardyn {versions()['beardyn']}, page made {datetime.now(UTC):%Y-%m-%d %H:%M} UTC"
    report = page_report(records, Names(train, axlebox), foot)
    told: list[str] = []
    if html is not None:
        write_whole(html, html_of(report), replace=force)
    if pdf is not None:
        with as_a_whole(pdf, replace=force) as fresh:
            told += write_pdf(report, fresh)
    return tuple(told)
