"""Modes of axleboxes: three meshes, static and harmonic answers beside finite elements, on springs too.

======== =====================================================
module   responsibility
======== =====================================================
study    the same questions put to finite elements and to modes
number   how many modes are enough, and what they cost
pictures those of the page
tiers    tiers with a box that bends, side by side: docs/tiers.md
page     docs/evidence/structure.md
======== =====================================================
"""
