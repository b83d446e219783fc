"""From the motion of bodies to the readings of sensors, and their analysis.

============= ====================================================================
module        responsibility
============= ====================================================================
block         the block of about 20 ms that crosses every border
absence       rollers and rows that are not there
kinematics    world poses, twists and contact forces from the kernel's state
decimate      streaming anti-alias decimation
interpolate   streaming interpolation, for steps longer than a sample
accelerometer specific force at the sensor, noise, clipping
resonance     the sensor on its mounting: one mass on a spring
sensors       all accelerometers of a scene
channels      raw signals of the kernel to the channels of a block
torque_budget mean power and torque of every loss
stage_clock   wall time of a run by stage
features      envelope, order tracking, spectrum, line search
chain         the reference monitoring algorithm: a stretch of signal to a verdict
monitoring    the streaming monitor around an algorithm, and what it is fed with
labels        labels of a run for learners
summary       what a run came to: means, losses, life
============= ====================================================================
"""
