"""Default values that a function of Python and the verb of the command that calls it share, so that each stands once.

The modules of the command are loaded before it is known which verb runs: so these numbers stand here, and not beside functions
whose modules take long to load.
"""

from __future__ import annotations

RADIUS, MASS = 0.02625, 0.1406  # m, kg: a snooker ball
GRAVITY = 9.80665  # m/s^2
CONTACT_HEIGHT = 1.0  # radii above the floor: a vertical wall
FLOOR_CONTACT = "with"
LIKE_SOLIDS = 14 / 17  # kt/kn of two solids of the same material with Poisson's ratio 0.3
BOUNCES = 200  # of an orbit
PERIODIC_STARTS = 1000  # for each period, of the search for periodic orbits
DESIGNED_LAWS = ("contact", "sliding")
ANGLES_DEG, SPEEDS, SPINS = (5.0, 75.0), (1.0, 3.0), (0.0, 0.0)  # of shots to come: degrees, m/s, rad/s
SIGMA_V = 0.02  # m/s, the error bar of a speed
ODDS = 20.0
WINDOW = 0.5  # s, before and after a contact of a film
CONTACTS = 3  # contacts of a ball that are followed in a fit of whole tracks
