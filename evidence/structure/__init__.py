"""Modes of axleboxes: three meshes, static and harmonic answers beside finite elements, on springs too.

======== =====================================================
module   responsibility
======== =====================================================
study    the same questions put to finite elements and to modes
page     docs/structure.md
======== =====================================================
"""
