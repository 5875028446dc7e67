"""What tracking programs write: one file a program, each a function from text to tracks."""
