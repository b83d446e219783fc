"""The scene: one bearing under one operation, with all that is asked of the run.

============ ===============================================================================
module       responsibility, in the order of the data
============ ===============================================================================
ranges       values outside their range, each a sentence
irregularity which irregularity a rail has
excitation   flats and waves of the wheel; joints, welds, crossings, corrugation of the rail
curve        a curve of the track: radius, cant, transitions
braking      what an axle does when the vehicle slows down or speeds up
suspension   primary suspension of freight bogies
guidance     what the lateral motion of a vehicle depends on
measured     load and speed from a file
operation    where load and speed come from
speed        speed and distance over time
timetable    a run from stop to stop as a speed profile
load         load on the journal as samples
load_buffer  the load as a stream: accepted, refused, interpolated
mounting     axlebox, suspension, journal
defect       patches, roller diameter, worn pocket
waviness     harmonics of raceways and rollers
sensor       accelerometers
integrator   how the full tier takes a time step
tier         which bodies move by their own equations
scene        all of it
trial        the matrix of runs that a monitor is put to
============ ===============================================================================
"""
