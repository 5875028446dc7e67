"""What happens in an instant: one law, one file, named for its source."""
