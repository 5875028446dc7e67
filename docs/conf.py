"""The documentation: MyST pages whose cells run as it is built, and fail it when they fail.

sphinx-build -q -W --keep-going -b html docs docs/_build/html
"""

from __future__ import annotations

import logging
import os
import sys
import tempfile
from importlib import metadata
from pathlib import Path
from typing import Any

import jupyter_client
from sphinx import addnodes
from sphinx.application import Sphinx
from traitlets import CaselessStrEnum, default

import carom

project = "carom"
author = "the carom authors"
project_copyright = "the carom authors"
version = release = carom.__version__

sys.path.insert(0, str(Path(__file__).parent))
import forked_kernels  # noqa: E402

extensions = [
    "explorer_frame",
    "page_looks",
    "picture_count",
    "shell_cells",
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
]
exclude_patterns = ["_build", "**/.ipynb_checkpoints"]
root_doc = "index"

# --- pages --------------------------------------------------------------------------------------------------------
myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
myst_dmath_double_inline = True

# --- cells --------------------------------------------------------------------------------------------------------
nb_execution_mode = os.environ.get("CAROM_DOCS_CELLS", "force")  # "off" for a quick look at the words
nb_execution_raise_on_error = True
nb_execution_timeout = 300
nb_execution_in_temp = True
nb_execution_show_tb = True
nb_merge_streams = True  # what a cell prints is one block, however it arrived
nb_render_markdown_format = "myst"  # tables and roles in what cells display
# cells call the command `carom` of the interpreter that builds, and print without colours, on one width
os.environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
# and import the scripts that lie beside this file
os.environ["PYTHONPATH"] = os.pathsep.join([str(Path(__file__).parent), *filter(None, [os.environ.get("PYTHONPATH")])])
# results that several pages show are computed by the first of them (derived_paper.py)
_shared = tempfile.TemporaryDirectory()
os.environ["CAROM_DOCS_SHARED"] = _shared.name


class _SocketsInFiles(forked_kernels.ForkingManager):
    """Pages are read side by side, and two kernels that begin at once may pick the same port of TCP: one of them dies.

    Each talks over sockets in a folder of its own instead.
    """

    transport = CaselessStrEnum(["tcp", "ipc"], default_value="ipc")

    @default("ip")
    def _own_folder(self) -> str:
        return str(Path(tempfile.mkdtemp(dir=_shared.name)) / "kernel")


if os.name == "posix":
    jupyter_client.AsyncKernelManager = _SocketsInFiles  # (myst-nb has no setting for it)
# (a kernel sets FORCE_COLOR for its children; TTY_COMPATIBLE comes before it)
os.environ.update(NO_COLOR="1", TTY_COMPATIBLE="0", COLUMNS="100", PYTHONWARNINGS="default")
# figures go into the page, also where the caller draws without a screen (MPLBACKEND=Agg)
# in carom's style, whoever draws them
os.environ["MATPLOTLIBRC"] = str(Path(carom.__file__).parent / "plot" / "carom.mplstyle")
logging.getLogger("traitlets").setLevel(logging.WARNING)  # (a line for each page that is executed)
os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"

# --- the reference ------------------------------------------------------------------------------------------------
autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
autodoc_preserve_defaults = True
autodoc_default_options = {"show-inheritance": False}
napoleon_use_rtype = False
napoleon_use_ivar = True
viewcode_line_numbers = True
add_module_names = False
python_use_unqualified_type_names = True
# Several classes have a field `position`, and Sphinx looks the names of a function's arguments up as if they meant one of them.
suppress_warnings = ["ref.python"]

# --- the look -----------------------------------------------------------------------------------------------------
html_theme = "furo"
html_title = f"carom {version}"
html_static_path = ["_static"]
html_css_files = ["carom.css"]
html_copy_source = False
html_show_sphinx = False


def _offline_mathjax() -> Path | None:
    """The one-file MathJax of the package sphinx-mathjax-offline, where it is installed."""
    try:
        files = metadata.files("sphinx-mathjax-offline") or []
    except metadata.PackageNotFoundError:
        return None
    found = [Path(str(file.locate())) for file in files if file.name == "tex-svg.js"]
    return found[0] if found else None


if (mathjax := _offline_mathjax()) is not None:  # the pages then need no network
    html_static_path.append(str(mathjax))
    mathjax_path = "tex-svg.js"


def _underlined(lines: list[str], i: int, *names: str) -> bool:
    return i + 1 < len(lines) and lines[i] in names and set(lines[i + 1]) == {"-"}


def _fields(app: object, what: str, name: str, obj: object, options: object, lines: list[str]) -> None:
    """Prose in NumPy sections: napoleon takes every paragraph after Parameters, Returns and Raises for a name and its type."""
    given = [line if "``" in line else line.replace("|", "\\|") for line in lines]  # a size, |u_t|, is no substitution
    found: list[str] = ["..", ""] if what in ("attribute", "property") else []  # of these, what stands before a colon
    listing, i = False, 0
    while i < len(given):
        line = given[i]
        after = given[i + 1] if i + 1 < len(given) else ""
        if _underlined(given, i, "Returns", "Raises"):
            field, i, listing = line, i + 2, False
            words = given[i] if i < len(given) else ""
            if field == "Raises":
                error, _, words = words.partition(" ")
                found += ["", "", f":raises {error}: {words}"]
            else:
                found += ["", "", f":returns: {words}"]
            i += 1
            while i < len(given) and given[i].strip():
                found.append(f"    {given[i].strip()}")
                i += 1
            found.append("")
            continue
        if _underlined(given, i, "Parameters", "Attributes"):
            listing = True
            found += given[i : i + 2]
            i += 2
            continue
        prose = listing and found[-1] == "" and line[:1].strip() and not after.startswith(" ")
        if prose and not _underlined(given, i, line):
            found += ["", ""]
            listing = False
        found.append(line)
        i += 1
    lines[:] = found


def _spread(app: Sphinx, _env: object, pages: list[str]) -> None:
    """Deal the pages with most cells to different batches: Sphinx hands its processes ten neighbours in the alphabet at a time."""
    cells = {page: Path(app.srcdir, f"{page}.md").read_text(encoding="utf-8").count("{code-cell}") for page in pages}
    order = sorted(pages, key=lambda page: -cells[page])
    batches = -(-len(pages) // max(min(len(pages) // app.parallel, 10), 1)) if pages else 1
    pages[:] = [page for k in range(batches) for page in order[k::batches]]


def _shorten(_app: Sphinx, env: Any) -> None:
    """Note what of each page the navigation shows: titles, and pages below; not every function of a module."""
    for page, toc in env.tocs.items():
        _titles[page] = toc.deepcopy()
        for entry in _titles[page]:
            if len(entry) > 1:
                entry[1][:] = list(entry.findall(addnodes.toctree))
                if not entry[1]:
                    entry.pop(1)


def _one_navigation(app: Sphinx, page: str, _template: str, context: dict[str, Any], _doctree: Any) -> None:
    """Make the navigation of titles alone, from which Sphinx would take the rest out, page by page.

    That of pages without a place in it, such as sources, is made once for each depth of folders: it is the same.
    """
    made, depth = context.get("toctree"), page.count("/")
    if made is None:
        return

    def of_titles(**options: Any) -> str:
        whole = app.env.tocs
        app.env.tocs = _titles if options.get("titles_only") else whole
        try:
            return made(**options)
        finally:
            app.env.tocs = whole

    def kept(**options: Any) -> str:
        key = depth, *sorted(options.items())
        if key not in _navigations:
            _navigations[key] = of_titles(**options)
        return _navigations[key]

    context["toctree"] = of_titles if page in app.env.found_docs else kept


_titles: dict[str, Any] = {}
_navigations: dict[tuple[Any, ...], str] = {}


def setup(app: Sphinx) -> None:
    app.connect("autodoc-process-docstring", _fields, priority=100)
    app.connect("env-before-read-docs", _spread)
    app.connect("env-check-consistency", _shorten)
    app.connect("html-page-context", _one_navigation, priority=100)  # (before the theme asks for it)
    if os.name == "posix" and nb_execution_mode != "off":
        forked_kernels.start(Path(_shared.name))
