"""Start-up: processor time of whole processes of mouse against a Python that imports numpy."""

import argparse
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


COMMANDS = {
    "mouse --version": ("--version",),
    "mouse --help": ("--help",),
    "mouse check, 4 DOF": ("check", DECK),
    "mouse run, 4 DOF": ("run", DECK),
}
parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--rounds", type=int, default=15)
rounds = parser.parse_args().rounds
for name, words in COMMANDS.items():
    a, b, ratio = paired(
        lambda w=words: process(MOUSE, *w), lambda: process(sys.executable, "-c", "import numpy"), rounds
    )
    print(f"{name:18} {a * 1e3:6.0f} ms   import numpy {b * 1e3:6.0f} ms   ratio {ratio:.2f}")
