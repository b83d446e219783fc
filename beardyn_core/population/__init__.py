"""Populations: labelled runs by the thousand, drawn from distributions, on any number of machines.

============ ====================================================================
module       responsibility
============ ====================================================================
key_paths    key paths of a scene, and a value set at one
draw         what each run has at the keys that are varied, from the seed alone
plan         the scene of each run, made and checked before anything runs
request      the plan of what a user asks for, or every mistake in it
features     what a monitor works out of a run, and levels of bands
batch        several runs in one process of a worker
store        signals in Zarr
table        labels and features in Parquet, with units; parts by bearings
folder       the folder of a set while it is made; what is done is not done again
data_card    the data card
finalizing   tables, card and checksums at the end, and checking them
sweeping     rows to the workers of the engine, what comes back to the folder
labelled_set a set, opened: table, lazy signals, batches
exporting    a set as one file for other programs
learner      a learner to compare others with: features, random forests
torch_data   a set as a PyTorch dataset
============ ====================================================================

zarr, xarray, pandas, pyarrow, scikit-learn and torch are imported here and only when they are needed.
"""
