"""`mouse batch` as a user meets it: what is kept through kills, what is run again, and what each way to end is told as."""

import csv
import io
import json
import os
import random
import re
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from urllib.parse import unquote
from xml.etree import ElementTree

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mouse_cli._errors import MouseError
from mouse_cli.batch.expectation import Unreadable, expectation
from mouse_cli.batch.folder import held
from mouse_cli.batch.job import Job
from mouse_cli.batch.outcome import Outcome
from mouse_cli.batch.processes import outcomes
from mouse_cli.batch.summary import annotations, csv_text, junit_text, table
from mouse_cli.batch.work import perform
from mouse_cli.cli.main import _run

DECKS = Path(__file__).resolve().parents[2] / "decks"
SPRING = """\
mouse: 1
model: {{stiffness: {{order: 1, entries: [[1, 1, {k}]]}}, mass: {{diagonal: [1]}}}}
parameters: [{{name: k, sd: 10, stiffness: [[1, 1, 1]]}}]
test: {{modes: {{frequency: [{hz}], frequency_sd: 0.01}}}}
"""
IN_FILE = """\
mouse: 1
model: {stiffness: {order: 1, entries: [[1, 1, 100]]}, mass: {file: m.mtx}}
parameters: [{name: k, sd: 10, stiffness: [[1, 1, 1]]}]
test: {modes: {frequency: [1.6], frequency_sd: 0.01}}
"""
MASS = "%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 {mass}\n"


def batch(capsys, *arguments: object) -> tuple[int, str, str]:
    """Exit code, standard output and standard error of `mouse batch -j 1 ...`."""
    status = _run(["batch", "-j", "1", *(str(each) for each in arguments)])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def springs(folder: Path, count: int) -> None:
    """Decks of one mass on a spring, each with its own test."""
    folder.mkdir(exist_ok=True)
    for i in range(count):
        (folder / f"spring{i:03}.yaml").write_text(SPRING.format(k=100 + i, hz=1.6 + i / 100))


def answers(folder: Path) -> dict[str, dict]:
    """What each file of answers holds, but for the seconds that it took."""
    found = {path.name: json.loads(path.read_text()) for path in folder.glob("*.json")}
    return {name: {key: value for key, value in one.items() if key != "seconds"} for name, one in found.items()}


def written(folder: Path) -> dict[str, tuple[int, int]]:
    """Which file each answer is, and when it was written: another when it was written again."""
    return {path.name: (path.stat().st_ino, path.stat().st_mtime_ns) for path in folder.glob("*.json")}


def test_posteriors_of_a_spring_are_those_of_the_closed_form(tmp_path, capsys, monkeypatch):
    """lambda = k/m is linear in k: posterior variance 1/(1/s^2 + 1/r^2), the mean weighted by these."""
    monkeypatch.chdir(tmp_path)
    k, s, hz, sd_hz = 100.0, 10.0, 1.6, 0.01
    lam = (2 * 3.141592653589793 * hz) ** 2
    r = lam * 2 * sd_hz / hz
    variance = 1 / (1 / s**2 + 1 / r**2)
    moved = variance * (lam - k) / r**2  # the parameter is the change of k
    Path("a.yaml").write_text(SPRING.format(k=100, hz=hz))
    expected = f"posterior k: {moved} +- 1e-6, posterior sd k: {variance**0.5} +- 1e-4 %"
    told = f"mouse: 1\nbatch: [{{decks: a.yaml, options: {{recursion: anchored}}, expect: {{{expected}}}}}]\n"
    Path("good.yaml").write_text(told)
    assert batch(capsys, "good.yaml")[0] == 0
    Path("bad.yaml").write_text(told.replace(f"{moved} +-", f"{moved + 2e-6} +-"))
    status, out, _ = batch(capsys, "bad.yaml")
    assert status == 3
    assert "bad.yaml:2:" in out and "MD906" in out and "1 done before" in out


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no SIGKILL on this system")
def test_a_batch_that_is_killed_goes_on_where_it_was(tmp_path):
    springs(tmp_path / "decks", 160)
    command = [sys.executable, "-m", "mouse_cli", "batch", "decks", "-j", "2", "-q", "-o"]
    whole = subprocess.run([*command, "whole"], cwd=tmp_path, capture_output=True, text=True, timeout=120)
    lot, broken, kept = random.Random(1), tmp_path / "broken", {}
    for target in (0, 5, 30, 60, 90):
        going = subprocess.Popen([*command, "broken"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        _wait_until(lambda n=target, p=going: len(list(broken.glob("*.json"))) >= n or p.poll() is not None)
        time.sleep(lot.uniform(0, 0.03))
        below = _children(going.pid)
        going.kill()
        going.communicate()
        now = written(broken)
        assert kept.items() <= now.items(), "an answer that was there was written again"
        kept = now
        _wait_until(lambda pids=below: not any(_alive(pid) for pid in pids))
    last = subprocess.run([*command, "broken"], cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert kept.items() <= written(broken).items()
    assert last.returncode == whole.returncode and last.stderr == whole.stderr == ""
    assert last.stdout.split(", ")[0] == whole.stdout.split(", ")[0].strip()
    assert answers(broken) == answers(tmp_path / "whole") and len(kept) < 160 == len(answers(broken))
    assert [path.name for path in broken.iterdir() if path.suffix != ".json"] == [".mouse-batch"]


def _wait_until(done, seconds: float = 60) -> None:
    end = time.monotonic() + seconds
    while not done():
        assert time.monotonic() < end, "no end in sight"
        time.sleep(0.002)


def _children(pid: int) -> list[int]:
    try:
        return [int(each) for each in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except OSError:
        return []


def _alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


def test_only_what_has_changed_is_run_again(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    springs(tmp_path / "decks", 3)
    Path("decks/in_file.yaml").write_text(IN_FILE)
    Path("decks/m.mtx").write_text(MASS.format(mass=1.0))

    def again(*more: str) -> set[str]:
        """Decks whose answers are written by a batch."""
        before = written(Path("out"))
        batch(capsys, "decks", "-o", "out", *more)
        return {name.rpartition("-")[0] for name, _ in set(written(Path("out")).items()) - set(before.items())}

    everything = {"spring000", "spring001", "spring002", "in_file"}
    assert again() == everything
    assert again() == set()
    Path("decks/spring001.yaml").write_text(SPRING.format(k=100, hz=1.7))
    assert again() == {"spring001"}
    Path("decks/m.mtx").write_text(MASS.format(mass=1.02))
    assert again() == {"in_file"}
    assert again("--confidence", "99") == everything
    for cut_short in Path("out").glob("spring000-*"):
        cut_short.write_text('{"schema": "mouse.job/1", "jo')
    assert again() == again("--confidence", "99") == {"spring000"}
    assert again() == again("--confidence", "99") == set()


def deadly(job: Job, folder: str) -> Outcome:
    """Work that ends its process on some decks."""
    if "deadly" in job.deck:
        os.kill(os.getpid(), signal.SIGKILL)
    return perform(job, folder)


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no SIGKILL on this system")
def test_a_process_that_dies_takes_no_other_job_with_it(tmp_path):
    springs(tmp_path, 6)
    paths = sorted(tmp_path.glob("*.yaml"))
    names = [*paths[:3], tmp_path / "deadly1.yaml", *paths[3:], tmp_path / "deadly2.yaml"]
    for name in names:
        if not name.exists():
            name.write_text(SPRING.format(k=100, hz=1.6))
    jobs = [Job(str(name)) for name in names]
    with held(str(tmp_path / "out")):
        found = dict(outcomes(jobs, str(tmp_path / "out"), 2, deadly))
    assert sorted(found) == list(range(8))
    assert [found[i].exit_code for i in range(8)] == [0, 0, 0, 5, 0, 0, 0, 5]
    assert {found[i].diagnostics[0].code for i in (3, 7)} == {"MD902"}
    retried = dict(outcomes(jobs, str(tmp_path / "out"), 1))
    assert [retried[i].resumed for i in range(8)] == [True, True, True, False, True, True, True, False]
    assert {one.exit_code for one in retried.values()} == {0}


class Unstarted:
    """Work that no process can take over."""

    def __reduce__(self):
        return os.kill, (NOBODY, signal.SIGKILL)


NOBODY = 2**22 + 1  # above the largest process id: os.kill raises where the work is unpacked


def test_processes_that_cannot_work_end_the_batch_with_one_sentence(tmp_path):
    springs(tmp_path, 4)
    jobs = [Job(str(path)) for path in sorted(tmp_path.glob("*.yaml"))]
    with pytest.raises(MouseError) as told:
        list(outcomes(jobs, str(tmp_path), 2, Unstarted()))
    assert told.value.diagnostics[0].code == "MD909"
    assert not list(tmp_path.glob("*.json"))


def test_workers_of_a_cluster_give_the_same_and_one_that_dies_stops_nothing(tmp_path, monkeypatch):
    pytest.importorskip("distributed", reason="the extra `cluster` is not installed")
    from mouse_cli.batch import cluster

    monkeypatch.chdir(tmp_path)
    springs(Path("decks"), 6)
    jobs = [Job(str(path)) for path in sorted(Path("decks").glob("*.yaml"))]
    with held("one"):
        dict(outcomes(jobs, "one", 1))
    Path("decks/deadly.yaml").write_text(SPRING.format(k=100, hz=1.6))
    with held("two"), cluster.client(None, 2) as client:
        with cluster.client(client.scheduler.address, 0) as other:  # as --scheduler does
            first = dict(cluster.outcomes(jobs, "two", other))
        found = dict(cluster.outcomes([*jobs, Job("decks/deadly.yaml")], "two", client, deadly))
    assert answers(Path("one")) == {name: one for name, one in answers(Path("two")).items() if "deadly" not in name}
    assert sorted(first) == list(range(6)) and not any(one.resumed for one in first.values())
    assert [found[i].resumed for i in range(7)] == [True] * 6 + [False]
    assert (found[6].exit_code, found[6].diagnostics[0].code) == (5, "MD902")


def test_clusters_are_told_of_where_they_are_not_to_be_had(tmp_path, capsys, monkeypatch):
    springs(tmp_path / "decks", 1)
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert _run(["batch", str(tmp_path / "decks"), "--cluster", "2", "-o", str(tmp_path / "out")]) == 5
    assert "error[MD905]" in capsys.readouterr().err
    assert _run(["batch", str(tmp_path / "decks"), "--cluster", "2", "-j", "2"]) == 2
    assert "exclude each other" in capsys.readouterr().err


def test_bad_decks_are_told_of_and_stop_nothing(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    springs(tmp_path / "decks", 2)
    Path("decks/a.yaml").write_bytes(b"mouse: 1\nmodel: \xff")
    Path("decks/b.yaml").write_text("mouse: 1\nmodle: {}\n")
    Path("decks/c.dat").write_bytes(bytes(range(256)))
    Path("decks/d.yaml").write_text(IN_FILE)  # its file is not there
    Path("decks/e.yaml").write_text(SPRING.format(k=-100, hz=1.6))
    for name in ("z1.yaml", "z2.yaml"):  # no models: a folder does not stand for these
        Path(f"decks/{name}").write_text("mouse: 1\ncouple: {}\n" if name[1] == "1" else "mouse: 1\nbatch: []\n")
    status, out, _ = batch(capsys, "decks", "--csv", "t.csv", "--junit", "t.xml", "--github")
    rows = list(csv.DictReader(Path("t.csv").read_text().splitlines()))
    names = ("a.yaml", "b.yaml", "c.dat", "d.yaml", "e.yaml", "spring000.yaml", "spring001.yaml")
    assert [row["deck"] for row in rows] == [f"decks/{name}" for name in names]
    codes = [int(row["exit"]) for row in rows]
    assert codes[:4] == [4] * 4 and codes[4] in (4, 5) and codes[5:] == [0, 0]
    assert status == max(codes)
    suite = ElementTree.parse("t.xml").getroot()[0]
    assert (suite.get("tests"), suite.get("errors"), suite.get("failures")) == ("7", "5", "0")
    assert "::error file=decks/b.yaml,line=2,col=1,title=mouse run%3A MD210::'modle' is not a key of a deck\n" in out


@pytest.mark.parametrize(
    ("text", "code", "place"),
    [
        ("mouse: 1\nbatch:\n  - {decks: nowhere*.yaml}\n", "MD900", "3:13"),
        ("mouse: 1\nbatch:\n  - {decks: no.yaml}\n", "MD900", "3:13"),
        ("mouse: 1\nbatch:\n  - {decks: a.yaml, expect: {posterior k: 5}}\n", "MD901", "3:43"),
        ("mouse: 1\nbatch:\n  - {decks: a.yaml, expect: {posterior: 5 +- 1}}\n", "MD901", "3:41"),
        ("mouse: 1\nbatch:\n  - {decks: a.yaml, expect: {posteriour k: 5 +- 1}}\n", "MD901", "3:44"),
        ("mouse: 1\nbatch:\n  - {decks: a.yaml, expect: {exit: 7}}\n", "MD901", "3:36"),
        ("mouse: 1\nbatch:\n  - {decks: a.yaml, expect: converged}\n", "MD213", "3:29"),
        ("mouse: 1\nbatch:\n  - {decks: a.yaml, expects: {}}\n", "MD210", "3:21"),
        ("mouse: 1\nbatch:\n  - {decks: a.yaml, command: rum}\n", "MD214", "3:30"),
        ("mouse: 1\nbatch:\n  - {decks: a.yaml, options: {recursion: x}}\n", "MD214", "3:42"),
        ("mouse: 1\nbatch:\n  - {decks: a.yaml, candidates: [moon]}\n", "MD907", "3:33"),
        ("mouse: 1\nbatch: []\n", "MD211", "2:8"),
        ("mouse: 1\nbatch:\n  - {command: run}\n", "MD211", "3:5"),
        ("batch:\n  - {decks: a.yaml}\n", "MD211", "1:1"),
        ("mouse: 1\nbatch:\n  - {decks: !!python/name:os.system a.yaml}\n", "MD203", "3:13"),
    ],
)
def test_bad_manifests_are_told_of_with_their_place(tmp_path, capsys, monkeypatch, text, code, place):
    monkeypatch.chdir(tmp_path)
    Path("a.yaml").write_text(SPRING.format(k=100, hz=1.6))
    Path("jobs.yaml").write_text(text)
    status, out, err = batch(capsys, "jobs.yaml")
    assert (status, out) == (4, "")
    assert err.startswith(f"jobs.yaml:{place}: error[{code}]") and "= help: " in err
    assert not Path("mouse-results").exists()
    assert _run(["check", "jobs.yaml"]) == 4


def test_what_is_expected_of_verdicts_and_endings(tmp_path, capsys, monkeypatch):
    """A batch of decks known to be wrong passes when they end as expected; an answer that is not trusted is no pass by itself."""
    monkeypatch.chdir(tmp_path)
    jobs = "\n".join(
        [
            "mouse: 1",
            "batch:",
            f"  - {{decks: {DECKS}/sound_chain.yaml, command: diagnose, expect: {{verdict: nothing-missing, status: converged}}}}",
            f"  - {{decks: {DECKS}/ground_spring.yaml, expect: {{exit: 1, model form: rejected}}}}",
            f"  - {{decks: {DECKS}/table_5_3.yaml, options: {{recursion: anchored}}, expect: {{status: converged}}}}",
            f"  - {{decks: {DECKS}/table_5_3.yaml, expect: {{status: [converged, not-converged]}}}}",
        ]
    )
    Path("jobs.yaml").write_text(jobs)
    status, out, _ = batch(capsys, "jobs.yaml", "--allow-outside", "--junit", "t.xml")
    assert status == 1 and out.count("expected 1/1") == 2 and out.count("expected 2/2") == 2 and "0 of 4 missed" in out
    assert [len(case) for case in ElementTree.parse("t.xml").getroot()[0]] == [0, 0, 0, 1]
    Path("jobs.yaml").write_text(jobs.replace("nothing-missing", "named"))
    status, out, _ = batch(capsys, "jobs.yaml", "--allow-outside", "--github")
    assert status == 3 and "4 done before" in out
    assert "::error file=jobs.yaml,line=3,col=" in out


def test_a_folder_is_for_one_batch_at_a_time(tmp_path, capsys):
    pytest.importorskip("fcntl")
    springs(tmp_path / "decks", 1)
    with held(str(tmp_path / "out")):
        status, out, err = batch(capsys, tmp_path / "decks", "-o", tmp_path / "out")
    assert (status, out) == (5, "") and "MD904" in err
    assert batch(capsys, tmp_path / "decks", "-o", tmp_path / "out")[0] == 0


def made_up(**changes: object) -> Outcome:
    usual = dict(deck="a.yaml", command="run", exit_code=0, ended="converged", diagnostics=(), expected=0, missed=())  # noqa: C408
    return Outcome(**{**usual, "settles": False, "seconds": 0.1, "resumed": False, "result": "a.json", **changes})


@given(st.text(), st.text())
@example("::error::a.yaml", "\n::error::b")
@example("=1+1.yaml", "@x")
def test_summaries_hold_any_name(deck, ended):
    """No cell is a formula; XML stays XML; an annotation stays one line."""
    one = made_up(deck=deck, ended=f"x{ended}", exit_code=1)
    cells = [cell for row in csv.reader(io.StringIO(csv_text([one]), newline="")) for cell in row]
    assert not [cell for cell in cells if cell.startswith(("=", "+", "-", "@", "\t", "\r"))]
    ElementTree.fromstring(junit_text([one]))
    assert len(annotations([one]).encode().splitlines()) == 1
    line, last = table([one]).splitlines()
    assert last == "1 job: 1 not to be trusted" and not line.startswith("::")


NUMBERS = st.floats(-1e9, 1e9, allow_nan=False)


@given(NUMBERS, st.floats(0, 1e6), st.sampled_from(["+-", "±", " +/- "]), NUMBERS)
def test_a_number_is_as_expected_within_its_tolerance(middle, half, sign, value):
    document = {"parameters": [{"name": "k", "posterior": value}]}
    missed = expectation("posterior k", (f"{middle!r}{sign}{half!r}",)).missed(document, 0)
    assert bool(missed) == (not middle - half <= value <= middle + half)


@given(NUMBERS, st.sampled_from(["<", "<=", ">", ">="]), NUMBERS)
def test_bounds(limit, relation, value):
    document = {"verdict": {"probability": value}}
    within = {"<": value < limit, "<=": value <= limit, ">": value > limit, ">=": value >= limit}[relation]
    assert bool(expectation("probability", (f"{relation} {limit!r}",)).missed(document, 0)) == (not within)


@given(st.text(), st.text())
def test_any_expectation_is_read_or_refused(key, value):
    try:
        found = expectation(key, (value,))
    except Unreadable as error:
        assert str(error) and error.help
    else:
        assert isinstance(found.missed({}, 0), str)


def test_a_job_that_takes_too_long_is_broken_off_and_the_others_are_not(tmp_path, monkeypatch):
    """The deck that waits is broken off in the thread that does it, be it the main one or not; the next job is not touched."""
    from mouse_cli.batch import work

    real = work._answer

    def slow(job: Job, data: bytes):
        until = time.monotonic() + 30
        while "001" in job.deck and time.monotonic() < until:
            time.sleep(0.01)
        return real(job, data)

    monkeypatch.setattr(work, "_answer", slow)
    springs(tmp_path / "decks", 3)
    jobs = [Job(str(path)) for path in sorted((tmp_path / "decks").iterdir())]
    (tmp_path / "out").mkdir()
    begun = time.monotonic()
    with ThreadPoolExecutor(1) as thread:
        for do in (
            lambda job: perform(job, str(tmp_path / "out"), 0.5),
            lambda job: thread.submit(perform, job, str(tmp_path / "out"), 0.5).result(),
        ):
            found = [do(job) for job in jobs]
            assert [each.exit_code for each in found] == [0, 5, 0]
            assert found[1].diagnostics[0].code == "MD910"
    assert time.monotonic() - begun < 20
    monkeypatch.setattr(work, "_answer", real)
    again = [perform(job, str(tmp_path / "out"), 0.5) for job in jobs]
    assert [(each.exit_code, each.resumed) for each in again] == [(0, True), (0, False), (0, True)]


def test_markdown_shows_what_is_wrong_first_and_holds_no_markup_of_decks(tmp_path, capsys, monkeypatch):
    """A name may look like anything: it stands as code, in which servers find neither mentions nor pictures."""
    monkeypatch.chdir(tmp_path)
    springs(tmp_path, 1)
    name = "@all ![x](y)|`<b>.yaml"
    Path(name).write_text("mouse: 1\nmodel: {}\n")
    status, _, _ = batch(capsys, ".", "--markdown", "summary.md")
    text = Path("summary.md").read_text()
    assert status == 4
    assert text.index("@all") < text.index("<details>") < text.index("spring000.yaml")
    assert r"| ❌ `./@all ![x](y)\|'<b>.yaml` | run | 4 |" in text
    for line in text.splitlines():
        outside = "".join(line.split("`")[::2])
        assert "@all" not in outside and "![" not in outside and "<b>" not in outside


def test_a_page_of_the_batch_links_to_a_page_of_each_answer(tmp_path, capsys, monkeypatch):
    """Names of decks are text and parts of addresses, never markup; a rejected deck has no page."""
    monkeypatch.chdir(tmp_path)
    springs(tmp_path / "decks", 2)
    Path("decks/a&b <i>#1.yaml").write_text(SPRING.format(k=100, hz=1.6))
    Path("decks/broken.yaml").write_text("mouse: 1\nmodel: {}\n")
    status, _, _ = batch(capsys, "decks", "-o", "out", "--html", "pages/index.html")
    assert status == 5 and not Path("pages").exists()  # no such folder; the answers are there, and are not made again
    Path("pages").mkdir()
    assert batch(capsys, "decks", "-o", "out", "--html", "pages/index.html")[0] == 4
    html = Path("pages/index.html").read_text()
    links = re.findall(r'<a href="(?!#)([^"]*)">', html)
    assert len(links) == 3 == len(list(Path("out").glob("*.html"))) and "<i>" not in html
    for link in links:
        assert "Natural frequencies" in (Path("pages") / unquote(link)).read_text()
