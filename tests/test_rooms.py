"""The rules of the layout: rooms, circles, laws by file, class names; import-linter keeps the layers (`lint-imports`)."""

from __future__ import annotations

import ast
import collections
import functools
import io
import re
import subprocess
import tokenize
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest
import typer

import carom

ROOT = Path(carom.__file__).parent
MODULES = {
    ".".join(("carom", *path.relative_to(ROOT).with_suffix("").parts)).removesuffix(".__init__"): path
    for path in sorted(ROOT.rglob("*.py"))
}


# What loads modules whose names it is given: the command's parts, all laws, optional libraries, what is to be compiled.
LOADERS = {
    "carom.cli",
    "carom.laws.registry",
    "carom.scene.presets",
    "carom.files",
    "carom.core.jit.threads",
}


@functools.cache
def nodes_of(name: str) -> list[ast.AST]:
    """All nodes of a module's code, parsed and walked through once."""
    return list(ast.walk(ast.parse(MODULES[name].read_text(encoding="utf-8"))))


def loaded_by_text(nodes: Iterable[ast.AST]) -> set[str]:
    """Names that a module hands to import_module and its like, and "module:function" texts; "?" for a name that is computed."""
    found = set()
    for node in nodes:
        if isinstance(node, ast.Call) and node.args:
            called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            if called in ("import_module", "__import__", "import_optional"):
                name = node.args[0]
                known = isinstance(name, ast.Constant)
                found |= {str(name.value)} if known else {"?"} if called != "import_optional" else set()
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value.startswith("carom."):
            module, colon, function = node.value.partition(":")
            found |= {module} if colon and function.isidentifier() else set()
    return found


def imports_of(name: str) -> set[str]:
    """Modules of carom that a module imports anywhere: at its top, in functions, for types, and by a text."""
    found = loaded_by_text(nodes_of(name))
    for node in nodes_of(name):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                found.add(inner if inner in MODULES else node.module)
    return {one for one in found if one in MODULES} - {name}


@functools.cache
def graph_of_modules() -> dict[str, set[str]]:
    """Imports between all modules."""
    return {name: imports_of(name) for name in MODULES}


def circles(graph: dict[str, set[str]]) -> list[list[str]]:
    """Strongly connected sets of more than one node (Tarjan)."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(node: str) -> None:
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in graph.get(node, ()):
            if other not in index:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], index[other])
        if low[node] == index[node]:
            group = [stack.pop()]
            while group[-1] != node:
                group.append(stack.pop())
            if len(group) > 1:
                found.append(sorted(group))

    for node in graph:
        if node not in index:
            visit(node)
    return found


def packages_of(graph: dict[str, set[str]]) -> dict[str, set[str]]:
    """Imports between the rooms, the packages and modules at the top of carom."""
    found: dict[str, set[str]] = collections.defaultdict(set)
    for name, others in graph.items():
        here = name.split(".")[1:2]
        for other in others:
            there = other.split(".")[1:2]
            if here and there and here != there:
                found[here[0]].add(there[0])
    return dict(found)


def test_no_circle_of_modules_or_rooms() -> None:
    assert circles(graph_of_modules()) == []
    assert circles(packages_of(graph_of_modules())) == []


def test_no_module_is_loaded_by_a_computed_name() -> None:
    assert [name for name in MODULES if name not in LOADERS and "?" in loaded_by_text(nodes_of(name))] == []


def test_a_module_that_is_loaded_by_a_text_is_an_import() -> None:
    tree = ast.parse('importlib.import_module("carom.plot"), import_module(f"carom.{x}"), ["carom.gas.gas:run"]')
    assert loaded_by_text(ast.walk(tree)) == {"carom.plot", "?", "carom.gas.gas"}


def test_a_circle_is_found() -> None:
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}}) == [["a", "b", "c"]]


def test_few_rooms_and_few_modules_at_the_top() -> None:
    rooms = [path.name for path in ROOT.iterdir() if path.is_dir() and (path / "__init__.py").exists()]
    assert len(rooms) <= 17
    assert len(list(ROOT.glob("*.py"))) <= 6
    assert len(levels(packages_of(graph_of_modules()))) <= 10


def levels(graph: dict[str, set[str]]) -> list[set[str]]:
    """Floors: each room above all that it imports."""
    rooms = set(graph) | {other for others in graph.values() for other in others}
    floor: list[set[str]] = []
    placed: set[str] = set()
    while rooms - placed:
        now = {room for room in rooms - placed if graph.get(room, set()) <= placed}
        assert now, f"a circle among {sorted(rooms - placed)}"
        floor.append(now)
        placed |= now
    return floor


def test_tests_stand_in_the_same_rooms() -> None:
    rooms = {path.name for path in ROOT.iterdir() if (path / "__init__.py").exists()}
    folders = {path.name for path in Path(__file__).parent.iterdir() if path.is_dir() and list(path.glob("test_*.py"))}
    assert folders <= rooms


def test_only_core_imports_numba() -> None:
    strange = {
        name
        for name in MODULES
        for node in nodes_of(name)
        if isinstance(node, ast.Import | ast.ImportFrom)
        for alias in node.names
        if (alias.name if isinstance(node, ast.Import) else node.module or "").split(".")[0] in ("numba", "llvmlite")
    }
    assert {name for name in strange if not name.startswith("carom.core")} == set()
    assert strange  # (core does)


def test_files_that_are_named_are_opened_by_one_function() -> None:
    """`files.open_regular` opens what a user, or a file, names; other modules read what was installed or made by carom."""
    own = {
        "carom.files", "carom.laws.maw", "carom.public.interrupts", "carom.cli.doctor", "carom.cli.catalog", "carom.cli.shots",
        "carom.scene.presets", "carom.scene.toml", "carom.gas.scene", "carom.sweeps.sweep", "carom.explorer.page",
        "carom.explorer.module", "carom.cli.parameters",
    }  # fmt: skip
    opened = {
        f"{name}:{node.lineno}"
        for name in MODULES
        if name not in own and not name.startswith("carom.core.jit")
        for node in nodes_of(name)
        if isinstance(node, ast.Call) and opens_a_name(node)
    }
    assert opened == set()


def opens_a_name(call: ast.Call) -> bool:
    """Return whether a call opens a file to read; members of open archives, and GSD's library, come after `open_regular`."""
    owner, _dot, what = ast.unparse(call.func).rpartition(".")
    if what == "open":
        modes = {one.value for one in call.args if isinstance(one, ast.Constant)}
        return not {"w", "wb", "a"} & modes and owner not in ("archive", "av", "os", "gsd", "gsd.fl", "_gsd(path)")
    return what in ("read_text", "read_bytes") and bool(owner)


def test_a_class_name_occurs_once() -> None:
    names = collections.Counter(
        node.name
        for name in MODULES
        for node in nodes_of(name)
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
    )
    twice = {name for name, count in names.items() if count > 1}
    # public names of two rooms each: a billiard's table and start beside a scene's and a gas's, a constraint's contact
    assert twice <= {"Start", "Table", "Contact"}


def test_modules_are_short() -> None:
    lines = {name: len(path.read_text(encoding="utf-8").splitlines()) for name, path in MODULES.items()}
    assert {name: count for name, count in lines.items() if count > 900} == {}


def built(names: Iterable[str]) -> list[str]:
    """Files that a program made: in a folder of caches, of such an ending, or binary beside those that are shipped."""
    shipped = re.compile(
        r"src/carom/(core/jit/native|explorer/assets)/|docs/images/.*(png|gif)$|tests/interop/files/.*msgpack$"
    )
    made = re.compile(
        r"(^|/)(\S*cache\S*|build|dist|node_modules|_build|_generated|.*egg-info)/|\.(py[co]|nb[ic]|pkl|pickle|so|o|whl|log)$"
    )
    root = ROOT.parents[1]
    return [
        name
        for name in names
        if not shipped.match(name)
        and (made.search(name) or ((root / name).is_file() and b"\0" in (root / name).read_bytes()[:8000]))
    ]


def test_no_build_product_is_tracked() -> None:
    asked = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT.parents[1], capture_output=True, text=True, check=False)
    if asked.returncode:
        pytest.skip("not a clone")
    assert built(filter(None, asked.stdout.split("\0"))) == []
    assert len(built(["cache/used", "a/__pycache__/b", "src/carom/a.nbc", "web/node_modules/c.js", "d.pkl"])) == 5


def test_a_module_that_is_run_ends_with_its_call() -> None:
    """What stands below it would not be defined yet."""
    for name, path in MODULES.items():
        body = ast.parse(path.read_text(encoding="utf-8")).body
        calls = [one for one in body if isinstance(one, ast.If) and ast.unparse(one.test) == "__name__ == '__main__'"]
        assert calls in ([], body[-1:]), name


# Lines of code that a room may have (no blank, comment or docstring lines), and modules in all.
CAPS = {
    "fitting": 10705,
    "gas": 6953,
    "billiards": 5588,
    "tracks": 9473,
    "simulation": 6439,
    "core": 5745,
    "laws": 4968,
    "scene": 4890,
    "cli": 4208,
    "plot": 3625,
    "derive": 2983,
    "sweeps": 3264,
    "data": 2615,
    "interop": 1162,
    "explorer": 881,
    "env": 600,
    "public": 329,
    "top": 794,
}
MOST_MODULES = 302
NO_CODE = {
    tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER,
}  # fmt: skip


def code_lines(path: Path) -> int:
    """Lines of a module that hold code: no blank, comment or docstring lines."""
    text = path.read_text(encoding="utf-8")
    docs = set()
    for node in ast.walk(ast.parse(text)):
        body = getattr(node, "body", None)
        first = body[0] if isinstance(body, list) and body else None
        if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and isinstance(first.value.value, str):
            docs |= set(range(first.lineno, (first.end_lineno or first.lineno) + 1))
    lines: set[int] = set()
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type not in NO_CODE:
            lines |= set(range(token.start[0], token.end[0] + 1))
    return len(lines - docs)


def test_rooms_keep_their_caps() -> None:
    """A room that must grow takes the lines from another: then both numbers change here, in the same commit."""
    lines: collections.Counter[str] = collections.Counter()
    for name, path in MODULES.items():
        room = name.split(".")[1] if "." in name and path.parent != ROOT else "top"
        lines[room] += code_lines(path)
    assert {room: (count, CAPS[room]) for room, count in lines.items() if count > CAPS[room]} == {}
    assert len(MODULES) <= MOST_MODULES
    assert set(lines) == set(CAPS)


def test_lines_of_code_are_counted_without_comments_and_docstrings(tmp_path: Path) -> None:
    file = tmp_path / "module.py"
    file.write_text(
        '"""Text\nof two lines."""\n\n# a comment\nx = (\n    1,\n)  # and one\n\n\ndef f():\n    """Text."""\n    return x\n'
    )
    assert code_lines(file) == 5


# --- words of the command line ----------------------------------------------------------------------------------------

# (a second command, of its own)
LIBRARY = [name for name in MODULES if not name.startswith("carom.cli")]


def texts_of(name: str, docs: bool) -> list[tuple[int, str]]:
    """Texts in a module with their lines, docstrings among them or not; what an f-string puts in is {}."""
    nodes = nodes_of(name)
    alone = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    texts = [(node, node.value) for node in nodes if isinstance(node, ast.Constant)]
    for node in nodes:
        if isinstance(node, ast.JoinedStr):
            pieces = [one.value if isinstance(one, ast.Constant) else "{}" for one in node.values]
            texts.append((node, "".join(map(str, pieces))))  # type: ignore[arg-type]
    return [(node.lineno, text) for node, text in texts if isinstance(text, str) and (docs or id(node) not in alone)]


@functools.cache
def options() -> dict[str, set[str]]:
    """All options of the command, and the parameters that they stand for."""
    from carom.cli import app
    from carom.cli.verbs import parameter_of

    found: dict[str, set[str]] = collections.defaultdict(set)

    def collect(command: Any) -> None:
        for option in command.params:
            for name in (*option.opts, *option.secondary_opts) if option.param_type_name == "option" else ():
                found[name].add(parameter_of(option))
        for inner in getattr(command, "commands", {}).values():
            collect(inner)

    collect(typer.main.get_command(app))
    return found


def test_no_text_of_the_library_names_an_option() -> None:
    """Texts name parameters, in backquotes; the command shows its options in their place (`cli/verbs.py`)."""
    named = {
        f"{name}:{line}: {option}"
        for name in LIBRARY
        for line, text in texts_of(name, docs=True)
        for option in re.findall(r"(?<![\w-])--(?:[a-z][a-z-]*|\{)", text)
        if option in options() or option == "--{"
    }
    assert named == set()


def test_every_parameter_that_a_text_names_is_an_option_of_some_verb() -> None:
    from carom.cli.verbs import SYNONYMS

    known = set(SYNONYMS).union(*options().values())
    strange = {
        f"{name}:{line}: {parameter}"
        for name in LIBRARY
        for line, text in texts_of(name, docs=False)
        for parameter in re.findall(r"(?<!`)`(\w+)(?:=True)?`", text)
        if parameter not in known
    }
    assert strange == set()


def test_what_takes_long_has_a_quick_sibling() -> None:
    """Of each file of tests a plain `pytest` runs some; of benchmarks, campaigns and statements of documents it runs none."""
    texts = {file.name: file.read_text(encoding="utf-8") for file in Path(__file__).parent.rglob("test_*.py")}
    only_slow = {
        name for name, text in texts.items() if text.count("@pytest.mark.slow\n") >= text.count("def test_") > 0
    }
    assert only_slow <= {"test_benchmarks.py", "test_campaigns.py", "test_carom_tracks.py"}
