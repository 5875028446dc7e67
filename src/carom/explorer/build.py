"""Build the explorer's WebAssembly module from today's kernels: what `make wasm` runs.

``python -m carom.explorer.build`` writes ``assets/engine.wasm``, ``assets/engine.json`` and musl's licence.
"""

from __future__ import annotations

import json
import sys
import time
import zlib

from carom.core.jit.kernel import kernel
from carom.errors import CaromError
from carom.explorer.entries import entries
from carom.explorer.module import ASSETS, description
from carom.files import write_text
from carom.laws.callbacks import register_calls
from carom.simulation.wall_and_floor import joint_impact

__all__ = ["build", "main"]

MAX_BYTES = 300_000


def build() -> tuple[bytes, str, str]:
    """Return the module, the text of its description, and the licence of the functions of libm in it.

    Raises CaromError where it cannot be built.
    """
    from carom.core.jit.compile import signature
    from carom.core.jit.webassembly import (
        Export,
        WebAssemblyError,
        build_module,
        libm_licence,
        plain_signature,
        require_tools,
        tool_versions,
    )

    try:
        require_tools()
    except WebAssemblyError as error:  # (before the kernels are compiled, which takes a minute)
        raise CaromError(str(error)) from None

    # (in the engine's own loop another process compiles this part)
    kernel(joint_impact)
    register_calls()
    exports = [
        Export(one.name, one.function, plain_signature(one.numbers), True) if one.numbers
        else Export(one.name, one.function, signature(one.returns, *one.arguments))
        for one in entries()
    ]  # fmt: skip
    described = description()
    try:
        module = build_module(exports, described["version"])
        described["built_with"] = tool_versions()
        licence = libm_licence()
    except WebAssemblyError as error:
        raise CaromError(str(error)) from None
    if len(module) > MAX_BYTES:
        raise CaromError(f"make wasm: expected at most {MAX_BYTES:,} bytes, got {len(module):,}")
    return module, json.dumps(described, indent=1, allow_nan=False) + "\n", licence


def main() -> int:
    """Build the module and write it beside its description; return the exit code."""
    begin = time.perf_counter()
    try:
        module, text, licence = build()
    except CaromError as error:
        sys.stderr.write(f"carom: {error}\n")
        return 2
    ASSETS.mkdir(exist_ok=True)
    (ASSETS / "engine.wasm").write_bytes(module)
    write_text(ASSETS / "engine.json", text)
    write_text(ASSETS / "LICENSE-musl.txt", licence)
    size = len(zlib.compress(module, 9))
    sys.stdout.write(f"engine.wasm: {len(module):,} bytes ({size:,} compressed), {time.perf_counter() - begin:.0f} s\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
