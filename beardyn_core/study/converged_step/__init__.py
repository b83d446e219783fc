"""The chosen time step against an explicit reference of the whole bearing.

| module | idea |
|---|---|
| `way` | loads, time steps, and which of them a study compares |
| `run` | one run, reduced to what is compared |
| `comparison` | differences from the reference, their uncertainty, the run-to-run band, verdicts |
| `study` | all runs side by side, as the mapping that is written as JSON |
| `trap` | explicit steps across their limit |
| `table` | the same for the terminal and the page |
| `picture` | spectra of the housing |
"""
