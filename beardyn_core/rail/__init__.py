"""From a railway operation to the load on the journal.

| module | responsibility |
|---|---|
| `irregularity` | power spectral density of the rail, random-phase profile over the distance |
| `excitation` | flats and polygons of the wheel, dips and corrugation of the rail, over the distance |
| `track` | beam on elastic foundation to a chain of masses under the wheel |
| `vehicle` | quarter vehicle on a lumped track, wheel-rail contact with loss of contact |
| `measured` | load and speed from a CSV file |
| `build` | any `scene.operation.Operation` to a `scene.load.LoadHistory` |

A further excitation is one more function of position in `excitation`, which `build` adds to the profile
before the vehicle runs over it.
"""
