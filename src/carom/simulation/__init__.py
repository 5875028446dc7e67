"""Follow the balls of a scene from event to event, exactly; trajectories, tables, files, the run in words."""
