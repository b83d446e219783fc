"""From a railway operation to the load on the journal.

============= ================================================================================
module        responsibility
============= ================================================================================
table         a CSV file of numbers, with all its mistakes at once
spectra       power spectral densities and levels of rail and wheel
patch         length of the wheel-rail contact, and what it leaves of short waves
irregularity  random-phase or measured profile over the distance
excitation    defects of wheel and rail over the distance
roughness     waves of wheel and rail below 2 m, drawn from published levels
background    forces on the journal from drive, other bearing and knocks
track         the rail as standing waves of a long beam on two layers of seats
wheelset      free modes of a wheelset from its dimensions
vehicle       vertical share of one axlebox on its springs and its rail, contact that can open
course        curvature and cant over the run, load transfer to the outer side
lateral       wheelset, bogie and body sideways: creep, conicity, flanges
flexible      the same with a wheelset that rolls on its rails, bends and twists
running       what curves, alignment, braking and starting add to load and bogie motion
measured      load and speed from a CSV file or a recording
transfer_path ratio of a sensor to the rigid box, measured, from a CSV or Universal file
build         any `scene.operation.Operation` to a `scene.load.LoadHistory`
events        what a run meets on its way, as truth
train         the loads of several axleboxes, each wheel over the same track later
load_buffer   the load as a stream: accepted, refused, interpolated
============= ================================================================================

A further excitation is one more function of position in `excitation`, which `build` adds to the profile
before the vehicle runs over it.
"""
