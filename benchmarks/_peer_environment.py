"""The peers' own virtual environment, in the user's cache folder: probeye needs numpy below 2, which mouse does not."""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from _peer_tools import ARGUMENTS
from _user_model import UserModel

REQUIREMENTS = ("numpy<2", "scipy", "openturns==1.27.post1", "probeye==3.0.4")
FOLDER = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "mouse-benchmarks" / "peers"


def python() -> Path:
    """The interpreter of the environment, which is made when it is not there."""
    folder = FOLDER / ("Scripts" if os.name == "nt" else "bin")
    if not (FOLDER / "complete").exists():
        print(f"  making {FOLDER} with {', '.join(REQUIREMENTS)}", flush=True)
        subprocess.run([sys.executable, "-m", "venv", FOLDER], check=True)
        subprocess.run([folder / "python", "-m", "pip", "install", "--quiet", *REQUIREMENTS], check=True)
        (FOLDER / "complete").touch()
    return folder / "python"


def answer(tool: str, model: UserModel) -> dict:
    """cpu, solutions and theta of `tool` on the problem of a user's model."""
    m = model.modes
    s = len(model.dofs)
    split = {"f": model.y[:m], "f_sd": model.sd[:m]}
    split |= {"shapes": model.y[m:].reshape(m, s).T, "shape_sd": model.sd[m:].reshape(m, s).T}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "problem.npz"
        np.savez(path, **{name: split[name] if name in split else getattr(model, name) for name in ARGUMENTS})
        script = Path(__file__).with_name("_peer_tools.py")
        done = subprocess.run([python(), script, tool, path], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{tool} failed:\n{done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])
