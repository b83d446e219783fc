"""The contact laboratory on a page. The laboratory itself is a command, `beardyn contacts`.

====== ==============================================================
module responsibility
====== ==============================================================
page   docs/evidence/contacts.md and its pictures from what the command wrote
====== ==============================================================
"""
