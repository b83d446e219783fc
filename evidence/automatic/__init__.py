"""What `effects: auto` chooses, against the converged reference of the ladder.

========= ===========================================================
module    responsibility
========= ===========================================================
page      cases, their runs, and docs/evidence/automatic.md
shipped   what is chosen for every shipped scene: docs/evidence/choices.md
bands     what fast tiers miss of the third octaves: docs/effects_auto.md
torque    what fast tiers miss of the torque: docs/effects_auto.md
fast_tier the fast tier compared with the full one: docs/evidence/fast_tier.md
========= ===========================================================
"""
