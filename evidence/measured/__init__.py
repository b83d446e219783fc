"""What the product says of measured data, on pages.

============== ======================================================
module         responsibility
============== ======================================================
run_to_failure docs/run_to_failure.md: when the trend alarms
spall_width    docs/spall_width.md: widths found, of known ones
============== ======================================================
"""
