"""Evidence for the ROS graph: real processes that are killed, starved and fed nonsense.

=========== =====================================================================
module      responsibility
=========== =====================================================================
kills       a recorder killed again and again: how much each file lacks
faults      the faults of two reviews, each as a scene that can be played again
strangers   scenes of stray publishers and of files that would hang a reader
review      plays them: what was measured then, what is now, whether it holds; writes docs/evidence/ros.md
costs       processor time and memory of every node per simulated second
memory      whether the memory of the nodes stays flat, in megabytes an hour
leaving     do nodes that leave stop those who stay; how soon newcomers are found
fuzz        hostile messages on every topic beside a run of all nodes
hostile     makes them
soak        kill -9 of each node in turn, nonsense, a full disk, clocks that jump
=========== =====================================================================
"""
