"""Runs `mouse diagnose` on decks, one process for each deck as a user would."""

import json
import os
import resource
import subprocess
import sys
from pathlib import Path

LIMIT = 600  # s, by the clock


def diagnosed(deck: Path, extended: Path | None = None) -> dict:
    """The document of `mouse diagnose --json`, and `seconds` of the processor; `refused` with the message where there is none.

    extended: where the extended model goes.
    """
    one = os.environ | dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
    command = [sys.executable, "-m", "mouse_cli", "diagnose", "--json", str(deck)]
    command += ["-o", str(extended)] if extended else []
    start = _seconds()
    try:
        done = subprocess.run(command, capture_output=True, text=True, env=one, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return {"refused": f"no answer within {LIMIT} s", "seconds": float(LIMIT)}
    seconds = _seconds() - start
    if done.returncode in (0, 1) and done.stdout.startswith("{"):
        return json.loads(done.stdout) | {"seconds": seconds}
    return {"refused": done.stderr.strip()[-600:], "seconds": seconds}


def _seconds() -> float:
    """Processor time of all processes that this one has waited for."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
