"""What a sensor hears when rollers pass a spall: one crossing, trends over width, speed and load.

========= =====================================================================
module    responsibility
========= =====================================================================
cases     the runs: surface, size of the spall, speed, load
study     one run, and what is measured of its signal
crossing  entry and exit of single crossings, at every step
elastic   how an elastic roller sinks into a narrow slot, beside the rigid one
published published observations beside ours
page      docs/impact.md
========= =====================================================================
"""
