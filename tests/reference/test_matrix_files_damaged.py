"""Damaged files of every format: each is a diagnosis or still a matrix, never a traceback, a hang or a great allocation."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.io import mmwrite, savemat
from scipy.sparse import coo_array, csc_array, csr_array, save_npz
from test_matrix_files_foreign import DMIG, FILES, NODES, K

from mouse_cli._errors import DeckError
from mouse_cli.formats.dof_files import read_dofs
from mouse_cli.formats.matrix_files import read_matrix
from mouse_cli.formats.node_files import read_nodes

SETTINGS = settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))
READ = {
    **{
        name: lambda path: read_matrix(path, variable=None) for name in ("k.mtx", "k.sti", "k.matrix", "k.rsa", "c.mtx")
    },
    "k.op4": lambda path: read_matrix(path, variable="K"),
    "k.pch": lambda path: read_matrix(path, variable="K2GG"),
    **dict.fromkeys(NODES, read_nodes),
    "job.dof": read_dofs,
    "map.csv": read_dofs,
    "k.mapping": read_dofs,
}
TEXTS = {
    **{name: FILES.get(name, "").encode() for name in READ},
    "k.pch": DMIG.encode(),
    **{name: text.encode() for name, text in NODES.items()},
    "job.dof": b"3.1\n12.2\n40.6\n",
    "map.csv": b"node,direction\n3,TX\n12,2\n40,RZ\n",
    "k.mapping": b"    Matrix Eqn Node DOF\n 1 12 UY\n 2 3 UX\n 3 40 ROTZ\n",
}


def op4_binary() -> bytes:
    """K in records as OUTPUT4 writes them, dense, little-endian."""
    record = lambda *parts: (lambda body: len(body).to_bytes(4, "little") + body + len(body).to_bytes(4, "little"))(
        b"".join(parts)
    )
    ints = lambda *values: np.array(values, "<i4").tobytes()
    columns = [record(ints(j + 1, 1, 6), K[:, j].astype("<f8").tobytes()) for j in range(3)]
    return record(ints(3, 3, 6, 2), b"K       ") + b"".join(columns) + record(ints(4, 1, 2), bytes(8))


def hdf5(path) -> None:
    h5py = pytest.importorskip("h5py", reason="needs h5py")
    with h5py.File(path, "w") as file:
        group, stored = file.create_group("M"), csr_array(K)
        group["data"], group["indices"], group["indptr"] = stored.data, stored.indices, stored.indptr
        group.attrs["shape"] = stored.shape


WRITERS = {
    "binary.op4": lambda path: path.write_bytes(op4_binary()),
    "five.mat": lambda path: savemat(path, {"K": K}),
    "sparse.mat": lambda path: savemat(path, {"K": csc_array(K)}),
    "packed.mat": lambda path: savemat(path, {"K": csc_array(K)}, do_compression=True),
    "four.mat": lambda path: savemat(path, {"K": K}, format="4"),
    "k.h5": hdf5,
    "k.npz": lambda path: save_npz(path, csr_array(K)),
    "market.mtx": lambda path: mmwrite(path, coo_array(K)),
}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """Sound files, by name."""
    folder = tmp_path_factory.mktemp("whole")
    for name, write in WRITERS.items():
        write(folder / name)
    return {**TEXTS, **{name: (folder / name).read_bytes() for name in WRITERS}}


@pytest.mark.parametrize("name", [*TEXTS, *WRITERS])
def test_sound_files_are_read(name, whole, tmp_path):
    (tmp_path / name).write_bytes(whole[name])
    READ.get(name, read_matrix)(str(tmp_path / name))


@pytest.mark.parametrize("name", [*TEXTS, *WRITERS])
def test_damage_is_a_diagnosis(name, whole, tmp_path):
    data = whole[name]

    @SETTINGS
    @given(
        cut=st.integers(0, len(data)),
        flips=st.lists(st.tuples(st.integers(0, len(data) - 1), st.integers(0, 7)), max_size=4),
    )
    def damaged(cut, flips):
        broken = bytearray(data)
        for at, bit in flips:
            broken[at] ^= 1 << bit
        if cut % 2:
            broken = broken[:cut]
        (tmp_path / name).write_bytes(broken)
        try:
            found = READ.get(name, read_matrix)(str(tmp_path / name))
        except DeckError as error:
            assert all(d.code.startswith("MD25") or d.code in ("MD260", "MD262") for d in error.diagnostics)
        else:
            assert found is not None

    damaged()


@pytest.mark.parametrize("name", ["five.mat", "sparse.mat"])
def test_no_bit_of_a_matlab_file_ends_the_process(name, whole, tmp_path):
    """SciPy's compiled reader looks unknown types of elements up in memory that is not its own."""
    refused = 0
    for bit in range(8 * 128, 8 * len(whole[name])):
        broken = bytearray(whole[name])
        broken[bit // 8] ^= 1 << bit % 8
        (tmp_path / name).write_bytes(broken)
        try:
            read_matrix(str(tmp_path / name))
        except DeckError:
            refused += 1
    assert refused
