"""A real-time digital twin of a railway axlebox bearing, without ROS.

=========== ==================================================================
room        responsibility
=========== ==================================================================
bearing     geometry, kinematics, materials, lubricants: the bearing as a noun
scene       one bearing under one operation: loads, mounting, defects, sensors
effects     the catalogue of effects and sets of them
rail        wheel-rail scenario to load on the journal
config      YAML files to nouns and back, all mistakes at once
model       nouns to kernel parameters, and where each number stands
kernels     contacts, rollers and rings as compiled lane code
integrate   static equilibrium, state, time steps, status
observe     raw signals to channels, sensors, features, monitoring
choice      tier, effects, laminae and step for an accuracy; scenes ready to run
laboratory  general contact search against closed forms; nothing else uses it
twin        a scene that advances block by block
record      the topic table, MCAP files, the rerun view
study       desk runs, summaries, pictures, the demo's report
cli         the beardyn command, a file a subcommand
edge        unit, limits and words of a field; a noun as the mapping of its file
jit, errors how kernels are compiled; errors a user sees
=========== ==================================================================

Imports run upwards only, from `cli` to `effects`; `pyproject.toml` holds the contract.
"""
