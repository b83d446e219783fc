"""Studies whose data the validation page shows; each returns plain arrays."""
