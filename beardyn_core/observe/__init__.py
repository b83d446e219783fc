"""From the motion of bodies to what sensors read, and what can be read from that.

| module | responsibility |
|---|---|
| `block` | the block of about 20 ms that crosses every border |
| `channels` | signals of the kernel to the channels of a block |
| `kinematics` | states of the kernel to poses, velocities and contacts |
| `absence` | rows and rollers that are not there, in the channels |
| `interpolate` | streaming interpolation, for time steps longer than a sample |
| `stage_clock` | wall time of each stage |
| `torque_budget` | mean power and torque of every loss |
| `decimate` | streaming anti-alias decimation |
| `accelerometer` | specific force at the sensor, noise, clipping |
| `resonance` | the sensor on its mounting: one mass on a spring |
| `sensors` | all accelerometers of a scene |
| `features` | envelope, order tracking, spectrum, line search |
| `chain` | the monitoring algorithm: one stretch of signal to a verdict |
| `monitoring` | the streaming monitor around it |
"""
