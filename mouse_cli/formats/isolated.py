"""Reading in a process of its own, for libraries that a damaged file can crash: then it is a diagnosis, and not the end of mouse.

The process is started with the first file and serves the next ones too; it ends with the one that it serves, whose end it sees as
the end of its input. Requests and answers are pickles on its standard input and output.
"""

import os
import pickle
import signal
import subprocess
import sys
import threading
import warnings
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np

from mouse_cli._errors import DeckError

_START = "import sys; sys.path[:] = {path!r}; from mouse_cli.formats.isolated import serve; serve()"
_lock = threading.Lock()
_servers: dict[int, subprocess.Popen] = {}  # of each process by its number: one that was forked has its own


def call(function: Callable[..., Any], *arguments: object) -> Any:
    """What `function(*arguments)` gives, or raises; function: of a module, by its name there.

    Raises ValueError where it crashed the process, MemoryError where the system has killed it.
    """
    request = os.getcwd(), function, arguments
    with _lock:
        server = _server()
        try:
            pickle.dump(request, server.stdin, protocol=5)
            server.stdin.flush()
            kind, found = pickle.load(server.stdout)
        except (EOFError, OSError, pickle.UnpicklingError):
            end = _stop(server)
            if end == -signal.SIGKILL:
                raise MemoryError from None
            raise ValueError(f"it crashed the library that reads it{_by(end)}") from None
        except BaseException:  # interrupted: what is still to come would answer the next request
            _stop(server)
            raise
    if kind == "found":
        return found
    raise DeckError(found) if kind == "rejected" else found


def serve() -> None:
    """Answer requests until there are no more; what a library prints goes nowhere."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    requests, answers = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    warnings.simplefilter("ignore")
    np.seterr(all="ignore")
    while requests.peek(1):
        pickle.dump(_answer(*pickle.load(requests)), answers, protocol=5)
        answers.flush()


def _answer(folder: str, function: Callable[..., Any], arguments: tuple[object, ...]) -> tuple[str, Any]:
    os.chdir(folder)
    try:
        return "found", function(*arguments)
    except DeckError as error:
        return "rejected", error.diagnostics
    except (OSError, MemoryError) as error:
        return "raised", error
    except Exception as error:  # of whatever class, which need not be one that can be sent
        return "raised", ValueError(str(error) or type(error).__name__)


def _server() -> subprocess.Popen:
    """The process that serves this one."""
    running = _servers.get(os.getpid())
    if running is None or running.poll() is not None:
        _servers.clear()
        command = [sys.executable, "-c", _START.format(path=sys.path)]
        pipe = subprocess.PIPE
        running = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL)
        _servers[os.getpid()] = running
    return running


def _stop(server: subprocess.Popen) -> int:
    """End a process that is no longer in step; its code, which is less than 0 where a signal ended it."""
    _servers.clear()
    for pipe in (server.stdin, server.stdout):
        with suppress(OSError):  # what was not sent yet cannot be
            pipe.close()
    try:
        return server.wait(1)
    except subprocess.TimeoutExpired:
        server.kill()
        server.wait()
        return 0


def _by(end: int) -> str:
    try:
        return f" ({signal.Signals(-end).name})"
    except ValueError:
        return ""
