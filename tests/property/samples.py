"""A small sound file of every format that is read, made by an independent program or by hand, and how it is read.

`FILES[package][key]` are the samples of one registered format; `OTHERS` those of readers that are no members of a registry.
"""

import csv
import io
import json
import wave
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from mouse_cli import report
from mouse_cli._errors import MouseError
from mouse_cli.batch import manifest
from mouse_cli.batch.decks import is_manifest
from mouse_cli.coupling import couple, modify
from mouse_cli.formats import file_bytes, read_deck
from mouse_cli.formats.dof_files import read_dofs
from mouse_cli.formats.frf_source import read_frf
from mouse_cli.formats.matrix_files import read_contents as read_rows
from mouse_cli.formats.matrix_files import read_table
from mouse_cli.formats.mode_files import read_modes
from mouse_cli.formats.node_files import read_nodes
from mouse_cli.formats.recording_files import read_contents
from mouse_cli.formats.yaml_deck import coupled, modified, tables
from mouse_cli.updating import run
from mouse_cli.updating.earlier import after

DECKS = Path(__file__).resolve().parents[2] / "decks"
K = np.array([[2.5e5, -1.5e5, 0], [-1.5e5, 2.65e5, -1.15e5], [0, -1.15e5, 1.15e5]])
T = np.arange(32) / 100
X = np.column_stack([np.sin(9 * T), np.cos(7 * T)])
_I, _J = np.nonzero(np.triu(K))
_DOF = ((3, 1), (12, 2), (40, 6))


def _entries(row: str) -> str:
    return "".join(row.format(i + 1, j + 1, K[i, j]) for i, j in zip(_I, _J, strict=True))


def _market(path: Path) -> None:
    from scipy.io import mmwrite
    from scipy.sparse import coo_array

    mmwrite(path, coo_array(K), symmetry="symmetric")


def _matlab(path: Path, form: str = "5", packed: bool = False, **values: object) -> None:
    from scipy.io import savemat

    savemat(path, values, format=form, do_compression=packed)


def _sparse(path: Path, write: Callable, **more: object) -> None:
    from scipy.sparse import csc_array

    write(path, csc_array(K), **more)


def _npz(path: Path) -> None:
    from scipy.sparse import csr_array, save_npz

    save_npz(path, csr_array(K))


def _hdf5(path: Path, sparse: bool = False, packed: bool = False) -> None:
    h5py = pytest.importorskip("h5py", reason="needs h5py")
    from scipy.sparse import csr_array

    with h5py.File(path, "w") as file:
        if sparse:
            group, stored = file.create_group("K"), csr_array(K)
            group["data"], group["indices"], group["indptr"] = stored.data, stored.indices, stored.indptr
            group.attrs["shape"] = stored.shape
        else:
            how = {"chunks": (2, 2), "compression": "gzip", "shuffle": True, "fletcher32": True} if packed else {}
            file.create_dataset("K", data=K, **how)


def _hdf5_recording(path: Path) -> None:
    h5py = pytest.importorskip("h5py", reason="needs h5py")
    with h5py.File(path, "w") as file:
        file.attrs["fs"] = 100.0
        group = file.create_group("run")
        group.create_dataset("acc", data=X, chunks=(8, 2), compression="gzip")
        group["acc"].attrs["unit"] = "g"
        group["names"] = ["1TX", "2TX"]


def _tdms(path: Path) -> None:
    nptdms = pytest.importorskip("nptdms", reason="needs nptdms")
    given = {"wf_increment": 0.01, "unit_string": "g"}
    with nptdms.TdmsWriter(path) as writer:
        for part in (X[:16], X[16:]):
            writer.write_segment([nptdms.ChannelObject("run", str(j), part[:, j].copy(), given) for j in range(2)])


def _wav(path: Path) -> None:
    with wave.open(str(path), "wb") as file:
        file.setnchannels(2)
        file.setsampwidth(2)
        file.setframerate(8000)
        file.writeframes((X * 1000).astype("<i2").tobytes())


def _universal(path: Path, binary: int = 0, type: int = 4) -> None:
    pyuff = pytest.importorskip("pyuff", reason="needs pyuff")
    each = {"type": 58, "binary": binary, "func_type": type, "rsp_node": 2, "rsp_dir": 1, "ref_node": 1, "ref_dir": 1, "x": 1 + T,
            "data": X[:, 1] + (1j if type == 4 else 0), "abscissa_spacing": 1, "load_case_id": 0, "ordinate_spec_data_type": 12,
            "abscissa_spec_data_type": 18 if type == 4 else 17, "orddenom_spec_data_type": 13}  # fmt: skip
    pyuff.UFF(str(path)).write_sets([each, {**each, "rsp_node": 3}], "add")


def _modes(path: Path) -> None:
    pyuff = pytest.importorskip("pyuff", reason="needs pyuff")
    still, text = np.zeros(3), {f"id{k}": "NONE" for k in range(1, 6)}
    common = dict(
        text, model_type=1, data_ch=2, spec_data_type=8, n_data_per_node=3, node_nums=np.arange(2, 5), load_case=1
    )
    told = {"modal_m": 4.0, "modal_damp_vis": 0.02, "modal_damp_his": 0.0, "analysis_type": 2, "data_type": 2}
    for r, hz in enumerate((3.4, 21.5), 1):
        mode = pyuff.prepare_55(mode_n=r, freq=hz, r1=still, r2=np.array([0.1, r, -0.7]), r3=still, **told, **common)
        pyuff.UFF(str(path)).write_sets(mode, mode="add")


def _functions(path: Path) -> None:
    named = {"output_names": ["1", "2"], "input_names": ["2"], "kind": "receptance", "unit": "m/N"}
    np.savez(
        path,
        frequency_hz=1 + T,
        H=np.ones((32, 2, 1)) + 1j,
        variance=np.ones((32, 2, 1)),
        coherence=np.ones((32, 2)),
        **named,
    )


_HEAD = "{:<72}{:<8}\n{:14d}{:14d}{:14d}{:14d}{:14d}\n{:<14}{:14d}{:14d}{:14d}{:14d}\n{:<16}{:<16}{:<20}\n"
HB = _HEAD.format("stiffness", "KEY", 4, 1, 1, 2, 0, "RSA", 3, 3, 5, 0, "(4I4)", "(5I3)", "(1P,3D16.8)") + (
    "   1   3   5   6\n  1  2  2  3  3\n"
    "  2.50000000D+05 -1.50000000D+05  2.65000000D+05\n -1.15000000D+05  1.15000000D+05\n"
)
OP4 = (
    "       3       3       6       2K       1P,3E23.16\n"
    + "".join(f"{j + 1:8d}{1:8d}{3:8d}\n" + "".join(f"{v:23.16E}" for v in K[:, j]) + "\n" for j in range(3))
    + f"{4:8d}{1:8d}{1:8d}\n{1:23.16E}\n"
)


def _op4(path: Path) -> None:
    """The same in records."""

    def record(*parts: bytes) -> bytes:
        body = b"".join(parts)
        return len(body).to_bytes(4, "little") + body + len(body).to_bytes(4, "little")

    ints = lambda *values: np.array(values, "<i4").tobytes()
    columns = [record(ints(j + 1, 1, 6), K[:, j].astype("<f8").tobytes()) for j in range(3)]
    path.write_bytes(b"".join((record(ints(3, 3, 6, 2), b"K       "), *columns, record(ints(4, 1, 2), bytes(8)))))


def _dmig() -> str:
    lines = ["DMIG    K       0       6       2       0                       3"]
    for i, j in zip(_I, _J, strict=True):
        (row, along), (col, across) = _DOF[i], _DOF[j]
        lines += [f"DMIG*   {'K':<16}{col:16d}{across:16d}", f"*       {row:16d}{along:16d}{K[i, j]:16.9E}"]
    return "\n".join(lines) + "\n"


def _table(rows: object, *head: str) -> str:
    stream = io.StringIO()
    csv.writer(stream).writerows([head, *rows] if head else rows)
    return stream.getvalue()


_LABELS = "".join("{}, {}, {}, {}, {:.9E}\n".format(*_DOF[i], *_DOF[j], K[i, j]) for i, j in zip(_I, _J, strict=True))
_PLACES = ((3, -1.0, 1.5, -1.0), (12, 0.25, 0.0, -1.0))
LVM = (
    "LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\nDecimal_Separator\t,\nMulti_Headings\tYes\nX_Columns\tOne\n"
    "Time_Pref\tRelative\nDate\t2024/05/06\n***End_of_Header***\t\n\t\n"
)


def segment(values: np.ndarray, x0: float = 0.0, step: float = 0.01, names: str = "hammer\t12TY") -> str:
    """A segment of two channels in N and g, as LabVIEW writes it, with a comment on its first row."""
    n = len(values)
    rows = [f"{x0 + k * step:.6f}\t{a:.6f}\t{b:.6f}\t{'' if k else 'go on'}" for k, (a, b) in enumerate(values)]
    head = f"Channels\t2\t\t\nSamples\t{n}\t{n}\t\nY_Unit_Label\tN\tg\t\nX_Dimension\tTime\tTime\t\nX0\t{x0:.6f}\t{x0:.6f}\t\n"
    table = (
        f"{head}Delta_X\t{step:.6f}\t{step:.6f}\t\n***End_of_Header***\t\t\t\nX_Value\t{names}\tComment\n"
        + "\n".join(rows)
    )
    return f"{table}\n\n".replace(".", ",")


_15 = "".join(f"{n:10d}{0:10d}{0:10d}{11:10d}{x:13.5E}{y:13.5E}{z:13.5E}\n" for n, x, y, z in _PLACES)
_2411 = "".join(f"{n + 50:10d}{1:10d}{1:10d}{11:10d}\n{x:25.16E}{y:25.16E}{z:25.16E}\n" for n, x, y, z in _PLACES)
NODES_UNV = f"    -1\n    15\n{_15}    -1\n    -1\n  2411\n{_2411}    -1\n"

FILES: dict[str, dict[str, dict[str, object]]] = {
    "matrix_files": {
        "abaqus": {"labels.mtx": _LABELS},
        "coordinate": {"k.sti": _entries("{} {} {:.9E}\n")},
        "csv": {"table.csv": _table(K.tolist()), "triples.csv": "i,j,value\n" + _entries("{},{},{}\n")},
        "dmig": {"k.pch": _dmig()},
        "h5": {"dense.h5": _hdf5, "sparse.h5": partial(_hdf5, sparse=True), "packed.h5": partial(_hdf5, packed=True)},
        "hb": {"k.rsa": HB},
        "mat": {
            "five.mat": partial(_matlab, K=K),
            "packed.mat": partial(_matlab, packed=True, K=K),
            "four.mat": partial(_matlab, form="4", K=K),
            "cells.mat": partial(_matlab, K={"K": K, "name": "x", "c": np.array([[1, "a"]], object)}),
        },
        "mtx": {"market.mtx": _market},
        "npz": {"sparse.npz": _npz, "dense.npz": lambda path: np.savez_compressed(path, K=K)},
        "op4": {"text.op4": OP4, "binary.op4": _op4},
    },
    "recording_files": {
        "csv": {
            "run.csv": _table(np.column_stack([T, X]).tolist(), "t (s)", "force [N]", "acc (g)"),
            "comma.csv": "t;x\n" + "".join(f"{t:.3f};{x:.4f}\n".replace(".", ",") for t, x in zip(T, X[:, 0], strict=True)),
            "head.txt": "Operator: me\n# fs = 100 Hz\nforce\tacc\nN\tg\n" + "".join(f"{a}\t{b}\n" for a, b in X),
            "clock.csv": "Timestamp;x\n" + "".join(f"2024-02-28 12:00:0{t:.3f};{x}\n" for t, x in zip(T, X[:, 0], strict=True)),
            "gaps.csv": "".join(f"{t:.3f}\t{'nan' if i % 7 == 3 else t}\t0.1+0.2j\n" for i, t in enumerate(T)),
        },
        "h5": {"run.h5": _hdf5_recording},
        "lvm": {"run.lvm": LVM + segment(X[:16]) + segment(X[16:], 0.16), "labview.txt": LVM + segment(X)},
        "mat": {
            "run.mat": partial(_matlab, run={"force": X[:, 0], "acc": X}, fs=100.0),
            "packed.mat": partial(_matlab, packed=True, acc=X, fs=100.0),
            "four.mat": partial(_matlab, form="4", acc=X),
        },
        "npz": {
            "run.npz": lambda path: np.savez(path, acc=X, fs=100.0),
            "packed.npz": lambda path: np.savez_compressed(path, acc=X, fs=100.0),
            "frf.npz": _functions,
            "run.npy": lambda path: np.save(path, X),
        },
        "tdms": {"run.tdms": _tdms},
        "unv": {
            "text.unv": _universal,
            "binary.unv": partial(_universal, binary=1),
            "time.unv": partial(_universal, type=1),
        },
        "wav": {"run.wav": _wav},
    },
    "dof_files": {
        "csv": {"map.csv": "node,direction\n3,TX\n12,2\n40,RZ\n"},
        "dof": {"job.dof": "3.1\n12.2\n40.6\n"},
        "mapping": {"k.mapping": "    Matrix Eqn Node DOF\n 1 12 UY\n 2 3 UX\n 3 40 ROTZ\n"},
    },
    "node_files": {
        "bdf": {"n.bdf": "GRID    3               -1.     1.5     -1.+0\nGRID,12,,.25,0.,-1.\nCBAR,1,1,3,12\n"},
        "csv": {"n.csv": _table(_PLACES, "node", "x", "y", "z")},
        "inp": {"n.inp": "*HEADING\nplate\n*NODE, NSET=ALL\n3, -1., 1.5, -1.\n12, .25, 0, -1.,\n*ELEMENT, TYPE=S4\n1,2\n"},
        "unv": {"n.unv": NODES_UNV},
    },
    "mode_files": {
        "csv": {
            "modes.csv": "node,direction,mode 1,mode 2\nfrequency,,3.4,21.5\nsd,,0.1,0.2\n2,TY,0.1,0.7\n3,-Y,0.4,-1\n",
            "rows.tsv": "mode\tfrequency\tsd\t2TY\t3TY\n1\t3,4\t0,1\t0,1\t0,7\n2\t21,5\t0,2\t0,4\t-1\n",
            "places.csv": "sensor,x,y,z,nx,ny,nz,1\nfrequency,,,,,,,3.4\nA,0.6,0,0,0,2,0,1\n",
        },
        "frd": {
            "modes.frd": "    1C\n    1PMODE                         1\n"
            "  100CL  101 61.18531827           2                     2    1MODAL      1\n"
            " -4  DISP        4    1\n -5  D1          1    2    1    0\n -1         2-8.76179E-03-4.36795E-04-8.77510E-02\n"
            " -1         4-1.53868E-02-1.23228E-03-5.84415E-01\n -3\n 9999\n",
        },
        "unv": {"modes.unv": _modes},
    },
}  # fmt: skip


def _recording(path: str) -> None:
    if read_contents(path).functions:
        read_frf(path)


def _matrix(path: str) -> None:
    variable = "K.K" if "cells" in path else None
    read_rows(path, variable=variable)
    read_table(path, variable)


READERS: dict[str, Callable[[str], object]] = {
    "matrix_files": _matrix,
    "recording_files": _recording,
    "dof_files": read_dofs,
    "node_files": read_nodes,
    "mode_files": read_modes,
}

SPRING = """\
mouse: 1
title: One mass on a spring
model: {stiffness: {order: 2, entries: [[1, 1, 100.0], [2, 2, 250.0]]}, mass: {diagonal: [1, 2.0]}, labels: [base, tip]}
parameters: [{name: k, nominal: 1.0, sd: 10 %, lower: 0, stiffness: [[1, 1, 100]]}]
test: {modes: {frequency: [1.6, 1.75], frequency_sd: 1 %, dofs: [base, 2], shapes: [[1, 0], [0, ~]], shape_sd: 0.1}}
run: {recursion: anchored, cycles: 2}
"""
FRAME = """\
mouse: 1
model:
  structure:
    nodes: {line: {from: 1, to: 4, start: [0, 0, 0], end: [3, 0, 0]}}
    materials: {steel: {E: 2.1e+11, nu: 0.3, density: 7850}}
    sections: {bar: {rectangle: [0.006, 0.03]}}
    elements: [{id: 1-3, type: beam, nodes: 1-4, material: steel, section: bar}, {type: mass, nodes: [2, 4], mass: 0.5}]
    supports: {1: all}
    plane: XY
parameters: [{name: E, each: 1, elements: 1-3, property: E, sd: 10 %, transform: log}]
prior: {correlations: [[E 1, E 2, 0.5]]}
test: {modes: {frequency: [0.5, 3.4], frequency_sd: 1 %}}
"""
COUPLED = """\
mouse: 1
couple:
  substructures: {a: {deck: portal_left.yaml}, b: {deck: portal_right.yaml, remove: false}}
  interfaces: [{a: [11TX, 11TY, 11RZ], b: [11TX, 11TY, 11RZ]}]
  connections: [{mass: 1.0, at: {a: 7TX}}, {spring: 100.0, dashpot: 2, at: {a: 7TX}, to: {b: 15TX}}]
  responses: {a: 7TX, b: [15TX]}
  lines: {band: [2, 8], step: 2}
  modes: {count: 3, keep: [2], methods: [rubin]}
"""
MODIFIED = """\
mouse: 1
modify:
  deck: portal_whole.yaml
  changes: [{mass: 3.0, at: 7TX}, {absorber: {mass: 1, tuned_to: 1}, at: 7TX}]
  targets: [{mode: 2, below: 6, by: mass, place: 7TX}]
  count: 3
"""
MANIFEST = """\
mouse: 1
command: run
options: {recursion: anchored}
batch:
  - decks: spring.yaml
    expect: {status: converged, posterior k: 1.1 +- 20 %, exit: [0, 1], residual p: "> 0.01"}
  - {decks: "spr*.yaml", command: diagnose, causes: 1, candidates: [ground-spring], expect: {verdict: named}}
"""


def _answer() -> str:
    """What `mouse run --json` writes of a sound deck."""
    return json.dumps(report.document(run(read_deck(DECKS / "sound_chain.yaml"))))


def _prior(path: str) -> object:
    return after(replace(read_deck(Path(path).parent / "sound_chain.yaml"), test=None), path, {})


def _asked(read: Callable, answer: Callable, path: str) -> None:
    """What the deck asks for; an answer that there is not need not name the file."""
    found = read(file_bytes(path), path)
    with suppress(MouseError):
        answer(found)


def _batch(path: str) -> object:
    return manifest.read(path) if is_manifest(path) else read_deck(path)


def _page(path: str) -> str:
    from mouse_cli.page import page, read

    return page(read(file_bytes(path), path))


OTHERS: dict[str, tuple[object, Callable[[str], object]]] = {
    "cards.dat": (lambda path: path.write_bytes((DECKS / "table_5_3.dat").read_bytes()), read_deck),
    "deck.yaml": (SPRING, read_deck),
    "frame.yaml": (FRAME, read_deck),
    "couple.yaml": (COUPLED, partial(_asked, coupled.read, couple)),
    "modify.yaml": (MODIFIED, partial(_asked, modified.read, modify)),
    "jobs.yaml": (MANIFEST, _batch),
    "nodes.csv": (_table(_PLACES, "id", "x", "y", "z"), partial(tables.read_table, least=3)),
    "result.json": (_answer, _page),
    "prior.json": (_answer, _prior),
}


def beside(folder: Path) -> None:
    """The files that decks among the samples name."""
    for path in (*(DECKS / "coupled").glob("*.yaml"), DECKS / "sound_chain.yaml"):
        (folder / path.name).write_bytes(path.read_bytes())
    (folder / "spring.yaml").write_text(SPRING)


def write(path: Path, sample: object) -> None:
    """A sample as a file: by a text, or by what writes it."""
    if isinstance(sample, str):
        path.write_text(sample)
    elif sample is _answer:
        path.write_text(_answer())
    else:
        sample(path)
