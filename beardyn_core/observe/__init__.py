"""From the motion of bodies to the readings of sensors, and their analysis.

============= ====================================================================
module        responsibility
============= ====================================================================
block         the block of about 20 ms that crosses every border
absence       rollers and rows that are not there
kinematics    world poses, twists and contact forces from the kernel's state
resampling    streaming decimation and interpolation
accelerometer specific force at the sensor, mounting resonance, low pass, noise, clipping
path_filter   a measured transfer path from the rigid box to a sensor
pickup        what the inverter induces in the cables of the sensors
sensors       all accelerometers of a scene
channels      raw signals of the kernel to the channels of a block
stage_clock   wall time of a run by stage
features      envelope, order tracking, spectrum, line search
chain         the reference monitoring algorithm: a stretch of signal to a verdict
legs          times in which the shaft turns one way, put together
speed_lines   what lines of a vibration say of a speed
speed_rivals  other speeds that the same lines fit
speed         speed of the shaft from the vibration itself
trend         levels of many records against the bearing's own baseline
passage_order the order at which a fault is passed, near the nominal one
severity      how wide a spall is, from entry and exit of the rollers
monitoring    the streaming monitor around an algorithm, and what it is fed with
labels        labels of a run for learners
summary       what a run came to: means, losses, torque budget, life
============= ====================================================================
"""
