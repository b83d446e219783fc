"""Random scenes: whatever a scene file may legally say ends finite or with a sentence.

======== =======================================================================
module   responsibility, in the order of the data
======== =======================================================================
drawing  keys of any noun at random, from its declared units and limits
scenes   a legal scene for a number and a seed, in kernels of a short list
trial    one scene from its draw to its verdict
book     many scenes on the engine, results in a folder, goes on where it was
page     writes docs/evidence/random.md
======== =======================================================================
"""
