"""Measured data in: files of other programs as the recording and the `Run` of a simulation.

In the order of the data:

============= ===========================================================================
module        responsibility
============= ===========================================================================
options       what a person says about the files: one declaration of every option
units         units of acceleration, speed and time as people write them
claimed_rate  every sampling rate that files claim, and the one function that decides
moments       dates with times of other countries and zones
claimed_start when tables begin, as files say it next to their samples
time_column   columns of time: by their name, and ramps
source        what a file has: channels, their samples block by block, its own words
formats       which format a file is of: the registry
text_table    separator, decimal sign, header and units of a table in text
csv_text      CSV and other tables in text
arrays_inside channels of arrays with one or two axes, and numbers next to them
matlab        MATLAB up to version 7
hdf5          HDF5, and with it MATLAB 7.3
npz           NumPy archives and arrays
wav           WAV and other audio files
tdms          TDMS of LabVIEW
universal     Universal files, data set 58
mdf           MDF 3 and 4
parquet       Parquet
other_mcap    MCAP of other tools
clock         sampling rate and gaps from time stamps
choice        which channels are axes, speed and time; unit and rate: given, or refused
choosing      a file while that is found out: a channel by its name, and what is to be said
load_channel  a channel with the vertical load on the journal
speed_choice  where the speed of the shaft comes from
sensor_choice channels that are axes of accelerometers, and their unit
alignment     tables of a file and files of a measurement on one time
tacho         level of a tachometer's pulses, and what they give
survey        the first pass: rate, range and mistakes of every channel
telling       how files were understood, in sentences; what is true of many files once
shaft         angle of the shaft from a constant, a speed channel or tacho pulses
stated_speed  how far the speed may be from the truth, by the way it is known
about         what a recording says of where it comes from
found_speed   speed from the vibration itself, where no file says it
stream        vibration and shaft of all files as parts in the order of time
writing       the same as a recording
in_memory     the same as a `Run`
watching      the same through a monitor, without a recording
trending      levels over many records, and the memory of an alarm
============= ===========================================================================

A file is read twice and in blocks: first for its rate and its mistakes, then for its samples. No library of a
format is imported before a file of it is read.
"""
