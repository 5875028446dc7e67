"""Motion between events in closed form: flight, sliding, rolling, pivoting, bouncing, rest."""
