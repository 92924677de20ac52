"""What is handed out: a source distribution with everything, a wheel with the program alone, both installed and run."""

import os
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from email.parser import Parser
from pathlib import Path

import pytest

import mouse_cli

TOP = Path(__file__).resolve().parents[2]
_NOT_OURS = shutil.ignore_patterns(
    "__pycache__", "*.py[cod]", "*.egg-info", ".git", ".venv", "build", "dist", ".pytest_cache", ".ruff_cache", ".hypothesis"
)  # fmt: skip
_BUILD = "from setuptools import build_meta; import sys; print(getattr(build_meta, sys.argv[1])(sys.argv[2]))"
_INFO = f"mouse_cli-{mouse_cli.__version__}.dist-info"


def called(*command: object, cwd: Path, **environment: str) -> str:
    """Standard output of a command that must succeed."""
    variables = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"} | environment
    words = [str(word) for word in command]
    done = subprocess.run(words, cwd=cwd, env=variables, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, f"{words}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def built(source: Path, what: str) -> Path:
    """The distribution made of a folder, by the backend that pyproject.toml names, without a network."""
    folder = source.parent / f"{source.name}-dist"
    folder.mkdir(exist_ok=True)
    return folder / called(sys.executable, "-c", _BUILD, what, folder, cwd=source).splitlines()[-1]


@pytest.fixture(scope="module")
def source(tmp_path_factory) -> Path:
    """A copy of the project, where building leaves its traces."""
    import setuptools

    if int(setuptools.__version__.partition(".")[0]) < 77:
        pytest.skip("setuptools is older than pyproject.toml asks for")
    folder = tmp_path_factory.mktemp("packaging") / "mouse"
    folder.mkdir()
    for name in _entries():
        if (TOP / name).is_dir():
            shutil.copytree(TOP / name, folder / name, ignore=_NOT_OURS)
        else:
            shutil.copy(TOP / name, folder)
    return folder


def _entries() -> set[str]:
    """What lies at the top of the project; where git knows it, without what is there by chance."""
    if not (TOP / ".git").exists() or not shutil.which("git"):
        return {path.name for path in TOP.iterdir()} - _NOT_OURS(str(TOP), [path.name for path in TOP.iterdir()])
    return {name.partition("/")[0] for name in called("git", "ls-files", cwd=TOP).splitlines()}


@pytest.fixture(scope="module")
def sdist(source) -> Path:
    return built(source, "build_sdist")


@pytest.fixture(scope="module")
def wheel(source) -> Path:
    return built(source, "build_wheel")


@pytest.fixture(scope="module")
def unpacked(sdist) -> Path:
    """The folder within the source distribution."""
    with tarfile.open(sdist) as archive:
        archive.extractall(sdist.parent, filter="data")
    return sdist.parent / sdist.name.removesuffix(".tar.gz")


def below(folder: Path) -> set[str]:
    """Files below a folder, as relative names, without what building leaves there."""
    names = {path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}
    return {name.as_posix() for name in names if "egg-info" not in str(name) and name.parts[0] != "build"}


def names(wheel: Path) -> set[str]:
    with zipfile.ZipFile(wheel) as archive:
        return set(archive.namelist())


def test_source_distribution_has_everything_that_tests_need(source, unpacked):
    """All files of the project; only what names files for git stays out."""
    made = {"PKG-INFO", "setup.cfg"}
    assert below(unpacked) - made == below(source) - {".gitignore"}


def test_wheel_has_the_whole_package_and_nothing_else(source, wheel):
    inside = names(wheel)
    package = {name for name in below(source) if name.startswith("mouse_cli/")}
    assert {name for name in inside if not name.startswith(_INFO)} == package
    assert {Path(name).suffix for name in package} == {".py", ".json", ".css", ".js", ".typed"}
    own = {
        f"{_INFO}/{name}"
        for name in ("METADATA", "RECORD", "WHEEL", "entry_points.txt", "licenses/LICENSE", "top_level.txt")
    }
    assert {name for name in inside if name.startswith(_INFO)} == own


def test_wheel_of_the_source_distribution_is_the_same(wheel, unpacked):
    again = built(unpacked, "build_wheel")
    assert names(again) == names(wheel)
    with zipfile.ZipFile(wheel) as one, zipfile.ZipFile(again) as other:
        assert all(one.read(name) == other.read(name) for name in one.namelist())


def test_metadata(wheel):
    with zipfile.ZipFile(wheel) as archive:
        told = Parser().parsestr(archive.read(f"{_INFO}/METADATA").decode("utf-8"))
        points = archive.read(f"{_INFO}/entry_points.txt").decode()
        tags = archive.read(f"{_INFO}/WHEEL").decode()
    assert (told["Name"], told["Version"]) == ("mouse-cli", mouse_cli.__version__)
    assert (told["License-Expression"], told["License-File"]) == ("BSD-3-Clause", "LICENSE")
    assert told["Requires-Python"] == ">=3.11" and "Tag: py3-none-any" in tags
    needed = {each.partition(">")[0] for each in told.get_all("Requires-Dist") if "extra ==" not in each}
    assert needed == {"numpy", "scipy", "click", "pyyaml"}
    assert "mouse = mouse_cli.cli.main:main" in points
    assert told["Description-Content-Type"] == "text/markdown" and "# mouse" in told.get_payload()


def reachable(folder: Path, *packages: str) -> str:
    """A folder from which these packages of this environment are found, and no others."""
    folder.mkdir()
    for place in {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}:
        for path in Path(place).iterdir():
            if path.name.partition("-")[0].partition(".")[0] in packages:
                (folder / path.name).symlink_to(path)
    return str(folder)


@pytest.mark.parametrize("kind", ["wheel", "sdist"])
def test_it_installs_into_a_plain_environment_and_runs(kind, request, tmp_path):
    """Without a network: numpy and the like are reached by a path, mouse is what pip has installed."""
    handed_out = request.getfixturevalue(kind)
    here, empty = tmp_path / "venv", tmp_path / "empty"
    empty.mkdir()
    called(sys.executable, "-m", "venv", "--without-pip", here, cwd=tmp_path)
    pip = [sys.executable, "-m", "pip", "--python", here / "bin" / "python", "--disable-pip-version-check", "install"]
    backend = reachable(tmp_path / "backend", "setuptools", "_distutils_hack")
    called(*pip, "--no-deps", "--no-index", "--no-build-isolation", handed_out, cwd=empty, PYTHONPATH=backend)
    needs = reachable(tmp_path / "needs", "numpy", "numpy.libs", "scipy", "click", "yaml", "_yaml")
    python, mouse = here / "bin" / "python", here / "bin" / "mouse"
    shutil.copy(TOP / "decks" / "table_5_2.dat", empty)
    where = called(python, "-c", "import mouse_cli; print(mouse_cli.__file__)", cwd=empty, PYTHONPATH=needs)
    assert Path(where.strip()).is_relative_to(here)
    arguments = ["run", "table_5_2.dat", "--scale", "none", "--cycles", "2"]
    assert "2.25103+05" in called(mouse, *arguments, cwd=empty, PYTHONPATH=needs)  # Table 5-2 of the report of 1972
    if kind == "sdist":  # whose wheel is the same
        return
    called(mouse, *arguments, "--json", "-o", "result.json", cwd=empty, PYTHONPATH=needs)
    called(mouse, "report", "result.json", "-o", "report.html", cwd=empty, PYTHONPATH=needs)
    assert (empty / "report.html").read_text("utf-8").startswith("<!DOCTYPE html>")
    assert '"title": "mouse deck' in called(mouse, "explain", "schema", cwd=empty, PYTHONPATH=needs)
