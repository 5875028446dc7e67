"""The event loop: what comes next, what it does, and the loop itself."""
