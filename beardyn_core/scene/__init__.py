"""The scene: one bearing under one operation, with all that is asked of the run.

================= =======================================================================================
module            responsibility
================= =======================================================================================
excitation        irregularity of the rail; flats and waves of the wheel; joints, crossings, corrugation
running           speed profiles, curves; brake and drive of an axle
wheelset          an axle that bends and twists, with wheels and brake discs
operation         where load and speed come from
load              load on the journal as samples
load_check        what samples of load must be to be used
chord_polynomials from one even sample to the next without images of their rate
band_limited      interpolation between samples, by these polynomials where they are even
mounting          axlebox, journal, suspension and guidance of a vehicle
patch             patches of raceways and rollers, and their growth
field_spall       a spall of rolling contact fatigue at a stage of its growth
defect            every defect of a bearing: these, roller diameter, missing roller, worn pocket
waviness          harmonics of raceways and rollers
surface           waves of raceways and rollers as made, and what of them moves a roller
scatter           manufacturing scatter from a grade and a seed
sensor            accelerometers, their kinds, measured paths to them
background        what they measure besides the bearing
axleboxes         those of a wheelset, a bogie, a car or a train, by name and place
tier              which bodies move by their own equations of motion, how the full tier takes a time step
scene             all of it, and what of it may be chosen
trial             the matrix of scenes that a monitor is put to
sweep             distributions that the scenes of a set of runs are drawn from
================= =======================================================================================
"""
