"""Pages, layouts, and what a release holds."""
