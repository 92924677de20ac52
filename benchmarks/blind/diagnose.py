"""Runs `mouse diagnose` on decks, one process for each deck as a user would."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

LIMIT = 300  # s


def diagnosed(deck: Path) -> dict:
    """The document of `mouse diagnose --json`, and `seconds`; `refused` with the message where there is none."""
    one = os.environ | dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")
    command = [sys.executable, "-m", "mouse_cli", "diagnose", "--json", str(deck)]
    start = time.perf_counter()
    try:
        done = subprocess.run(command, capture_output=True, text=True, env=one, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return {"refused": f"no answer within {LIMIT} s", "seconds": float(LIMIT)}
    seconds = time.perf_counter() - start
    if done.returncode in (0, 1) and done.stdout.startswith("{"):
        return json.loads(done.stdout) | {"seconds": seconds}
    return {"refused": done.stderr.strip()[-600:], "seconds": seconds}
