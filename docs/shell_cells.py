"""The cell magic ``%%sh`` of pages whose cells are commands: output with messages last, and long sentences wrapped."""

from __future__ import annotations

import subprocess
import textwrap

from IPython.core.magic import register_cell_magic


@register_cell_magic
def sh(_line: str, cell: str) -> None:
    done = subprocess.run(["bash", "-uc", cell], capture_output=True, text=True, check=False)
    for line in (done.stdout + done.stderr).splitlines():
        print("\n".join(textwrap.wrap(line, 106)) if len(line) > 106 else line)
