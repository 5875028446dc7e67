"""Settings for all tests: where compiled loops are kept, and how Hypothesis searches."""

import os
from pathlib import Path

from hypothesis import HealthCheck, settings

# Compiled loops stay between runs, in the folder that pytest keeps anyway; carom itself adds the hash of its sources,
# so that a changed kernel is never answered by an old loop. Set before carom is imported by any test.
os.environ.setdefault("CAROM_CACHE", str(Path(__file__).parents[1] / ".pytest_cache" / "carom"))

# No deadline: the first call of a test may compile. The same examples every time, so that the same sources give the same
# verdict; CAROM_EXPLORE=1 looks for new ones, and is worth an hour before a release.
settings.register_profile(
    "carom",
    deadline=None,
    derandomize=not os.environ.get("CAROM_EXPLORE"),
    suppress_health_check=[HealthCheck.too_slow],
    print_blob=True,
)
settings.load_profile("carom")
