"""File formats of tracking programs: one module per program, each with a function from text to tracks."""
