"""ROS 2 nodes of the twin, and what they are made of, in the order of the data.

============== ==============================================================================
module         responsibility
============== ==============================================================================
environment    what ROS 2 from wheels needs to start; says clearly when there is no ROS 2
runtime        one process, one node: arguments, signals, executor, exit code
parameters     parameters declared once from a table, refused with a sentence
wire           topics of the table as publishers, and raw subscriptions that are emptied in one sweep
load_gate      what comes in as load: checked, counted, queued
scenario       what the load node replays: load, events, and the truth that it tells
replay         a scenario as an endless stream: loop, seek, cross-fade, passages
replay_clock   pace and pause of a live replay
load_node      replays an operation or a CSV as stamped load blocks, within the credit
load_feed      load for the twin's thread: waiting, age, knowing pauses
run_state      options of a session, the messages it hands over, its report
session        the twin in its own thread: compile, wait for load, advance, pace
pacer          when a block is due on the wall clock
twin_node      the lifecycle node around a session: topics, services, diagnostics
twin_watch     is the twin there, has it ended, how
refusals       malformed messages: counted, warned of, not taken
recording      messages into files, one a run, with proof of what was lost
recorder_node  every topic into a crash-safe MCAP file
monitor_node   monitoring: vibration, shaft, load and temperature, nothing else
viewer_node    live view in rerun
diagnostics    reports as diagnostic_msgs
processes      child processes that never outlive their parent
demo           all nodes as separate processes on one scene
============== ==============================================================================
"""
