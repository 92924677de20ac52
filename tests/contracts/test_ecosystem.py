"""The action of GitHub, the hook of pre-commit, editors and completion in shells, as those programs use them."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import jsonschema
import pytest
import yaml
from language_server import LanguageServer

from mouse_cli.cli.main import _run
from mouse_cli.formats.yaml_deck.reference import schema

TOP = Path(__file__).resolve().parents[2]
EXAMPLE = TOP / "docs" / "example-repository"
ACTION = yaml.safe_load((TOP / "action.yml").read_text("utf-8"))
HOOKS = yaml.safe_load((TOP / ".pre-commit-hooks.yaml").read_text("utf-8"))
BASH, ZSH, FISH, GIT = (shutil.which(name) for name in ("bash", "zsh", "fish", "git"))

needs_bash = pytest.mark.skipif(not BASH, reason="no bash on this system")


@pytest.fixture(scope="module")
def programs(tmp_path_factory) -> Path:
    """A folder with the installed `mouse`, and a `pip` that tells what it was to install."""
    folder = tmp_path_factory.mktemp("bin")
    scripts = {"mouse": f"exec '{sys.executable}' -m mouse_cli \"$@\"", "pip": 'printf "pip <%s>\\n" "$@"'}
    for name, script in scripts.items():
        (folder / name).write_text(f"#!/bin/sh\n{script}\n")
        (folder / name).chmod(0o755)
    return folder


def environment(programs: Path, **more: str) -> dict[str, str]:
    """Variables of a program that finds `mouse`."""
    path = f"{programs}{os.pathsep}{os.environ['PATH']}"
    return {**os.environ, "PATH": path, "PYTHONPATH": str(TOP), "OPENBLAS_NUM_THREADS": "1", **more}


@pytest.fixture
def repository(tmp_path) -> Path:
    """A copy of the example repository."""
    return Path(shutil.copytree(EXAMPLE, tmp_path / "example"))


# The action


def test_action_has_what_github_asks_for():
    """https://docs.github.com/actions/reference/metadata-syntax-for-github-actions, composite actions."""
    assert set(ACTION) == {"name", "description", "inputs", "outputs", "runs"}
    assert all(set(each) == {"description", "default"} for each in ACTION["inputs"].values())
    assert all(isinstance(each["default"], str) for each in ACTION["inputs"].values())
    assert all(set(each) == {"description", "value"} for each in ACTION["outputs"].values())
    assert set(ACTION["runs"]) == {"using", "steps"} and ACTION["runs"]["using"] == "composite"
    for step in ACTION["runs"]["steps"]:
        assert ("run" in step) != ("uses" in step)
        assert set(step) <= ({"name", "id", "shell", "env", "run", "if"} if "run" in step else {"name", "uses", "with"})
        assert "run" not in step or step["shell"] == "bash"
    told = (TOP / "docs" / "how-to" / "ci.md").read_text("utf-8")
    for name, each in ACTION["inputs"].items():
        assert f"| `{name}` | {'`' + each['default'] + '` ' if each['default'] else ''}|" in told


def test_no_input_becomes_a_part_of_a_script():
    workflow = yaml.safe_load((EXAMPLE / ".github/workflows/mouse.yml").read_text("utf-8"))
    steps = [*ACTION["runs"]["steps"], *workflow["jobs"]["decks"]["steps"]]
    assert [each for each in steps if "run" in each]
    assert not [each for each in steps if "${{" in each.get("run", "")]


def act(folder: Path, programs: Path, **inputs: str) -> tuple[int, str, dict[str, str]]:
    """Exit code, what is printed, and what the output files hold, of the steps of the action as GitHub's runner runs them."""
    given = {name: each["default"] for name, each in ACTION["inputs"].items()} | inputs
    values = {f"inputs.{name}": value for name, value in given.items()} | {"github.action_path": "/the action"}
    files = {name: folder.parent / name for name in ("GITHUB_OUTPUT", "GITHUB_STEP_SUMMARY")}
    printed, code = "", 0
    for step in ACTION["runs"]["steps"]:
        if "run" not in step or code:
            continue
        variables = {
            name: re.sub(r"\$\{\{ (\S+) \}\}", lambda at: values[at[1]], text) for name, text in step["env"].items()
        }
        variables |= {name: str(path) for name, path in files.items()}
        (folder.parent / "step.sh").write_text(step["run"])
        done = subprocess.run(
            [BASH, "--noprofile", "--norc", "-eo", "pipefail", str(folder.parent / "step.sh")], cwd=folder, text=True,
            env=environment(programs, **variables), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120,
        )  # fmt: skip
        printed, code = printed + done.stdout, done.returncode
    return code, printed, {name: path.read_text("utf-8") for name, path in files.items() if path.exists()}


@needs_bash
def test_action_runs_a_manifest(repository, programs):
    manifest = repository / "jobs.yaml"
    manifest.write_text(manifest.read_text("utf-8").partition("  - decks: decks/cantilever")[0])
    code, printed, told = act(repository, programs, decks="jobs.yaml\n", options="--jobs 1\n --confidence 95")
    assert code == 0, printed
    assert "pip <install>\npip </the action>\n" in printed
    assert told["GITHUB_OUTPUT"] == "exit-code=0\n" and "0 of 2 missed" in told["GITHUB_STEP_SUMMARY"]
    results = repository / "mouse-results"
    assert ElementTree.parse(results / "junit.xml").getroot()[0].get("tests") == "2"
    assert len(list((results / "pages").glob("*.html"))) == 2 and (results / "table.csv").exists()


@needs_bash
@pytest.mark.parametrize("linked", [False, True])
def test_action_takes_no_answers_from_the_checkout(repository, programs, linked):
    """A forged answer, or a link to write through, is refused before anything runs."""
    results = repository / "mouse-results"
    if linked:
        results.symlink_to(repository.parent)
    else:
        results.mkdir()
    code, printed, told = act(repository, programs, decks="decks/table_5_2.dat", command="check")
    assert code == 2 and told["GITHUB_OUTPUT"] == "exit-code=2\n" and "the checkout does not have" in printed
    assert not list(results.glob("junit.xml"))


@needs_bash
def test_action_fails_as_mouse_does_and_inputs_are_data(repository, programs):
    hostile = "$(touch made); touch made\n--help"
    code, printed, told = act(repository, programs, decks=hostile, results="$(touch made)", command="check")
    assert code == 4 and told["GITHUB_OUTPUT"] == "exit-code=4\n"
    assert sorted(path.name for path in repository.iterdir() if "made" in path.name) == ["$(touch made)"]
    assert "MD250" in printed and "Usage" not in printed
    hostile = "--brief;touch made"
    code, printed, told = act(repository, programs, decks="decks/table_5_2.dat", options=hostile, command="check")
    assert code in (2, 4) and not (repository / "made").exists()


# The hook


def test_hook_has_what_pre_commit_asks_for():
    """https://pre-commit.com/#creating-new-hooks: id, name, entry and language are required."""
    (hook,) = HOOKS
    assert set(hook) == {"id", "name", "description", "entry", "args", "language", "files", "require_serial"}
    matches = re.compile(hook["files"]).search
    assert all(map(matches, ("decks/a.yaml", "decks/a.yml", "rigs/decks/old/b.dat")))
    assert not any(
        map(matches, ("jobs.yaml", ".github/workflows/mouse.yml", "mydecks/a.yaml", "decks/a.yaml.orig", "decks/m.mtx"))
    )
    config = yaml.safe_load((EXAMPLE / ".pre-commit-config.yaml").read_text("utf-8"))
    assert config["repos"][0]["hooks"][0]["id"] == hook["id"]


def git(folder: Path, *words: str) -> None:
    author = ["-c", "user.name=a", "-c", "user.email=a@example.com", "-c", "commit.gpgsign=false"]
    subprocess.run([GIT, *author, *words], cwd=folder, check=True, capture_output=True, timeout=60)


@pytest.mark.skipif(not GIT, reason="no git on this system")
def test_hook_run_by_pre_commit(repository, programs, tmp_path):
    """Of a repository with the definition of the hook; `language: system`, for that of Python would install from a network."""
    pytest.importorskip("pre_commit", reason="pre-commit is not installed")
    pre_commit, home = (
        [sys.executable, "-m", "pre_commit"],
        environment(programs, PRE_COMMIT_HOME=str(tmp_path / "home")),
    )

    def ran(*words: str) -> subprocess.CompletedProcess:
        done = subprocess.run(
            [*pre_commit, *words], cwd=repository, env=home, capture_output=True, text=True, timeout=120
        )
        return done

    assert ran("validate-manifest", str(TOP / ".pre-commit-hooks.yaml")).returncode == 0
    assert ran("validate-config", str(EXAMPLE / ".pre-commit-config.yaml")).returncode == 0
    tool = tmp_path / "mouse"
    tool.mkdir()
    definition = (TOP / ".pre-commit-hooks.yaml").read_text("utf-8")
    (tool / ".pre-commit-hooks.yaml").write_text(definition.replace("language: python", "language: system"))
    for folder in (tool, repository):
        git(folder, "init", "-q")
        git(folder, "add", "-A", "-f")
        git(folder, "commit", "-q", "-m", "first")
    git(tool, "tag", "v0.1.0")
    config = repository / ".pre-commit-config.yaml"
    config.write_text(config.read_text("utf-8").replace("https://git.example.com/tools/mouse", str(tool)))
    well = ran("run", "--all-files")
    assert well.returncode == 0 and "Passed" in well.stdout, well.stdout + well.stderr
    deck = repository / "decks" / "cantilever.yaml"
    deck.write_text(deck.read_text("utf-8").replace("units: SI", "unit: SI"))
    git(repository, "add", "decks", ".pre-commit-config.yaml")
    broken = ran("run")
    assert broken.returncode == 1 and "decks/cantilever.yaml:6:1: error[MD210]" in broken.stdout
    assert "1 deck checked" in broken.stdout


# Editors

SERVER = shutil.which("yaml-language-server")


def test_schema_tells_what_every_key_means():
    whole = schema()
    assert whole["$id"] == "urn:mouse:deck:1" and whole["title"] and whole["description"]

    def below(part: object) -> None:
        if isinstance(part, dict):
            for name, key in part.get("properties", {}).items():
                assert set(key) == {"not"} or key["description"].strip(), f"nothing is said of {name}"
        for each in part.values() if isinstance(part, dict) else part if isinstance(part, list) else ():
            below(each)

    below(whole)


MANIFEST = (EXAMPLE / "jobs.yaml").read_text("utf-8")
DAMAGES = [
    ("batch:", "jobs:"),
    ("  - decks: decks/table_5_2.dat", "  - deck: decks/table_5_2.dat"),
    ("options: {cycles: 2}", "options: {cycle: 2}"),
    ("options: {cycles: 2}", "options: [cycles]"),
    ("command: diagnose", "command: guess"),
    ("command: diagnose", "causes: 3"),
    ("expect: {exit: 0}", "expect: converged"),
]


@pytest.mark.parametrize(("old", "new"), DAMAGES)
def test_schema_and_reader_refuse_the_same_manifests(repository, capsys, old, new):
    jsonschema.validate(yaml.safe_load(MANIFEST), schema())
    assert _run(["check", str(repository / "jobs.yaml")]) == 0
    damaged = MANIFEST.replace(old, new, 1)
    assert damaged != MANIFEST and not jsonschema.Draft202012Validator(schema()).is_valid(yaml.safe_load(damaged))
    (repository / "jobs.yaml").write_text(damaged, "utf-8")
    assert _run(["check", str(repository / "jobs.yaml")]) == 4


@pytest.mark.skipif(not SERVER, reason="yaml-language-server is not in the PATH")
def test_editors_complete_explain_and_mark_keys(repository):
    (repository / "deck.schema.json").write_text(json.dumps(schema()))
    settings = {"schemas": {"./deck.schema.json": ["decks/**/*.yaml", "jobs.yaml"]}, "schemaStore": {"enable": False}}
    settings |= {"validate": True, "completion": True, "hover": True}
    deck = (repository / "decks" / "cantilever.yaml").read_text("utf-8")
    with LanguageServer(SERVER, repository, settings) as server:
        assert server.complaints(server.open("decks/good.yaml", deck)) == []
        assert server.complaints(server.open("jobs.yaml", MANIFEST)) == []
        (wrong,) = server.complaints(server.open("decks/bad.yaml", deck.replace("units: SI", "unit: SI")))
        assert wrong["message"] == "Property unit is not allowed." and wrong["range"]["start"]["line"] == 5
        begun = "mouse: 1\ntest:\n  modes:\n    frequency: [1]\n    \n"
        uri = server.open("decks/begun.yaml", begun)
        offered = {each["label"] for each in server.at("completion", uri, 4, 4)["items"]}
        assert {"frequency_sd", "dofs", "shapes", "shape_sd"} <= offered and "parameters" not in offered
        assert "natural frequencies" in str(server.at("hover", uri, 3, 6)) and "Hz" in str(
            server.at("hover", uri, 3, 6)
        )
        line = "# yaml-language-server: $schema=../deck.schema.json\n"
        uri = server.open("elsewhere/jobs.yaml", f"{line}mouse: 1\nbatch:\n  - decks: a.yaml\n    \n")
        offered = {each["label"] for each in server.at("completion", uri, 4, 4)["items"]}
        assert offered == {"command", "options", "candidates", "causes", "expect"}


# Shells

LINES = {  # what is typed before Tab, and what then stands there
    "mouse run decks/cant": "mouse run decks/cantilever.yaml",
    "mouse diagnose --candidates gravity,ground-sp": "mouse diagnose --candidates gravity,ground-spring",
    "mouse explain MD211": "mouse explain MD211",
}
MORE = {  # asked of bash alone
    "mouse cor": "mouse correlate",
    "mouse run --recursion anch": "mouse run --recursion anchored",
    "mouse run --estimator max": "mouse run --estimator maximum-likelihood",
    "mouse report res": "mouse report result.json",
    "mouse run decks/cantilever.yaml --loosen cl": "mouse run decks/cantilever.yaml --loosen clamp=",
}
TO_START, TAB = "\x01", "\t"


def typed(words: list[str], lines: list[str], folder: Path, variables: dict[str, str]) -> str:
    """What a shell prints on a terminal on which these lines are typed."""
    import pty

    ours, theirs = pty.openpty()
    process = subprocess.Popen(
        words, cwd=folder, env=variables, stdin=theirs, stdout=theirs, stderr=theirs, start_new_session=True
    )
    os.close(theirs)
    os.write(ours, "".join(f"{line}\n" for line in [*lines, "exit"]).encode())
    told = b""
    try:
        while part := os.read(ours, 65536):
            told += part
    except OSError:  # the terminal is closed: the shell has ended
        pass
    finally:
        os.close(ours)
        process.wait(timeout=60)
    return told.decode("utf-8", "replace").replace("\r", "")


@pytest.mark.skipif(os.name != "posix", reason="no terminals of POSIX")
@pytest.mark.parametrize("shell", ["bash", "zsh"])
def test_shells_complete_what_is_typed(shell, repository, programs, no_hang):
    if not shutil.which(shell):
        pytest.skip(f"no {shell} on this system")
    (repository / "result.json").touch()
    words = [shell, "--norc", "--noprofile", "-i"] if shell == "bash" else [shell, "-f", "-i"]
    begin = [] if shell == "bash" else ["autoload -U compinit && compinit -u -D", "LISTMAX=0"]
    wanted = LINES | (MORE if shell == "bash" else {})
    lines = [f"{line}{TAB}{TO_START}echo told: " for line in wanted]
    variables = environment(programs, TERM="dumb", PS1="", HOME=str(repository.parent), INPUTRC="/dev/null")
    told = typed(words, [*begin, f"source <(mouse completion {shell})", *lines], repository, variables)
    for line in wanted.values():
        assert re.search(rf"^told: {re.escape(line)} ?$", told, re.MULTILINE), f"{line}\n{told}"


@pytest.mark.skipif(not FISH, reason="no fish on this system")
def test_fish_completes(repository, programs):
    script = "mouse completion fish | source\n" + "\n".join(f"complete -C '{line}'" for line in LINES)
    variables = environment(programs, HOME=str(repository.parent))
    done = subprocess.run(
        [FISH, "--no-config", "-c", script], cwd=repository, env=variables, capture_output=True, text=True, timeout=60
    )
    told = {line.partition("\t")[0] for line in done.stdout.splitlines()}
    assert {line.split()[-1] for line in LINES.values()} == told
