"""Laws of impact, one law a file: its card, its kernel, and what scenes, billiards and fits need to know of it."""
