"""A fleet: recordings of many axleboxes in one store, and one ranked list of what needs attention.

The store keeps what an analysis of each recording gives, and what people enter. Health, alarms and ranks are
worked out from these at every call, in the order of time, so that an old recording that comes late counts.

=============== ==============================================================================
module          responsibility
=============== ==============================================================================
identity        which axlebox a recording is of, and when and at what mileage it was made
manifest_line   the columns of a manifest
path_pattern    identity from the path of a file
manifest        recordings of a folder, from its manifest and from the paths, all mistakes at once
consistency     contradictions between recordings, and between them and the store
store           the SQLite file: analyses, evidence and entries, one writer
analysis        one recording through the monitor: verdict, levels, evidence
intake          recordings into the store, several at a time
sisters         axleboxes of one train on the same ride, compared
health          the state of an axlebox from its history, with hysteresis
growth_fit      a law of growth fitted to the widths of one spall
mileage_left    mileage and date until a spall is too wide, from its widths so far and several laws
ranking         all axleboxes, the one that needs attention most first
pictures        pictures of the page of a fleet
page            the page of a fleet: the ranked list, and a page for each axlebox over `watch`
=============== ==============================================================================
"""
