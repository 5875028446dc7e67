"""Numbers in, numbers out: kernels of contact, motion and geometry, roots, and their compilation. Imports nothing else of carom."""
