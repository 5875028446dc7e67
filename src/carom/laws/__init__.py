"""Laws of impact, one file per law: its card, its kernel, and what scenes, billiards and fits need to know about it."""
