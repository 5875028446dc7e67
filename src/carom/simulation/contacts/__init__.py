"""Kinds of contact, one file each: what happens at an event, what the log calls it, and its sentence."""
