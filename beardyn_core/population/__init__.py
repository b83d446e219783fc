"""Populations: labelled runs by the thousand, drawn from distributions, on any number of machines.

============== ==========================================================================================
module         responsibility
============== ==========================================================================================
key_paths      key paths of a scene, and a value set at one
draw           what each run has at the keys that are varied, from the seed alone
request        the scenes of what a user asks for, or every mistake in it
features       what a monitor works out of a run, and levels of bands
batch          several runs in one process of a worker
table          labels and features in Parquet, with units; parts by bearings
folder         the folder of a set while it is made: its journal, what it says about itself
difficulty     how hard a set is: what the shipped monitor finds, how far apart its classes are
data_card      the data card
finalizing     tables, card and checksums at the end, and checking them
sweeping       the plan of a sweep, conducted by the common loop, and the set closed
labelled_set   a set, opened: table, lazy signals, batches
exporting      a set as one file for other programs
learner        a learner to compare others with: features, random forests
torch_data     a set as a PyTorch dataset
sweep_scenes   what all runs of a sweep are made of: the scene of each, made and checked before any runs
signal_store   signals in Zarr
training_sweep the sweep of a vehicle class, fitted to a bearing: what an estimator learns from
============== ==========================================================================================

zarr, xarray, pandas, pyarrow, scikit-learn and torch are imported here and only when they are needed.
"""
