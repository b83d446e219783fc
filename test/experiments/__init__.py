"""The engine: workers that come, die and are replaced."""
