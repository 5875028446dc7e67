"""How far a compilation is: names of functions, those that are expected, shares; what another process compiles counts too."""

from __future__ import annotations

from carom.core.jit import progress
from carom.core.jit.progress import (
    CompileProgress,
    announce,
    called_kernels,
    compile_progress,
    name_of,
    watch_compiling,
)
from carom.core.roots.first_root import hit4
from carom.simulation.loop import finish, run


def test_called_kernels_are_all_that_a_loop_calls() -> None:
    names = called_kernels(hit4)
    assert "carom.core.roots.first_root:hit4" in names
    assert all(name.startswith("carom.core.") for name in names)
    engine = called_kernels(run, finish)
    assert names < engine
    assert {"carom.core.contact:one_contact", "carom.laws.wall_and_floor.solver:impact_and_way"} <= engine
    assert all(any(name.startswith(part) for part in progress.PARTS) for name in engine)


def test_progress_grows_to_one() -> None:
    seen: list[CompileProgress] = []
    names = called_kernels(hit4)
    with compile_progress(seen.append, hit4):
        announce("numba.somewhere:else", False)
        assert seen == []
        for name in [*sorted(names - {name_of(hit4)}), name_of(hit4)]:
            announce(name, False)
            announce(name, True)
    announce(name_of(hit4), True)  # nobody watches
    assert [one.share for one in seen] == sorted(one.share for one in seen)
    assert seen[0].share == 0
    assert seen[-1] == CompileProgress("machine code", len(names), len(names), 1.0)
    assert {one.part for one in seen} <= {*progress.PARTS.values(), "machine code"}


def test_watchers_hear_of_numba_functions_while_they_watch() -> None:
    from carom.core.jit.compile import njit

    seen: list[tuple[str, bool]] = []
    with watch_compiling(lambda name, finished: seen.append((name, finished))):
        double = njit(lambda x: 2 * x, cache=False)
        assert double(2) == 4
        assert double(3) == 6
    assert [finished for _name, finished in seen] == [False, True]
    assert double(2.5) == 5
    assert len(seen) == 2
