"""First positive roots of polynomials, to their last digits."""
