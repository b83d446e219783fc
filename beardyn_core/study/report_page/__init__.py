"""One page for each inspected bearing, for people who decide: verdict, evidence, assumptions, what to do.

=============== ==================================================================
module          responsibility
=============== ==================================================================
page            what a page consists of, whatever it is written to
advice          the verdict as a headline, and what to do next
identity        which bearing, which files, when, how fast
assumptions     what was assumed, grouped
file_levels     level and verdict of each file of several
page_pictures   spectrum with labelled lines, waveform, levels over files
page_content    the pages of inspections, an overview first where there are several
page_html       pages as one HTML file with the pictures in it
page_fonts      fonts that have the characters of a text
page_pdf        pages as PDF
page_writing    both files, checked before and written as a whole
=============== ==================================================================
"""
