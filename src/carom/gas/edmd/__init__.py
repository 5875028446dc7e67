"""Event-driven molecular dynamics: cell lists, an event calendar, collisions of balls and with walls, a thermostat."""
