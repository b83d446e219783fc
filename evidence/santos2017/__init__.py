"""What BearDyn (Santos 2017) ran, run again, with its figures beside ours.

=========== ==========================================================
module      responsibility, in the order of the data
=========== ==========================================================
runs        the shipped scenes ``santos_*`` with every time step kept
spectrum    force spectrum, and where its bands come from
friction    tangential over normal force of each kind of contact
comparison  the rows of the page
pictures    its pictures
page        writes docs/evidence/santos2017.md
=========== ==========================================================

References
----------
Santos, G. N. (2017), Dynamics of Tapered Roller Bearings: Modelling and Analysis, summary of the thesis,
Instituto Superior Técnico, Lisbon. Sections are those of the summary.
"""
