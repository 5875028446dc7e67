"""Films read by carom itself: frames and their times, the balls in them, and the tracks in metres."""
