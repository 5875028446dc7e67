"""Mutants: how they are drawn, how tests watch them, and in which order tests are shown to them."""
