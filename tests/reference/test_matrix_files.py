"""Matrix files: SciPy and NumPy write them, the reader takes them; damaged ones are named, never trusted."""

import io
import struct
import zipfile

import numpy as np
import pytest
from scipy.io import mmwrite
from scipy.sparse import coo_array, csc_array, csr_array, save_npz

from mouse_cli._atomic import write_text_atomically
from mouse_cli._errors import DeckError, WrittenError
from mouse_cli.formats.matrix_files import LARGEST_DENSE, market, read_matrix, read_table
from mouse_cli.model.arrays import is_sparse, upper_triangle

K = np.array([[2.5e5, -1.5e5, 0], [-1.5e5, 2.65e5, -1.15e5], [0, -1.15e5, 1 / 3]])
REAL = "%%MatrixMarket matrix coordinate real symmetric\n"
GENERAL = "%%MatrixMarket matrix coordinate real general\n"


def big_sparse(n: int = LARGEST_DENSE + 1):
    diagonal = np.arange(n)
    rows = np.concatenate([diagonal, diagonal[:-1], diagonal[1:]])
    cols = np.concatenate([diagonal, diagonal[1:], diagonal[:-1]])
    values = np.concatenate([np.full(n, 2.0), np.full(2 * n - 2, -1.0)])
    return coo_array((values, (rows, cols)), shape=(n, n))


def stored(path, kind: str):
    """K written by someone else's writer."""
    name = str(path / f"k.{kind.split()[0]}")
    if kind == "mtx dense":
        mmwrite(name, K, precision=17)
    elif kind == "mtx sparse":
        mmwrite(name, coo_array(K), precision=17)
    elif kind == "mtx general":
        mmwrite(name, coo_array(K), precision=17, symmetry="general")
    elif kind == "npz dense":
        np.savez(name, K=K)
    elif kind == "npz csr":
        save_npz(name, csr_array(K))
    elif kind == "npz csc":
        save_npz(name, csc_array(K))
    elif kind == "csv dense":
        np.savetxt(name, K, delimiter=",", fmt="%.17g", header="stiffness")
    elif kind == "csv semicolon":
        np.savetxt(name, K, delimiter=";", fmt="%.17g")
    else:
        row, col = np.nonzero(np.triu(K))
        lines = [f"{i + 1},{j + 1},{K[i, j]!r}" for i, j in zip(row.tolist(), col.tolist(), strict=True)]
        (path / "k.csv").write_text("\n".join(["i,j,value", *lines]).replace("np.float64(", "").replace(")", ""))
    return name


KINDS = [
    "mtx dense",
    "mtx sparse",
    "mtx general",
    "npz dense",
    "npz csr",
    "npz csc",
    "csv dense",
    "csv semicolon",
    "csv triples",
]


@pytest.mark.parametrize("kind", KINDS)
def test_each_format_gives_the_matrix(kind, tmp_path):
    found = read_matrix(stored(tmp_path, kind), order=3)
    assert isinstance(found, np.ndarray) and found.dtype == float
    np.testing.assert_array_equal(found, K)


@pytest.mark.parametrize("suffix", ["mtx", "npz", "csv"])
def test_large_matrices_stay_sparse(suffix, tmp_path):
    matrix, path = big_sparse(), tmp_path / f"k.{suffix}"
    if suffix == "mtx":
        mmwrite(path, matrix)
    elif suffix == "npz":
        save_npz(path, matrix)
    else:
        triples = zip(matrix.row + 1, matrix.col + 1, matrix.data, strict=True)
        path.write_text("row,col,value\n" + "".join(f"{i},{j},{v}\n" for i, j, v in triples))
    found = read_matrix(str(path))
    assert is_sparse(found) and found.format == "csr" and found.dtype == float
    assert abs(found - matrix.tocsr()).max() == 0


def test_written_matrix_market_is_read_by_scipy_exactly(tmp_path):
    from scipy.io import mmread

    path = tmp_path / "k.mtx"
    path.write_text(market.text(K, "a comment"))
    np.testing.assert_array_equal(mmread(path).toarray(), K)
    assert path.read_text().splitlines()[:3] == [REAL.strip(), "% a comment", "3 3 5"]


def test_upper_triangle_is_the_same_for_dense_and_sparse():
    for one, other in zip(upper_triangle(K), upper_triangle(csr_array(K)), strict=True):
        np.testing.assert_array_equal(one, other)
    assert [x.tolist() for x in upper_triangle(K)[:2]] == [[0, 0, 1, 1, 2], [0, 1, 1, 2, 2]]


def test_rounding_is_made_symmetric(tmp_path):
    path = tmp_path / "k.csv"
    path.write_text("1,0.5000000001\n0.5,1\n")
    found = read_matrix(str(path))
    assert found[0, 1] == found[1, 0] == pytest.approx(0.50000000005, abs=1e-14)


def test_tables_may_have_holes(tmp_path):
    path = tmp_path / "x.csv"
    path.write_text("# shapes\nfirst,second\n1,\nnan,2.5\n-3,4\n")
    np.testing.assert_array_equal(read_table(str(path)), [[1, np.nan], [np.nan, 2.5], [-3, 4]])


# name, contents, code, line, a word of the message
FAULTS = [
    ("k.txt", "1", "MD251", 1, ".csv"),
    ("k.mtx", "", "MD252", 1, "empty"),
    ("k.mtx", "1 2\n", "MD252", 1, "first line"),
    ("k.mtx", REAL + "% only comments\n", "MD252", 2, "size line"),
    ("k.mtx", REAL + "%\n2 2\n1 1 1\n", "MD252", 3, "size line reads '2 2'"),
    ("k.mtx", REAL + "2 2 3\n1 1 1\n", "MD252", 2, "promises at least 18 bytes"),
    ("k.mtx", REAL + "1000000 1000000 999999999999\n1 1 1\n", "MD252", 2, "promises"),
    ("k.mtx", REAL + "99999999 99999999 1\n1 1 1.0\n", "MD258", 2, "99999999"),
    ("k.mtx", "%%MatrixMarket matrix array real general\n900000 900000\n1\n", "MD252", 2, "promises"),
    ("k.mtx", REAL + "2 2 2\n1 1 1.0\n7 1 1.0000\n", "MD252", 1, "not a Matrix Market file"),
    ("k.mtx", REAL + "2 2 2\n1 1 1.0\n2 2 hello\n", "MD252", 1, "not a Matrix Market file"),
    ("k.mtx", "%%MatrixMarket matrix coordinate complex symmetric\n1 1 1\n1 1 1 2\n", "MD253", 1, "complex"),
    ("k.mtx", "%%MatrixMarket matrix coordinate pattern symmetric\n1 1 1\n1 1\n", "MD253", 1, "pattern"),
    ("k.mtx", "%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n2 1 1\n", "MD255", 1, "skew"),
    ("k.mtx", GENERAL + "2 3 1\n1 1 1.0\n", "MD254", 1, "(2, 3)"),
    ("k.mtx", GENERAL + "2 2 2\n1 1 1.0\n1 2 1.0\n", "MD255", 1, "(1,2) is 1, but (2,1) is 0"),
    ("k.mtx", REAL + "2 2 2\n1 1 1.0\n2 2 nan\n", "MD256", 1, "(2,2)"),
    ("k.mtx", REAL + "3 3 3\n1 1 1.\n2 2 1.\n3 3 1.\n", "MD257", 1, "order 3, but the model has 2"),
    ("k.csv", "", "MD252", 1, "empty"),
    ("k.csv", "\n", "MD252", 1, "no values"),
    ("k.csv", "1,0\n0\n", "MD252", 2, "1 values; expected 2"),
    ("k.csv", "1,0\n0,1.0d5\n", "MD252", 2, "'1.0d5'"),
    ("k.csv", "1,2\n", "MD254", 1, "(1, 2)"),
    ("k.csv", "1,2\n3,1\n", "MD255", 1, "(1,2) is 2, but (2,1) is 3"),
    ("k.csv", "1,inf\ninf,1\n", "MD256", 1, "(1,2)"),
    ("k.csv", "1,\n,1\n", "MD256", 1, "not finite"),
    ("k.csv", "i,j,value\n1,1,1\n0,1,1\n", "MD252", 3, "from 1"),
    ("k.csv", "i,j,value\n1,1,1\n1,1,2\n", "MD252", 3, "given twice"),
    ("k.csv", "i,j,value\n", "MD252", 1, "row and column"),
    ("k.csv", b"\xff\xfe1,2", "MD252", 1, "UTF-8"),
    ("k.npz", b"no archive", "MD252", 1, "NumPy archive"),
]


@pytest.mark.parametrize(("name", "contents", "code", "line", "word"), FAULTS, ids=range(len(FAULTS)))
def test_each_fault_is_named(name, contents, code, line, word, tmp_path):
    path = tmp_path / name
    path.write_bytes(contents if isinstance(contents, bytes) else contents.encode())
    with pytest.raises(DeckError) as caught:
        read_matrix(str(path), order=2)
    (found,) = caught.value.diagnostics
    assert (found.code, found.span.file, found.span.line) == (code, str(path), line)
    assert word in f"{found.message} {found.help}" and found.help


@pytest.mark.parametrize("what", ["missing.mtx", "."])
def test_what_is_no_file(what, tmp_path):
    with pytest.raises(DeckError, match="MD250"):
        read_matrix(str(tmp_path / what))


def archive(path, **arrays):
    np.savez(path, **arrays)
    return str(path)


@pytest.mark.parametrize(
    ("arrays", "code"),
    [
        ({"K": np.eye(2), "M": np.eye(2)}, "MD259"),
        ({"K": np.eye(2) * 1j}, "MD253"),
        ({"K": np.array([["a"]])}, "MD253"),
        ({"K": np.ones(3)}, "MD254"),
        ({"K": np.array([{}], dtype=object)}, "MD252"),
        # a csr matrix whose column index lies far outside: compiled loops would follow it
        (
            {
                "format": np.array(b"csr"),
                "shape": np.array([2, 2]),
                "data": np.ones(2),
                "indices": np.array([0, 10**9]),
                "indptr": np.array([0, 1, 2]),
            },
            "MD252",
        ),
        (
            {
                "format": np.array(b"csr"),
                "shape": np.array([2, 2]),
                "data": np.ones(1),
                "indices": np.array([0]),
                "indptr": np.array([0, 1, 10**9]),
            },
            "MD252",
        ),
    ],
    ids=range(7),
)
def test_archives_that_hold_something_else(arrays, code, tmp_path):
    with pytest.raises(DeckError, match=code):
        read_matrix(archive(tmp_path / "k.npz", **arrays))


def test_an_array_header_is_not_believed(tmp_path):
    """A header that promises 8 TB must be refused, by its size or by its missing bytes."""
    header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (1000000, 1000000), }"
    header += b" " * (118 - len(header) - 1) + b"\n"
    array = b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + b"\0" * 64
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as handle:
        handle.writestr("K.npy", array)
    (tmp_path / "k.npz").write_bytes(packed.getvalue())
    with pytest.raises(DeckError, match="MD25"):
        read_matrix(str(tmp_path / "k.npz"))


def test_truncated_archives_are_refused(tmp_path):
    whole = tmp_path / "k.npz"
    save_npz(whole, csr_array(K))
    data = whole.read_bytes()
    for cut in range(0, len(data) - 1, 37):
        whole.write_bytes(data[:cut])
        with pytest.raises(DeckError, match=r"MD25\d"):
            read_matrix(str(whole))


def test_a_failed_write_leaves_what_stood_there(tmp_path, monkeypatch):
    path = tmp_path / "out.txt"
    path.write_text("before")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", full)
    with pytest.raises(WrittenError, match="No space left"):
        write_text_atomically(path, "after")
    assert [p.name for p in tmp_path.iterdir()] == ["out.txt"] and path.read_text() == "before"


def test_an_interrupted_write_leaves_no_temporary_file(tmp_path, monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("os.replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_text_atomically(tmp_path / "out.txt", "after")
    assert not list(tmp_path.iterdir())


def test_a_write_keeps_permissions_and_links(tmp_path):
    path, link = tmp_path / "out.txt", tmp_path / "link.txt"
    path.write_text("before")
    path.chmod(0o640)
    link.symlink_to(path)
    write_text_atomically(link, "after é")
    assert link.is_symlink() and path.read_text(encoding="utf-8") == "after é"
    assert path.stat().st_mode & 0o777 == 0o640


def test_a_missing_folder_is_named(tmp_path):
    with pytest.raises(WrittenError, match="MD290"):
        write_text_atomically(tmp_path / "no" / "out.txt", "text")
