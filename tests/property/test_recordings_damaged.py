"""Damaged recordings of every format: each is a diagnosis or still data, never a traceback, a hang or a great allocation."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.io import savemat, wavfile

from mouse_cli._errors import DeckError, RecordError
from mouse_cli._registry import discover
from mouse_cli.formats import read_deck
from mouse_cli.formats.recording_files import read_contents

SETTINGS = settings(max_examples=120, deadline=None, suppress_health_check=list(HealthCheck))
T = np.arange(64) / 100
X = np.column_stack([T, np.sin(9 * T), np.cos(7 * T)])
HEAD = "t (s),force (N),acc (g)"


def hdf5(path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "w") as file:
        file.attrs["fs"] = 100.0
        file.create_group("run")["force"] = X[:, 1]
        file["run/acc"] = X[:, 1:]
        file["run/acc"].attrs["unit"] = "g"


def tdms(path):
    nptdms = pytest.importorskip("nptdms")
    channels = [
        nptdms.ChannelObject("run", name, X[:, j], {"wf_increment": 0.01}) for j, name in ((1, "force"), (2, "acc"))
    ]
    with nptdms.TdmsWriter(path) as writer:
        writer.write_segment(channels)


def universal(binary):
    def write(path):
        pyuff = pytest.importorskip("pyuff")
        each = {"type": 58, "binary": binary, "func_type": 4, "rsp_node": 2, "rsp_dir": 1, "ref_node": 1, "ref_dir": 1, "x": 1 + T,
                "data": X[:, 1] + 1j, "abscissa_spacing": 1, "abscissa_spec_data_type": 18, "ordinate_spec_data_type": 12,
                "orddenom_spec_data_type": 13, "load_case_id": 0}  # fmt: skip
        pyuff.UFF(str(path)).write_sets([each, {**each, "func_type": 1, "data": X[:, 2]}], "add")

    return write


WRITERS = {
    "run.csv": lambda path: np.savetxt(path, X, delimiter=",", header=HEAD, comments=""),
    "complex.csv": lambda path: path.write_text("".join(f"{t:.3f};{x:.4f}+{y:.3f}j\n" for t, x, y in X)),
    "run.npz": lambda path: np.savez(path, force=X[:, 1], acc=X, fs=100.0),
    "packed.npz": lambda path: np.savez_compressed(path, force=X[:, 1], acc=X, fs=100.0),
    "frf.npz": lambda path: np.savez(
        path,
        frequency_hz=1 + T,
        H=np.ones((64, 1, 1)),
        output_names=["1"],
        input_names=["2"],
        variance=np.ones((64, 1, 1)),
    ),
    "run.npy": lambda path: np.save(path, X),
    "five.mat": lambda path: savemat(path, {"run": {"force": X[:, 1], "acc": X}, "fs": 100.0}),
    "packed.mat": lambda path: savemat(path, {"force": X[:, 1], "fs": 100.0}, do_compression=True),
    "four.mat": lambda path: savemat(path, {"force": X[:, 1]}, format="4"),
    "run.wav": lambda path: wavfile.write(path, 8000, (X * 1000).astype(np.int16)),
    "float.wav": lambda path: wavfile.write(path, 8000, X.astype(np.float32)),
    "run.h5": hdf5,
    "run.tdms": tdms,
    "text.unv": universal(0),
    "binary.unv": universal(1),
}


@pytest.fixture(scope="module", params=sorted(WRITERS))
def sound(request, tmp_path_factory):
    """A file that is sound, and its bytes."""
    path = tmp_path_factory.mktemp("sound") / request.param
    WRITERS[request.param](path)
    return path, path.read_bytes()


def test_every_format_is_here():
    formats = discover("mouse_cli.formats.recording_files", "FORMAT").values()
    written = {name.rpartition(".")[2] for name in WRITERS}
    assert all(written & set(each.suffixes or (each.key,)) for each in formats)


def test_sound_files_are_read(sound):
    contents = read_contents(str(sound[0]))
    assert contents.columns or contents.functions


def harmless(path) -> None:
    """Data, or a diagnosis that names the file."""
    try:
        contents = read_contents(str(path))
    except RecordError as error:
        assert all(d.code.startswith("MD") and d.message and str(path) in str(d.span) for d in error.diagnostics)
        return
    for column in contents.columns:
        assert column.values.ndim == 1
    for each in contents.functions:
        assert len(each.frequency_hz) == len(each.values)


@SETTINGS
@given(data=st.data())
def test_damage(sound, data, tmp_path_factory):
    """Bytes replaced, a stretch taken out or doubled, the file cut short."""
    path, raw = sound
    changed = bytearray(raw)
    how = data.draw(st.sampled_from(("bytes", "cut", "hole", "double")))
    at = data.draw(st.integers(0, len(raw) - 1))
    if how == "bytes":
        for _ in range(data.draw(st.integers(1, 6))):
            changed[data.draw(st.integers(0, len(raw) - 1))] = data.draw(st.integers(0, 255))
    elif how == "cut":
        del changed[at:]
    else:
        stretch = changed[at : at + data.draw(st.integers(1, 200))]
        changed[at : at + len(stretch)] = b"" if how == "hole" else stretch + stretch
    damaged = path.with_name(f"damaged{path.suffix}")
    damaged.write_bytes(bytes(changed))
    harmless(damaged)


@SETTINGS
@given(text=st.text(alphabet='0123456789.,;eEjinaf+- \t\n#"ghk', max_size=300))
def test_any_text(text, tmp_path_factory):
    path = tmp_path_factory.getbasetemp() / "any.csv"
    path.write_text(text, "utf-8")
    harmless(path)


ENTRY = st.fixed_dictionaries(
    {},
    optional={
        "file": st.sampled_from(["run.csv", "frf.npz", "no.csv", "../x.csv", ""]),
        "title": st.sampled_from(["a", "b", "[1]"]),
        "sample_rate": st.sampled_from(["100", "-1", "abc", "0", ".inf"]),
        "inputs": st.sampled_from(["{1: force}", "{1: {channel: 2, unit: EU}}", "[1]", "{9: force}", "[{sensor: 1, channel: 2}]"]),
        "outputs": st.sampled_from([
            "{1: acc}", "{2: {channel: acc, sensitivity: 3}}", "acc", "{2: {value: x}}", "{1: {real: [1], imag: acc}}",
        ]),
        "segment": st.sampled_from(["[0, 10]", "[5]", "[10, 5]", "[0, 99999]", "[a, b]"]),
        "kind": st.sampled_from(["mobility", "nothing"]),
        "unit": st.sampled_from(["g/N", "V", "1/s"]),
        "frequency": st.sampled_from(["t", "[1, 2]", "[2, 1]", "force"]),
        "input": st.sampled_from(["1", "1-TX", "[1]"]),
        "band": st.sampled_from(["[0, 1]", "[3, 1]", "[900, 1000]"]),
        "sd": st.sampled_from(["2 %", "-1", "x"]),
    },
)  # fmt: skip


@SETTINGS
@given(recordings=st.lists(ENTRY, max_size=2), frf=st.lists(ENTRY, max_size=2))
def test_any_entries(recordings, frf, tmp_path_factory):
    """Whatever keys a deck gives, it is read or refused."""
    folder = tmp_path_factory.getbasetemp() / "entries"
    folder.mkdir(exist_ok=True)
    for name in ("run.csv", "frf.npz"):
        if not (folder / name).exists():
            WRITERS[name](folder / name)
    flow = lambda entries: (
        "[" + ", ".join("{" + ", ".join(f"{k}: {v}" for k, v in e.items()) + "}" for e in entries) + "]"
    )
    text = (
        "mouse: 1\nmodel: {stiffness: {diagonal: [1, 2]}, mass: {identity: 2}}\nparameters: []\n"
        f"test:\n  recordings: {flow(recordings)}\n  frf: {flow(frf)}\n"
    )
    (folder / "deck.yaml").write_text(text)
    try:
        read_deck(folder / "deck.yaml")
    except DeckError as error:
        assert all(d.code.startswith("MD") and d.message for d in error.diagnostics)
