"""What every part of the package builds on; nothing of bearings or trains.

=============== ==============================================================
module          responsibility
=============== ==============================================================
announcements   lines on standard error about what takes long
arrays          names of array types in signatures
cache_root      where everything lies that is kept from run to run
config_folder   where the shipped configuration lies
data_root       where lies what a user has made and keeps
edge            unit, limits and words of a number, on the field that holds it
errors          errors a user sees
inputs          files that are read: no pipe, no device
interrupts      Ctrl-C, also while something is compiled
jit             how kernels are compiled
kernel_cache    compiled kernels on disk
machine_code    what a kernel's machine code comes from, as a digest
one_thread      linear algebra of small matrices without further threads
optional        libraries of an extra, imported when they are needed
outputs         files that a command writes: nothing is replaced unasked
packed          a small file as one word of text, in a recorded scene
plain_json      what strict JSON can hold
shipped_kernels kernels that came with an installation
spelling        the word that a misspelt one was meant to be
units           units of numbers in files, and the way to SI
versions        versions of what computed a run
low_pass        symmetric low-pass filters
=============== ==============================================================
"""
