"""Evidence for the ROS graph: real processes that are killed, starved and fed nonsense.

=========== =====================================================================
module      responsibility
=========== =====================================================================
kills       a recorder killed again and again: how much each file lacks
costs       processor time and memory of every node per simulated second
soak        kill -9 of each node in turn, nonsense, a full disk, clocks that jump
=========== =====================================================================
"""
