"""A real-time digital twin of a railway axlebox bearing, without ROS.

========== ===================================================================
module     responsibility
========== ===================================================================
jit        how kernels are compiled
errors     errors a user sees
edge       unit, limits and words of a number, on the field that holds it
outputs    files that a command writes: nothing is replaced unasked
interrupts Ctrl-C, also while something is compiled
versions   versions of what computed a run
effects    the catalogue of effects and sets of them
bearing    geometry, kinematics, materials, lubricants
scene      one bearing under one operation: loads, mounting, defects, sensors
rail       wheel-rail scenario to load on the journal
model      bearing and scene to kernel parameters, and where each number stands
kernels    contacts, rollers and rings as compiled lane code
integrate  static equilibrium, state, time steps, status
observe    raw signals to channels, sensors, features, monitoring
choice     tier, effects, laminae and step for an accuracy, with reasons
laboratory general contact search against closed forms: `beardyn contacts`
config     YAML files to bearings and scenes, all mistakes at once
twin       a scene that advances block by block
record     the topic table, MCAP files, the rerun view
study      desk runs, ladders, trials, summaries, pictures
cli        the beardyn command, a module a subcommand
========== ===================================================================

Imports run upwards only, from `cli` to `effects`; `pyproject.toml` holds the contract.
"""
