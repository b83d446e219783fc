"""From the motion of bodies to what sensors read, and what can be read from that.

| module | responsibility |
|---|---|
| `block` | the block of about 20 ms that crosses every border |
| `torque_budget` | mean power and torque of every loss |
| `decimate` | streaming anti-alias decimation |
| `accelerometer` | specific force at the sensor, noise, clipping |
| `resonance` | the sensor on its mounting: one mass on a spring |
| `sensors` | all accelerometers of a scene |
| `features` | envelope, order tracking, spectrum, line search |
| `diagnosis` | the pure monitoring algorithm: one stretch of signal to a verdict |
| `monitoring` | the streaming monitor around it, and what it is fed with |
| `labels` | labels of a run for learners |
| `summary` | what a run came to: means, losses, life |
"""
