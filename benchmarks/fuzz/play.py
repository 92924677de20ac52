"""One input through one command, in a child of this process: what it took, how it ended, and where it wrote."""

import faulthandler
import json
import os
import resource
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

_MB = 2**20
_RAISED = 70
_HANG = 120  # wall seconds
_WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
_CHANGES = {"os.rename": (0, 1), "os.remove": (0,), "os.mkdir": (0,), "os.rmdir": (0,), "os.link": (1,), "os.symlink": (1,),
            "os.truncate": (0,), "os.chmod": (0,), "shutil.rmtree": (0,), "socket.connect": (1,)}  # fmt: skip
_BESIDE = ("os.remove", "os.rmdir")  # their second argument is the folder that a path stands in, -1 for the present one
_watched: list[Path | None] = []  # the last: the folder of the input, None while the watch itself writes


@dataclass(frozen=True)
class Limits:
    """cpu: seconds; memory: MB that one input may take."""

    cpu: float = 10.0
    memory: float = 1000.0


@dataclass(frozen=True)
class Outcome:
    """fault: traceback, slow, memory, outside, silent, warning or document; '' when there is none. place: where it was."""

    exit: int
    cpu: float
    memory: float
    fault: str = ""
    place: str = ""


def play(arguments: list[str], folder: Path, limits: Limits) -> Outcome:
    """Outcome of `mouse ARGUMENTS` in `folder`, which holds `in` (left as it is) and gets `out` and `tmp`."""
    for name in ("out", "tmp"):
        (folder / name).mkdir(exist_ok=True)
    sys.stdout.flush()
    own = _resident()
    pid = os.fork()
    if pid == 0:
        _child(arguments, folder, limits)
    _, status, usage = os.wait4(pid, 0)
    cpu, memory = usage.ru_utime + usage.ru_stime, max(0.0, usage.ru_maxrss / 1024 - own)
    code = os.waitstatus_to_exitcode(status)
    return _outcome(arguments, folder, code, cpu, memory, limits)


def _resident() -> float:
    """MB of this process now, with which a child begins; its peak may long be over."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize() / _MB


def _addresses(limits: Limits) -> int:
    """Bytes of addresses that a child may have: those that it begins with, what an input may take, and room for libraries."""
    own = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    return own + int((limits.memory + 3000) * _MB)


def _outcome(arguments: list[str], folder: Path, code: int, cpu: float, memory: float, limits: Limits) -> Outcome:
    fault, place = _judged(arguments, folder, code, cpu, memory, limits)
    return Outcome(code, round(cpu, 2), round(memory), fault, place)


def _judged(
    arguments: list[str], folder: Path, code: int, cpu: float, memory: float, limits: Limits
) -> tuple[str, str]:
    said = (folder / "stderr").read_text(errors="replace")
    if (folder / "outside").exists():
        return "outside", (folder / "outside").read_text().split("\n")[0]
    if cpu > limits.cpu or code in (-signal.SIGKILL, -signal.SIGXCPU, -signal.SIGALRM):
        return "slow", _place(said, "File ", "mouse_cli")
    if code == _RAISED:
        return "traceback", (folder / "tmp" / "raised").read_text()
    if "error[MD903]" in (said := said + _answers(folder)):
        return "traceback", _place(said, "", "error[MD903]")
    if memory > limits.memory:
        return "memory", ""
    if code not in (0, 1, 2, 3, 4, 5):
        return "silent", f"exit {code}"
    why = "[MD" if "--strict" in arguments else "error[MD"
    answers = [folder / "stdout", *filter(Path.is_file, (folder / "out").rglob("*"))]  # a report says why it ended
    if code in (4, 5) and why not in said and max(each.stat().st_size for each in answers) < 100:
        return "silent", f"exit {code} without an error"
    if "Warning:" in said:
        return "warning", _place(said, "", "Warning:")
    document = "--json" in arguments and "--markdown" not in arguments
    if document and code in (0, 1) and not _sound((folder / "stdout").read_text(errors="replace")):
        return "document", ""
    return "", ""


def _answers(folder: Path) -> str:
    """The findings of jobs, which stand in their answers: `error[CODE] message`, a line each."""
    found = []
    for path in (folder / "out").glob("*/**/*.json"):
        try:
            rows = json.loads(path.read_text(errors="replace"))["diagnostics"]
            found += [f"error[{row['code']}] {row['message']}\n" for row in rows]
        except (ValueError, KeyError, TypeError, OSError):
            continue
    return "".join(found)


def _place(said: str, start: str, word: str) -> str:
    """The first line that holds a word: of a stack, the innermost place in mouse."""
    return next(
        (line.strip()[:200] for line in said.split("\n") if line.strip().startswith(start) and word in line), ""
    )


def _sound(text: str) -> bool:
    """Whether standard output is JSON without NaN."""

    def never(name: str) -> None:
        raise ValueError(name)

    try:
        json.loads(text, parse_constant=never)
    except ValueError:
        return False
    return True


def _child(arguments: list[str], folder: Path, limits: Limits) -> None:
    _bound(limits)
    _watched.append(folder)
    _watch()
    os._exit(said(arguments, folder))


def said(arguments: list[str], folder: Path) -> int:
    """The exit code of `mouse ARGUMENTS` in this process, whose output, folder for temporary files and cache are `folder`'s."""
    for number, name in ((1, "stdout"), (2, "stderr")):
        opened = os.open(folder / name, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
        os.dup2(opened, number)
        os.close(opened)
    sys.stdout, sys.stderr = (open(number, "w", encoding="utf-8", closefd=False) for number in (1, 2))
    os.environ |= {"TMPDIR": str(folder / "tmp"), "MPLCONFIGDIR": str(folder / "tmp"), "MOUSE_TRACEBACK": "1"}
    tempfile.tempdir = None  # that of the parent
    os.environ["XDG_CACHE_HOME"] = str(folder / "tmp")
    os.chdir(folder)
    code = _RAISED
    try:
        from mouse_cli.cli.main import _run

        code = _run(arguments)
    except SystemExit as error:
        code = error.code if isinstance(error.code, int) else 1
    except BaseException as error:
        traceback.print_exc()
        (folder / "tmp" / "raised").write_text(_innermost(error))
    sys.stdout.flush()
    sys.stderr.flush()
    return code


def chained(jobs: list, made: Callable[[object, Path], list[str]], limits: Limits) -> Iterator[Outcome]:
    """Outcomes of the first of `jobs`, one after another in one child, up to one with a fault, which is to be played alone.

    made: writes a job's input to a folder, and gives its arguments. The memory of each is that of the largest so far.
    """
    reading, writing = os.pipe()
    sys.stdout.flush()
    with tempfile.TemporaryDirectory(prefix="fuzz") as top:
        if (pid := os.fork()) == 0:
            os.close(reading)
            _chain(jobs, made, limits, Path(top), writing)
        os.close(writing)
        with open(reading) as rows:
            for row in rows:
                yield Outcome(**json.loads(row))
        os.waitpid(pid, 0)


def _chain(jobs: list, made: Callable, limits: Limits, top: Path, writing: int) -> None:
    resource.setrlimit(resource.RLIMIT_AS, (_addresses(limits),) * 2)
    resource.setrlimit(resource.RLIMIT_FSIZE, (200 * _MB,) * 2)
    _watch()
    start = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for number, job in enumerate(jobs):
        folder = top / str(number)
        for name in ("out", "tmp"):
            (folder / name).mkdir(parents=True)
        arguments = made(job, folder)
        signal.setitimer(signal.ITIMER_PROF, limits.cpu)
        signal.alarm(_HANG)
        before = time.process_time()
        _watched.append(folder)
        code = said(arguments, folder)
        _watched.clear()
        cpu, memory = time.process_time() - before, (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - start) / 1024
        found = _outcome(arguments, folder, code, cpu, memory, limits)
        if found.fault:
            break
        os.write(writing, (json.dumps(asdict(found)) + "\n").encode())
        os.chdir(top)
        shutil.rmtree(folder, ignore_errors=True)
    os._exit(0)


def _bound(limits: Limits) -> None:
    """After the limit a stack is written; two seconds later the child is killed."""
    cpu = int(limits.cpu) + 1
    faulthandler.register(signal.SIGXCPU, file=2, all_threads=False)
    resource.setrlimit(resource.RLIMIT_CPU, (cpu, cpu + 2))
    resource.setrlimit(resource.RLIMIT_AS, (_addresses(limits),) * 2)
    resource.setrlimit(resource.RLIMIT_FSIZE, (200 * _MB,) * 2)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.alarm(_HANG)


def _watch() -> None:
    """Whatever is written, made or taken away outside of the answers and `tmp` of a watched folder, said in its file `outside`."""

    def outside(path: object, beside: object) -> bool:
        if not isinstance(path, str | bytes | os.PathLike):
            return False
        start = f"/proc/self/fd/{beside}" if isinstance(beside, int) and beside >= 0 else ""
        real = os.path.realpath(os.path.join(start, os.fsdecode(path)))
        allowed = tuple(
            f"{os.path.realpath(_watched[-1] / name)}{os.sep}" for name in ("out", "tmp", "stdout", "stderr")
        )
        return real != os.devnull and f"{real}{os.sep}" not in allowed and not real.startswith(allowed)

    def hook(event: str, given: tuple) -> None:
        if not _watched or _watched[-1] is None or event not in ("open", *_CHANGES):
            return
        if event == "open":
            paths = given[:1] if given[2] and given[2] & _WRITES else ()
        else:
            paths = tuple(given[k] for k in _CHANGES[event])
        beside = given[1] if event in _BESIDE else None
        if any(outside(path, beside) for path in paths):
            folder = _watched[-1]
            _watched.append(None)
            with open(folder / "outside", "w") as file:
                file.write(f"{event} {paths}\n")
                file.write("".join(traceback.format_stack()[:-1]))
            _watched.pop()

    sys.addaudithook(hook)


def _innermost(error: BaseException) -> str:
    """The exception and the innermost place in mouse where it was raised."""
    places = [at for at in traceback.extract_tb(error.__traceback__) if "mouse_cli" in at.filename]
    place = f"{places[-1].filename.rpartition('mouse_cli')[2].lstrip(os.sep)}:{places[-1].lineno}" if places else "?"
    return f"{type(error).__name__} at {place}: {str(error)[:120]}"
