"""``python -m carom``: the command line."""

from carom.cli import main

main()
