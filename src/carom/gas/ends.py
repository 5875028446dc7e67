"""Why a gas cannot go on, in words."""

from __future__ import annotations

import math

from carom.checks import Faults
from carom.engine.swarm_arrays import DONE, FAINT, STUCK

__all__ = ["refuse_end", "refuse_rest"]


def refuse_rest(time: float) -> None:
    """CaromError: nothing will ever happen any more."""
    faults = Faults("Gas.run")
    faults.add("collisions", "a gas in which something happens", f"one that is at rest at t = {time!r}")
    faults.advise("collisions", "run it to a time, not to a number of collisions; or give energy back")
    faults.done()


def refuse_end(status: int, time: float, until: float) -> None:
    """CaromError where the engine says that a gas cannot go on, or will never come to what it was asked for."""
    faults = Faults("Gas.run")
    if status == STUCK:
        what = f"an inelastic collapse at t = {time!r}: time stands still over more and more of them"
        faults.add("contact_time", "contacts that come to an end", what)
        faults.advise("contact_time", "give a contact_time > 0, some share of the mean free time")
    elif status == FAINT:
        what = f"speeds below 1e-140 at t = {time!r}, whose squares double precision cannot hold"
        faults.add("collisions", "speeds that numbers can tell", what)
        faults.advise("collisions", "end the run before, or start with larger speeds")
    elif status == DONE and until == math.inf:
        refuse_rest(time)
    faults.done()
