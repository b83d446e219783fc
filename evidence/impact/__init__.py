"""What a sensor receives when rollers pass a spall: one crossing, trends over width, speed and load.

========= =====================================================================
module    responsibility
========= =====================================================================
cases     the runs: surface, size of the spall, speed, load
study     one run, and what is measured of its signal
crossing  entry and exit of single crossings, at every step
loud      levels over a range of speeds: width, speed and load
elastic   how an elastic roller sinks into a narrow slot
edges     a held roller over a slot with rigid edges, with those of the twin and with elastic ones
published published observations beside ours
page      docs/evidence/impact.md
========= =====================================================================
"""
