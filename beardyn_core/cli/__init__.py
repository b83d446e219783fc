"""The ``beardyn`` command; `main` dispatches, every other module is one subcommand."""
