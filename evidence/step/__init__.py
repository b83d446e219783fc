"""The chosen time step against an explicit reference of the whole bearing.

========== =========================================================================
module     responsibility, in the order of the data
========== =========================================================================
cases      loads, time steps, and which of them the study compares
run        one run, reduced to what is compared
comparison differences from the reference, their uncertainty, the band between runs
study      all runs side by side, as the mapping that is written as JSON
unstable   explicit steps across their limit
table      the same for the terminal and the page
picture    spectra of the housing
page       writes docs/evidence/step.md and its picture
========== =========================================================================
"""
