"""The interface for Python programs: runs, objects made in code, answers without a run.

============= ===================================================================
module        responsibility
============= ===================================================================
finding       bearings of the catalogue by dimensions, and those that fit a vibration
making        bearings, lubricants and scenes from a handful of arguments
simulating    simulate a scene
reading       read a recording, let a monitor judge it or measured files
run_sources   runs as callers give them, and their bearing
report_pages  a page for each axlebox, to read on screen and paper
plot          load zone, spectra, waterfall, curves of stiffness and torque
plot_sources  what plots are drawn of
sensitivity   the smallest spall that a healthy record would have shown
exporting     signals of a recording for other programs
measuring     read measured files, make recordings of them
statics       stiffness, torque, life, film and load distribution, no run needed
static_inputs what these are asked for: bearing, play, lubricant, load, speed, in SI
sweeping      sets of labelled runs over a population of bearings
estimating    load, end play and spall from a run, what remains; an estimator of a set of runs
training      the estimators of a bearing, whose runs are simulated first
following     the same over many stretches and runs
fleets        recordings of many axleboxes in a store, and their ranked list
twin_residual measured minus twin, at the known state of the bearing
calibrating   the scene of one measured axlebox, fitted to its healthy recordings
heat          steady temperatures and losses by source, no run needed either
============= ===================================================================

Users take all of it from `beardyn_core` itself.
"""
