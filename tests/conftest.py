"""Settings for all tests: where compiled loops are kept, and how Hypothesis searches."""

import os
from pathlib import Path

from hypothesis import HealthCheck, settings

# Compiled loops stay between runs, in the folder that pytest keeps anyway; carom itself adds the hash of its sources,
# so that a changed kernel is never answered by an old loop. Set before carom is imported by any test.
os.environ.setdefault("CAROM_CACHE", str(Path(__file__).parents[1] / ".pytest_cache" / "carom"))

# No deadline: the first call of a test may compile. The same examples every time where a failure must be repeatable.
settings.register_profile(
    "carom",
    deadline=None,
    derandomize=bool(os.environ.get("CI")),
    suppress_health_check=[HealthCheck.too_slow],
    print_blob=True,
)
settings.load_profile("carom")
