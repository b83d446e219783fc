"""ROS 2 nodes of the twin, and what they are made of, in the order of the data.

===================== ======================================================================================
module                responsibility
===================== ======================================================================================
environment           what must be there before a node starts: ROS 2, its variables, packages of the right age
runtime               one process, one node: arguments, signals, executor, exit code, a quiet end
parameters            parameters declared once from a table, refused with a sentence; which are a node's own
wire                  topics of the table as publishers, at once or spread; raw subscriptions in one sweep
message_guard         the intake of every node: counts and refuses what it does not take, one publisher a topic
frames                names of frames, place and orientation in each other, transforms as tf2 messages
identity              runs of a twin, frame of a load, two twins under one name
load_gate             what comes in as load: checked, counted, queued
scenario              what the load node replays: load, events, and the truth that it tells
replay                a scenario as an endless stream: loop, seek, cross-fade, passages; its clock and its credit
load_parameters       parameters of the load node
live_load             load of the live mode: its messages, low-pass filter, checks, the last value held
load_node             replays an operation or a CSV as stamped load blocks, within the credit
load_intake           topics that carry load, decoded for the twin or refused
load_feed             load for the twin's thread: waiting, age, knowing pauses, the smooth line of live load
one_box               a scene with several axleboxes, where a node is of one: what to start instead
run_state             options of a session, the messages it hands over, its report
session               the twin in its own thread: compile, wait for load, advance, pace
twin_parameters       parameters of the twin node
twin_report           what the twin says about its runs, the one that a reset has left too
twin_node             the lifecycle node around a session: topics, services, diagnostics
twin_watch            is the twin there, has it ended, how
run_file              one run in one file, of its own or shared by several axleboxes, with proof of what was lost
strands               which messages of a topic go on from each other
recording             messages into files, one a run
recorder_node         every topic into a crash-safe MCAP file
train_signals         what a train has of one axlebox, for the nodes that listen to it
monitor_node          monitoring: vibration, shaft, load and temperature, nothing else
follower_node         load, end play and spall from vibration and shaft, as they change
viewer_node           live view in rerun
car                   the axleboxes of a scene or a car by name and place; one process for the nodes of all
car_scenario          one scenario as the loads of all boxes, each wheel over the same track later
car_twin              the twins of all boxes in one process
car_load              feeds every box, all in step
car_recorder          records every box: one file for those of a scene, else a file each
diagnostics           reports as diagnostic_msgs
launching             lets a launch end with a failure when a node has failed
processes             child processes that never outlive their parent
child                 the start of such a child: it asks to end with its parent
demo                  all nodes as separate processes on one scene
robot_description     the bearing in its box as URDF with meshes: robot_description, /tf_static and /tf
services              services that answer when the work is done, those of simulation_interfaces too
===================== ======================================================================================
"""
