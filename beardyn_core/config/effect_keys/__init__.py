"""Keys of the effects, one module for each.

================== ==================================================
module             responsibility
================== ==================================================
contact_damping    loss of contacts that are pressed together
lamina_coupling    laminae that sink with each other
film               lubricant film of the raceway contacts
traction           friction of the raceway contacts
rolling_resistance resistance of the raceway contacts against rolling
rib                large roller end on the cone rib
small_rib          small roller end on the small rib
cage               cage of each row, its pockets and lands
drag               drag and churning of the rollers
seal               seals between cup and shaft
gravity            weight
ring_flexibility   bending of the cup in its housing
thermal            slow warming
audit              energy balance
================== ==================================================
"""
