"""Run all campaigns, one after the other: ``python campaigns [--small]``."""

import importlib
import sys

from campaign import NAMES

for name in NAMES:
    print(f"\n== {name}", flush=True)
    importlib.import_module(name).main(sys.argv[1:])
