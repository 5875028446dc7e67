"""Kernels: how they are marked, compiled by Numba, linked, cached, and called by address."""
