"""Build the loops that lie ready in the package, those that are not current: what `make native` runs.

``python -m carom.cli.build_loops`` writes bitcode and its index into ``core/jit/native``; with ``--all`` what is current, too.
"""

from __future__ import annotations

import os
import sys
import time

from carom.cli.doctor import COMPILE_JOBS
from carom.core.jit.build import NativeBuild
from carom.core.jit.lowering import LoweringError
from carom.core.jit.threads import do_job


def main() -> int:
    """Run the jobs of `carom doctor --warm` with loops built for the package; return the exit code."""
    begin = time.perf_counter()
    if "--all" in sys.argv[1:]:
        os.environ["CAROM_NATIVE"] = "0"
    build = NativeBuild()
    try:
        with build.recording():
            for job in COMPILE_JOBS:
                do_job(job)
                build.write(done=False)
                sys.stdout.write(f"{time.perf_counter() - begin:6.1f} s  {job}\n")
                sys.stdout.flush()
    except LoweringError as error:
        sys.stderr.write(f"carom: make native: {error}\n")
        return 2
    written = build.write()
    for name, why in build.failed.items():
        sys.stdout.write(f"not built, compiled by Numba as before: {name}: {why}\n")
    size = sum(path.stat().st_size for path in written)
    sys.stdout.write(f"{len(written)} loops built, {size:,} bytes, {time.perf_counter() - begin:.0f} s\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
