"""What the damping of the contacts decides: the spalled cup and a deep spall over its quoted range.

======== =====================================================
module   responsibility
======== =====================================================
study    runs at several damping times, and the estimate of the film
page     docs/evidence/damping.md
======== =====================================================
"""
