"""The monitor on measured records: what it says of each, beside two plain methods.

========= =====================================================================
module    responsibility
========= =====================================================================
cases     the records: faulty part, bearing, speed, and how they are read
grades    how well the faults can be diagnosed at all, as published
run       monitors over the records, and what is right, wrong or missed
page      docs/monitor_measured.md
========= =====================================================================
"""
