"""Keys of the effects, one file each."""
