"""Speed of the twin: `make bench` runs all of it, ``python -m benchmarks --help`` a part.

| module | measures |
|---|---|
| `runs` | twins that take turns, block by block; tables |
| `right_answers` | right runs of every tier, and a train, against floors and goals |
| `real_time_factor` | simulated over wall time: tiers, sets of effects, scenes |
| `step_costs` | stages of a step, cost of a lamina, scaling in rollers and laminae |
| `starting` | compile time with an empty cache, cold start with a warm one |
| `sink_throughput` | recording |
| `held_friction` | what holding the friction of the raceways costs in accuracy |
| `two_trees` | this tree against an older one, in turns |
| `two_cores` | what a second core could give a step of the full tier at most |
| `naive_model` | the yardstick: the same model written plainly, in scipy's `solve_ivp` |
| `effect_costs` | cost of every effect, a run of its own: `make costs` |
"""
