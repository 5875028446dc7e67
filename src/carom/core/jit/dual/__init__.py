"""Dual numbers for compiled kernels: a value with derivatives in vector registers; records of them; calls through addresses."""
