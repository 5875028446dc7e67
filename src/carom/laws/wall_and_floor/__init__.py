"""A ball in contact with wall and floor at once, integrated over the normal impulse of the wall."""
