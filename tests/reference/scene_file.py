"""A scene file with every table that most scenes have, as the design has it."""

EXAMPLE = """\
gravity = 9.80665                 # a number along -z, or a vector; every length may also be a string with a unit, "61.5 mm"
[floor]                           # left out: no floor
restitution = 0.5
friction = 0.2                    # impact and sliding
rolling_resistance = 0.01         # deceleration / g while rolling; left out: 0
spin_friction = 0.0127            # |d omega_z / dt| = spin_friction * g / (kappa a); left out: 0
[[walls]]
shape = "plane"                   # plane | segment | box | polygon | cylinder | sphere | stadium ...
point = [0.0, 0.0, 0.0]
normal = [1.0, 0.0, 0.0]
restitution = 0.85
friction = 0.2
tangential_restitution = 0.0      # left out: 0
[[balls]]
radius = 0.03075
mass = 0.21
inertia = "solid"                 # or "hollow", or kappa; left out: solid
position = [1.0, 0.5]             # the centre; z left out: on the floor
velocity = [-2.0, 1.0]
rolling = true                    # or spin = [..]
[run]
# a law reads from a surface what it needs; what it does not need may be left out ("no-slip" needs nothing)
law = "two-step"                  # what the walls do: "two-step" (contact by contact, with friction), "conventional", "no-slip", "mirror", ...
duration = 10.0                   # or max_events = 20000, or both
"""  # noqa: E501
