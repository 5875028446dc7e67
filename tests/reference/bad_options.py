"""What `carom compare` refuses, and how the message begins."""

import math

BAD = [
    ({"speed": math.nan}, "incoming: speed:"),
    ({"speed": 0.0}, "incoming: speed:"),
    ({"speed": math.inf}, "incoming: speed:"),
    ({"angle_deg": 90.0}, "incoming: angle_deg:"),
    ({"angle_deg": -1.0}, "incoming: angle_deg:"),
    ({"angle_deg": math.nan}, "incoming: angle_deg:"),
    ({"spin_x": math.nan}, "incoming: spin_x:"),
    ({"spin_z": -math.inf}, "incoming: spin_z:"),
    ({"vertical_speed": -math.inf}, "incoming: vertical_speed:"),
    ({"height": -0.1}, "incoming: height:"),
    ({"gravity": math.nan}, "incoming: gravity:"),
    ({"radius": 0.0}, "Ball: radius:"),
    ({"mass": -1.0}, "Ball: mass:"),
    ({"inertia": 0.7}, "Ball: inertia:"),
    ({"inertia": "hollw"}, "Ball: inertia:"),
    ({"restitution": 1.1}, "wall: restitution:"),
    ({"friction": -0.1}, "wall: friction:"),
    ({"tangential_restitution": 2.0}, "wall: tangential_restitution:"),
    ({"floor_restitution": math.nan}, "floor: restitution:"),
    ({"floor_friction": -1.0}, "floor: friction:"),
    ({"contact_height": 2.0}, "incoming: contact_height:"),
    ({"contact_height": 0.0}, "incoming: contact_height:"),
    ({"floor_contact": "before"}, "incoming: floor_contact:"),
]
