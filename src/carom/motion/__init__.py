"""What lies between two events: flight, sliding, rolling, pivoting, rest; and when the next contact comes."""
