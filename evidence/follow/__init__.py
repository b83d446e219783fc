"""A follower beside a train that is played by the tier `full`: `make follow`.

========= ==================================================================
module    responsibility
========= ==================================================================
demo      hidden truth, what the follower makes of it, picture
page      the table of docs/evidence/estimator.md and its picture, from a run of it
drift     a load that steps, a spall that grows, warming, healthy bearings over mileage, and the lag of each
judged    coverage and errors by size, speed, noise and box, of sets that are made beforehand
boxes     the shipped estimator in its own box, a stiffer one and with another sensor place
bearings  what the data cards of the shipped estimators say
axlebox   estimators of one axlebox, trained after a calibration
very_wide spalls of 20 to 40 mm, wider than what was learnt from
mountings a sensor that is not mounted as stated
load_gain what a vertical load that is known buys for lateral load, end play, width and rating life
neural    a neural posterior (sbi) learnt from the same sets, beside what is shipped
========= ==================================================================
"""
