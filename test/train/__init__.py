"""Several axleboxes at once."""
