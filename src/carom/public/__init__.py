"""The public border: names are loaded when they are first used, and what they are given is explained where it is wrong."""
