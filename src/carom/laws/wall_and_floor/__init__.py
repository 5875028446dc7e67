"""A ball in contact with wall and floor at once, integrated in the normal impulse of the wall."""
