"""Compile kernels for their callers only: to LLVM's intermediate code, not to machine code.

Numba brings every function to machine code, optimised together with all that it calls, and then the same once more within each
of its callers. For kernels, which only compiled code calls, that is half of the compile time, for nothing: here they are
typed, lowered and linked, and optimised once, in the loop that calls them. The machine code of that loop is as fast.

This relies on internals of Numba (as of 0.68). It is tried on one small function first; where Numba has changed, kernels are
compiled in the ordinary way, in twice the time (:func:`linked_only`).
"""

from __future__ import annotations

import contextlib
import functools
from pathlib import Path
from typing import Any

# Numba's passes that kernels have nothing for: expressions of arrays, comprehensions, functions within functions.
LEFT_OUT = {"nopython_rewrites", "inline_closure_likes"}


@functools.cache
def linked_only(folder: Path) -> dict[str, Any]:
    """Return options for ``numba.extending.register_jitable``; none if its internals have changed. ``folder``: the cache's."""
    import numba

    # (the trial takes longer than loading what is compiled)
    tried = folder / f"linked_with_numba_{numba.__version__}"
    try:
        options = {"pipeline_class": _pipeline()}
        if not tried.exists():
            _try(options)
            with contextlib.suppress(OSError):
                tried.parent.mkdir(parents=True, exist_ok=True)
                tried.touch()
    except Exception:  # whatever it is, there is the ordinary way
        return {}
    return options


def _try(options: dict[str, Any]) -> None:
    """Compile a function that calls another one, which is linked only."""
    import numba
    from numba.extending import register_jitable

    @register_jitable(no_cpython_wrapper=True, no_cfunc_wrapper=True, **options)  # type: ignore[untyped-decorator]
    def half(x: float) -> float:
        return x / 2

    @numba.njit("float64(float64)")  # type: ignore[untyped-decorator]
    def quarter(x: float) -> float:
        return half(half(x))  # type: ignore[no-any-return]

    if quarter(1.0) != 0.25:
        raise AssertionError


def _pipeline() -> Any:
    from numba import _dynfunc
    from numba.core.codegen import JITCodeLibrary
    from numba.core.compiler import CompilerBase, DefaultPassBuilder, _LowerResult
    from numba.core.compiler_machinery import register_pass
    from numba.core.lowering import Lower
    from numba.core.typed_passes import BaseNativeLowering, NativeLowering

    class Linked(JITCodeLibrary):  # type: ignore[misc]
        """A function with what it calls, to be linked into its callers."""

        def finalize(self) -> None:
            for library in dict.fromkeys(self._linking_libraries):
                self._reload_init.update(library._reload_init)
                self._final_module.link_in(library._get_module_for_linking(), preserve=True)
            self._finalize_dynamic_globals()
            # (as Numba has it of what is linked more than once; no machine code, so no need of a copy)
            for function in self._final_module.functions:
                if not function.is_declaration and function.linkage.name == "external":
                    function.linkage = "linkonce_odr"
            self._shared_module = self._final_module
            self._finalized = True

    @register_pass(mutates_CFG=False, analysis_only=False)
    class LinkedLowering(BaseNativeLowering):  # type: ignore[misc]
        """Numba's lowering, without an address at its end."""

        _name = "carom_linked_lowering"
        lowering_class = Lower

        def run_pass(self, state: Any) -> bool:
            state.library = library = Linked(state.targetctx.codegen(), state.func_id.func_qualname)
            state.flags.no_compile = True
            try:
                super().run_pass(state)
            finally:
                state.flags.no_compile = False
            library.finalize()
            state.reload_init.extend(library._reload_init)
            # What callers know the function by. It cannot be called from Python, and so has no use for its environment.
            made = state["cr"]
            described = made.fndesc
            name = described.qualname.split(".")[-1]
            key = _dynfunc.make_function(described.lookup_module(), name, "", 0, made.env, (library,))
            state.targetctx.insert_user_function(key, described, [library])
            state["cr"] = _LowerResult(described, made.call_helper, cfunc=key, env=made.env)
            return True

    class LinkedCompiler(CompilerBase):  # type: ignore[misc]
        """Numba's passes, with another last one, and without what kernels do not need."""

        def define_pipelines(self) -> list[Any]:
            passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
            kept = [(one, text) for one, text in passes.passes if one.name() not in LEFT_OUT]
            passes.passes = [(LinkedLowering if one is NativeLowering else one, text) for one, text in kept]
            passes.finalize()
            return [passes]

    return LinkedCompiler
