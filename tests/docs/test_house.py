"""The map of the house is drawn from what the tests of the architecture hold to, and the pages name what exists."""

import importlib.util
import re
import sys
import tomllib
from pathlib import Path

import yaml
from pages import DOCS, PAGES, TOP

from mouse_cli import __version__


def _module(name: str, path: Path):
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def test_rows_of_the_map_are_the_ranks_that_imports_obey():
    ranks = _module("architecture", TOP / "tests" / "test_architecture.py").RANKS
    rows = _module("layers_map", DOCS / "layers_map.py").layers()
    by_rank = [
        {name for name, rank in ranks.items() if rank == each} for each in sorted(set(ranks.values()), reverse=True)
    ]
    assert [set(row) for row in rows] == by_rank
    assert {name for row in rows for name in row} == {p.parent.name for p in (TOP / "mouse_cli").glob("*/__init__.py")}


def test_map_shows_every_package():
    drawn = (DOCS / "explanation" / "layers.svg").read_text("utf-8")
    for package in (TOP / "mouse_cli").glob("*/__init__.py"):
        assert f">{package.parent.name}</text>" in drawn


def test_paths_of_the_program_that_pages_name_exist():
    for page in (*PAGES, TOP / "README.md", TOP / "CONTRIBUTING.md"):
        for name in re.findall(r"`(mouse_cli/[\w/.]+)`", page.read_text("utf-8")):
            assert (TOP / name).exists() or (TOP / f"{name}.py").exists(), f"{page.name}: {name}"


def test_citation_has_name_version_and_licence_of_the_package():
    cited = yaml.safe_load((TOP / "CITATION.cff").read_text("utf-8"))
    project = tomllib.loads((TOP / "pyproject.toml").read_text("utf-8"))["project"]
    assert {"cff-version", "message", "title", "authors"} <= set(cited)
    assert (cited["license"], cited["version"]) == (project["license"], __version__)


def test_types_are_shipped():
    built = tomllib.loads((TOP / "pyproject.toml").read_text("utf-8"))["tool"]["setuptools"]["package-data"][
        "mouse_cli"
    ]
    assert "py.typed" in built and (TOP / "mouse_cli" / "py.typed").exists()


def test_container_has_what_the_program_imports():
    """Each dependency as the package of Debian, with setuptools to build and pip to install without an index."""
    text = (TOP / "Containerfile").read_text("utf-8")
    needed = tomllib.loads((TOP / "pyproject.toml").read_text("utf-8"))["project"]["dependencies"]
    names = {re.match(r"[\w-]+", each)[0].removeprefix("py") for each in needed}
    assert set(re.findall(r"python3-(\w+)", text)) == names | {"pip", "setuptools"}
    assert "--no-index" in text and "--no-deps" in text
