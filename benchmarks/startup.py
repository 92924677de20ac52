"""Start-up: whole processes of mouse against a Python that imports numpy."""

import os
import subprocess
import sys
from pathlib import Path

from _paired import paired

ENVIRONMENT = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
DECK = str(Path(__file__).parents[1] / "decks" / "table_5_2.dat")
MOUSE = str(Path(sys.executable).parent / "mouse")


def process(*command: str) -> None:
    """Run a command to its end, its output thrown away."""
    subprocess.run(command, env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)


for name, command in (("mouse --version", (MOUSE, "--version")), ("mouse run, 4 DOF", (MOUSE, "run", DECK))):
    a, b, ratio = paired(lambda c=command: process(*c), lambda: process(sys.executable, "-c", "import numpy"), 15)
    print(f"{name:18} {a * 1e3:6.0f} ms   import numpy {b * 1e3:6.0f} ms   ratio {ratio:.2f}")
