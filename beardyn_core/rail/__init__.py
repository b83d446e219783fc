"""From a railway operation to the load on the journal.

| module | responsibility |
|---|---|
| `irregularity` | power spectral density of the rail, random-phase profile over the distance |
| `excitation` | flats and polygons of the wheel, dips and corrugation of the rail, over the distance |
| `track` | the rail as standing waves of a long beam on two layers of seats |
| `suspension` | progressive springs and friction of a freight bogie, and how the twin feels them |
| `vehicle` | vertical share of one axlebox on its rail, wheel-rail contact with loss of contact |
| `course` | curvature and cant over the run, load transfer to the outer side |
| `lateral` | wheelset, bogie and body sideways: creep, conicity, flanges |
| `longitudinal` | braking and starting at one axle |
| `running` | what curves, alignment and a changing speed add to journal load and bogie motion |
| `measured` | load and speed from a CSV file |
| `build` | any `scene.operation.Operation` to a `scene.load.LoadHistory` |

A further excitation is one more function of position in `excitation`, which `build` adds to the profile
before the vehicle runs over it.
"""
