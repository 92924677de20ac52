"""The house as CONTRIBUTING.md describes it: layers, who may print and exit, what loads what."""

import ast
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1] / "mouse_cli"
FILES = sorted(PACKAGE.rglob("*.py"))

# From the top down: a folder imports its own rank and those below.
RANKS = {
    "cli": 8,
    "batch": 7,
    "campaigns": 7,
    "api": 7,
    "page": 7,
    "report": 6,
    "plots": 6,
    "diagnosis": 5,
    "updating": 4,
    "coupling": 4,
    "methods": 4,
    "importing": 4,
    "estimators": 3,
    "observables": 3,
    "terms": 2,
    "dynamics": 2,
    "formats": 2,
    "records": 2,
    "codes": 1,
    "model": 1,
}
OPTIONAL = {
    "matplotlib",
    "h5py",
    "pyuff",
    "pyyeti",
    "nptdms",
    "soundfile",
    "sdypy",
    "pyoma2",
    "dask",
    "distributed",
    "emcee",
}
HEAVY = {"scipy", "yaml"}  # never at the head of a module: a small card deck needs neither


@cache
def parsed(path: Path) -> ast.Module:
    """The syntax tree of a file."""
    return ast.parse(path.read_text())


@cache
def imported(path: Path, head_only: bool = False) -> set[str]:
    """Dotted names that the module imports, anywhere or at its head."""
    nodes = parsed(path).body if head_only else ast.walk(parsed(path))
    names = set()
    for node in nodes:
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {node.module} | {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def rank(dotted: str) -> int:
    """Rank of `mouse_cli.folder...`; 0 for the top-level modules that all may use."""
    parts = dotted.split(".")
    return RANKS.get(parts[1], 0) if len(parts) > 1 else 0


def offenders(breach: Callable[[Path], object]) -> dict[str, object]:
    """What `breach` finds in files of the package that break a rule, by their names; of a file that keeps it nothing."""
    return {str(path.relative_to(PACKAGE)): found for path in FILES if (found := breach(path))}


def test_imports_go_down_only():
    def upward(path: Path) -> set[str]:
        own = RANKS.get(path.relative_to(PACKAGE).parts[0], 0)
        if path.parent == PACKAGE:
            own = 99 if path.name in ("__init__.py", "__main__.py") else 0
        return {name for name in imported(path) if name.startswith("mouse_cli.") and rank(name) > own}

    assert offenders(upward) == {}


def module(path: Path) -> str:
    """Dotted name of a file of the package; of `__init__.py` that of its folder."""
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def for_type_checkers(branch: ast.If) -> bool:
    """Whether a branch is `if TYPE_CHECKING`."""
    return any(
        "TYPE_CHECKING" in (getattr(part, "id", ""), getattr(part, "attr", "")) for part in ast.walk(branch.test)
    )


def run_nodes(node: ast.AST) -> Iterator[ast.AST]:
    """All that stands below `node`, in functions too, without what is for type checkers alone."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.If) and for_type_checkers(child):
            for other in child.orelse:
                yield other
                yield from run_nodes(other)
        else:
            yield child
            yield from run_nodes(child)


def import_graph(sources: dict[str, ast.Module], folders: set[str]) -> dict[str, set[str]]:
    """For each module, by name and syntax tree, the modules of the package that it imports; `folders`: those that are packages.

    `from a.b import c` needs a.b.c where that is a module, else a.b; packages above them are not counted. What `_registry` finds
    in a folder is not named in any import, and is not counted either.
    """
    graph: dict[str, set[str]] = {}
    for own, tree in sources.items():
        needed = set()
        for node in run_nodes(tree):
            if isinstance(node, ast.Import):
                needed |= {alias.name for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                up = own.split(".")[: (own in folders) - node.level or None] if node.level else []
                start = ".".join([*up, *([node.module] if node.module else [])])
                inside = {alias.name: f"{start}.{alias.name}" for alias in node.names}
                needed |= {name if name in sources else start for name in inside.values()}
        graph[own] = needed & sources.keys() - {own}
    return graph


def circles(graph: dict[str, set[str]]) -> list[list[str]]:
    """Strongly connected components of more than one module."""
    reached = {}
    for start in graph:
        seen, todo = set(), [start]
        while todo:
            new = graph[todo.pop()] - seen
            seen |= new
            todo += new
        reached[start] = seen
    found = {tuple(sorted(b for b in reached[a] if a in reached[b])) for a in graph if a in reached[a]}
    return [list(circle) for circle in sorted(found)]


def test_circles_are_found():
    """Imports in functions and relative ones count; those for type checkers do not."""
    sources = {
        "p": "",
        "p.a": "def f():\n    from p.b import g",
        "p.b": "import p.c\ng = 1",
        "p.c": "from .a import f",
        "p.q": "from p.q import d",
        "p.q.d": "from ..q import name",
        "p.e": "if TYPE_CHECKING:\n    from p.f import g",
        "p.f": "from p.e import g",
    }
    trees = {name: ast.parse(text) for name, text in sources.items()}
    assert circles(import_graph(trees, {"p", "p.q"})) == [["p.a", "p.b", "p.c"], ["p.q", "p.q.d"]]


def test_imports_make_no_circle():
    """Whatever two modules both need stands below them."""
    trees = {module(path): parsed(path) for path in FILES}
    assert circles(import_graph(trees, {module(path) for path in FILES if path.name == "__init__.py"})) == []


KINDS_OF_DATA = {"frf", "history", "configurations"}


def test_only_likelihoods_know_kinds_of_data():
    house, below = PACKAGE / "diagnosis", "mouse_cli.diagnosis.likelihoods."

    def kinds(path: Path) -> set[str]:
        if not path.is_relative_to(house) or path.is_relative_to(house / "likelihoods"):
            return set()
        parts = {name.removeprefix(below).split(".")[0] for name in imported(path) if name.startswith(below)}
        return parts & KINDS_OF_DATA

    assert offenders(kinds) == {}


def test_what_physics_does_knows_nothing_of_the_search_for_it():
    """A mechanism, its effect and its site are the same for whatever looks for them."""
    house = PACKAGE / "diagnosis"
    above = tuple(f"mouse_cli.diagnosis.{name}." for name in ("search", "localise", "validate"))
    files = [path for folder in ("mechanisms", "effects", "sites") for path in (house / folder).glob("*.py")]
    assert not {(path.name, name) for path in files for name in imported(path) if name.startswith(above)}


def test_every_folder_has_a_rank():
    folders = {p.name for p in PACKAGE.iterdir() if p.is_dir() and any(p.glob("*.py"))}
    assert folders == set(RANKS)


def packages(names: set[str]) -> set[str]:
    """Top-level packages of dotted names."""
    return {name.split(".")[0] for name in names}


def called(path: Path) -> list[tuple[str, ast.Call]]:
    """All calls in a file, by the dotted names of what they call; "" where that is no name."""
    return [(dotted(node.func), node) for node in ast.walk(parsed(path)) if isinstance(node, ast.Call)]


def dotted(node: ast.expr) -> str:
    """`a.b.c` of names and attributes."""
    if isinstance(node, ast.Attribute):
        return f"{dotted(node.value)}.{node.attr}"
    return node.id if isinstance(node, ast.Name) else ""


def test_nothing_below_the_command_line_prints_or_exits():
    speaks = {"print", "exit", "quit", "input", "sys.exit", "os._exit"}

    def breach(path: Path) -> set[str]:
        if "cli" in path.relative_to(PACKAGE).parts[:1] or path.name == "__main__.py":
            return set()
        return {name for name, _ in called(path)} & speaks | packages(imported(path)) & {"click"}

    assert offenders(breach) == {}


def test_heavy_packages_are_loaded_where_they_are_used():
    def heavy(path: Path) -> set[str]:
        allowed = {"yaml"} if path.parent.name == "yaml_deck" else set()
        return packages(imported(path, head_only=True)) & (HEAVY | OPTIONAL) - allowed

    assert offenders(heavy) == {}


def test_files_fit_a_mind_and_functions_a_screen():
    def large(path: Path) -> dict[str, int]:
        functions = [node for node in ast.walk(parsed(path)) if isinstance(node, ast.FunctionDef)]
        long = {f.name: length for f in functions if (length := f.end_lineno - f.lineno + 1) > 40}
        lines = len(path.read_text().splitlines())
        return long | ({"lines": lines} if lines > 300 else {})

    assert offenders(large) == {}


STARTS_A_PROGRAM = Path(
    "importing/calculix.py"
)  # the solver that `mouse import` is asked to run, by a name that is fixed
HANDS_OVER = Path("diagnosis/search/handed.py")  # fits, between processes of one search; never what a file holds
READS_APART = Path("formats/isolated.py")  # a process of its own that reads, and what it read, by pipes that no file holds
UNSAFE = {  # what makes code of data, or a shell of a name
    "eval", "exec", "compile", "__import__", "os.system", "os.popen", "yaml.load", "yaml.load_all", "yaml.unsafe_load",
    "yaml.full_load", "pickle.load", "pickle.loads", "marshal.loads", "shelve.open", "joblib.load", "pandas.read_pickle",
}  # fmt: skip


def test_data_are_never_code():
    """Decks, recordings and answers are read as data: no pickles, no YAML objects, no programs started."""
    makes_code = {"pickle", "marshal", "shelve", "dill", "joblib", "subprocess"}
    may = {STARTS_A_PROGRAM: {"subprocess"}, HANDS_OVER: {"pickle"}, READS_APART: {"subprocess", "pickle"}}

    def breach(path: Path) -> set[str]:
        calls = called(path)
        loads = [call for name, call in calls if name in ("np.load", "numpy.load")]
        words = [{word.arg: ast.unparse(word.value) for word in call.keywords} for call in loads]
        allowed = may.get(path.relative_to(PACKAGE), set())
        found = {name for name, _ in calls if name != "pickle.load" or "pickle" not in allowed} & UNSAFE
        found |= packages(imported(path)) & makes_code - allowed
        found |= {"load with pickles" for own in words if own.get("allow_pickle") != "False"}
        return found | {"shell" for _, call in calls if "shell" in {word.arg for word in call.keywords}}

    assert offenders(breach) == {}


def loaded(statement: str) -> set[str]:
    """Top-level packages in memory after `statement` in a fresh interpreter."""
    code = f"import sys; {statement}; print(*{{m.split('.')[0] for m in sys.modules}})"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.splitlines()[-1].split())


def test_import_loads_nothing_heavy():
    assert not loaded("import mouse_cli") & {"numpy", "scipy", "click", "yaml", "matplotlib"}


def test_a_deck_of_matrices_is_updated_without_what_numpy_loads_when_first_asked():
    """Masked arrays, which sets of numbers ask for, and polynomials take a tenth of the start-up of a small deck."""
    deck = str(PACKAGE.parent / "decks" / "table_5_2.dat")
    run = f"from mouse_cli.cli.main import cli; cli.main(['run', {deck!r}], standalone_mode=False)"
    code = f"import sys; {run}; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not set(done.stdout.splitlines()[-1].split()) & {"numpy.ma", "numpy.polynomial"}


def test_version_needs_no_numpy():
    run = "from mouse_cli.cli.main import cli; cli.main(['--version'], standalone_mode=False)"
    assert not loaded(run) & {"numpy", "scipy", "yaml", "matplotlib"}


def test_help_needs_no_numpy_and_has_the_words_of_the_commands():
    from click import Context, Group, HelpFormatter

    from mouse_cli.cli.main import cli

    run = "from mouse_cli.cli.main import cli; cli.main(['--help'], standalone_mode=False)"
    assert not loaded(run) & {"numpy", "scipy", "yaml", "matplotlib"}
    told, of_click = HelpFormatter(width=78), HelpFormatter(width=78)
    cli.format_commands(Context(cli), told)
    Group.format_commands(cli, Context(cli), of_click)
    assert told.getvalue() == of_click.getvalue()


def test_small_card_deck_needs_numpy_alone():
    deck = PACKAGE.parent / "decks" / "table_5_2.dat"
    run = f"from mouse_cli.cli.main import cli; cli.main(['run', {str(deck)!r}, '-q'], standalone_mode=False)"
    assert not loaded(run) & {"scipy", "yaml", "matplotlib"}


def test_long_proofs_are_there_and_have_shorter_ones_beside_them():
    """tests/proofs.py names tests that files have, and never all of a file."""
    from proofs import LONG

    for path, names in LONG.items():
        text, own = (PACKAGE.parent / "tests" / path).read_text(), {name.partition("[")[0] for name in names}
        assert all(f"def {name}(" in text for name in own), path
        whole = {name for name in own if name in names}
        assert set(re.findall(r"def (test_\w+)\(", text)) > whole, path


def test_quick_tests_are_of_every_package_and_are_there():
    """`pytest -m quick`: tests/quick.py names files, and tests that they have."""
    from quick import QUICK

    tests, packages = PACKAGE.parent / "tests", {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    assert set(QUICK) == packages and all(QUICK.values())
    for path, _, name in (each.partition("::") for names in QUICK.values() for each in names):
        assert f"def {name}(" in (tests / path).read_text() if name else (tests / path).is_file(), path
