"""From the motion of bodies to the readings of sensors, block by block.

=============== ===========================================================================
module          responsibility
=============== ===========================================================================
missing_rollers rollers and rows that are not there
accelerometer   specific force at the sensor, mounting resonance, low pass, noise, clipping
block           the block of about 20 ms that crosses every border
channels        raw signals of the kernel to the channels of a block
labels          labels of a run for learners
path_filter     a measured transfer path from the rigid box to a sensor
pickup          what the inverter induces in the cables of the sensors
resampling      streaming decimation and interpolation
sensor_set      all accelerometers of a scene
stage_clock     wall time of a run by stage
summary         what a run came to: means, losses, torque budget, life
=============== ===========================================================================
"""
