"""The scene: one bearing under one operation, with all that is asked of the run.

============ ===============================================================================
module       responsibility, in the order of the data
============ =====================================================================
speed        speed and distance over time
timetable    a run from stop to stop as a speed profile
irregularity which irregularity a rail has
excitation   flats and waves of the wheel; joints, welds, crossings, corrugation
curve        radius, cant and transitions of a curve
braking      brake and drive of an axle
guidance     what the sideways motion of a vehicle depends on
suspension   springs of freight bogies with their friction
measured     load and speed from a file
operation    where load and speed come from
load         load on the journal as samples
load_buffer  the load as a stream: accepted, refused, interpolated
mounting     axlebox, suspension, journal
defect       patches, roller diameter, worn pocket
waviness     harmonics of raceways and rollers
sensor       accelerometers
tier         which bodies move by their own equations of motion
integrator   how the full tier takes a time step
free         what of a scene may be chosen
scene        all of it
trial        the matrix of scenes that a monitor is put to
============ =====================================================================
"""
