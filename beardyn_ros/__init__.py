"""ROS 2 nodes of the twin, and what they are made of, in the order of the data.

===================== ======================================================================================
module                responsibility
===================== ======================================================================================
environment           what must be there before a node starts: ROS 2, its variables, packages
runtime               one process, one node: arguments, signals, executor, exit code, a quiet end
parameters            parameters declared once from a table, refused with a sentence; which are a node's own
real_time             the best tier that keeps the asked pace on this machine, and what is given up
rig                   the twin of one axlebox and its run: of a scene, of one box of several, of a car
node_parameters       the parameters of every node
typed_messages        messages of the table as those of beardyn_msgs
wire                  topics of the table as publishers, at once or spread; raw subscriptions in one sweep
typed_topics          the topics of beardyn_msgs, where it is built and sourced
diagnostics           what nodes know of each other: names of statuses, the twin's run, twins of one name
message_guard         the intake of every node: refuses what is not promised, or of a second publisher
services              services that answer when the work is done, those of simulation_interfaces too
frames                names of frames, place and orientation in each other, transforms as tf2 messages
robot_description     the bearing in its box as URDF with meshes: robot_description, /tf_static, /tf
scenario              what the load node replays, for one box or several: load, events, what is stated of it
replay                a scenario as an endless stream: loop, seek, cross-fade, its clock, its credit
source_time           the clock of live load, and stamps that follow it
live_load             load of the live mode: its messages, low-pass filter, checks, the last value held
load_node             replays an operation or a CSV as stamped load blocks, within the credit
load_gate             what comes in as load: checked, counted, queued
load_feed             load for the twin's thread: waiting, age, knowing pauses, the smooth line of live load
load_intake           topics that carry load, decoded for the twin or refused
run_state             options of a session, the messages it hands over, its report
pacer                 simulated time on the wall clock: when a block is due, how late it was
block_messages        the messages of a block, and of the truth that begins a run
run_control           what is asked of a run while it goes: active, paused, steps, a reset, the end
awaited               nodes that a replay waits for
blocks_ahead          computed blocks that are not due yet, handed over by a thread of their own
session               the twin in its own thread: compile, wait for load, advance, pace
twin_report           the twin's diagnostics: its runs, the one that a reset has left too
twin_node             the lifecycle node around a session: topics, services, diagnostics
strands               which messages of a topic go on from each other
run_file              one run in one file, of its own or shared by several boxes, with proof of what was lost
recording             messages into files, one a run
recorder_node         every topic into a crash-safe MCAP file
value_topics          results as plain numbers, for any tool that plots
clocks_apart          whether streams that are paired by stamp have one clock
train_signals         what a train has of one axlebox, for the nodes that listen to it
monitor_node          monitoring: vibration, shaft, load and temperature, nothing else
load_reception          the load of a topic, averaged over stretches, where its operator trusts it
follower_node         load, end play and spall from vibration and shaft, as they change
viewer_node           live view in rerun
car                   the twins, loads or recorders of all axleboxes of a scene or a car in one process
enclaves              rights of each node under SROS 2, and keys for them
launching             lets a launch end with a failure when a node has failed
processes             child processes that never outlive their parent
child                 the start of such a child: it asks to end with its parent
demo                  all nodes as separate processes on one scene
===================== ======================================================================================
"""
