"""Scenes of measured axleboxes: what is determined is found, the rest is said and left."""
