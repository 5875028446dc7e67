"""Exact derivatives of a recorded run with respect to its scene: a second pass over the log, which plain runs do not pay for."""
