"""The scene: one bearing under one operation, with all that is asked of the run.

============ =====================================================================
module       responsibility, in the order of the data
============ =====================================================================
irregularity which irregularity a rail has
excitation   flats and waves of the wheel; joints, welds, crossings, corrugation of the rail
measured     load and speed from a file
operation    where load and speed come from
speed        speed and distance over time
load         load on the journal as samples
load_buffer  the load as a stream: accepted, refused, interpolated
mounting     axlebox, suspension, journal
defect       patches, roller diameter, worn pocket
waviness     harmonics of raceways and rollers
sensor       accelerometers
tier         which bodies move by their own equations
scene        all of it
============ =====================================================================
"""
