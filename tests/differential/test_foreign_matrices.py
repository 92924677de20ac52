"""Files written by the programs that the formats belong to, or by independent libraries; their own answers are the truth.

CalculiX: eigenvalues it prints. MSC and NX Nastran: files that pyyeti ships, with the eigenvalues Nastran found. GNU Octave,
h5py, hdf5storage, SciPy and pyyeti: matrices that they wrote. Each is skipped where the program is absent.
"""

import shutil
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
from scipy.io import hb_write, savemat
from scipy.linalg import eigh
from scipy.sparse import coo_array, csc_array, csc_matrix, csr_array

from mouse_cli._errors import DeckError
from mouse_cli.formats import read_deck
from mouse_cli.formats.dof_files import read_dofs
from mouse_cli.formats.matrix_files import read_contents, read_matrix, read_table
from mouse_cli.formats.node_files import read_nodes
from mouse_cli.updating import run

DECKS = Path(__file__).resolve().parents[2] / "decks"
K = np.array([[2.5e5, -1.5e5, 0], [-1.5e5, 2.65e5, -1.15e5], [0, -1.15e5, 1 / 3]])


def calculix(folder: Path, step: str) -> Path:
    """Files of a CalculiX run of the strip of decks/plate_calculix with another step."""
    if not shutil.which("ccx"):
        pytest.skip("needs CalculiX (ccx)")
    text = (DECKS / "plate_calculix" / "plate.inp").read_text()
    (folder / "job.inp").write_text(text[: text.index("*STEP")] + f"*STEP\n{step}*END STEP\n")
    subprocess.run(["ccx", "job"], cwd=folder, check=True, capture_output=True, timeout=120)
    return folder / "job"


def printed_frequencies(job: Path) -> np.ndarray:
    """Natural frequencies in Hz that CalculiX prints, to seven digits."""
    table = job.with_suffix(".dat").read_text().split("P A R T I C I P A T I O N")[0]
    rows = (line.split() for line in table.splitlines())
    return np.array([float(row[3]) for row in rows if len(row) == 5 and row[0].isdigit()])


def test_calculix_finds_the_eigenvalues_of_its_matrix_files(tmp_path):
    truth = printed_frequencies(calculix(tmp_path, "*FREQUENCY\n8\n"))
    job = calculix(tmp_path, "*FREQUENCY, SOLVER=MATRIXSTORAGE\n8\n")
    stiffness, mass = read_matrix(f"{job}.sti"), read_matrix(f"{job}.mas")
    found = np.sqrt(eigh(stiffness, mass, eigvals_only=True)[:8]) / (2 * np.pi)
    np.testing.assert_allclose(found, truth, rtol=5e-7)  # seven digits are printed
    dofs, (ids, coordinates) = read_dofs(f"{job}.dof"), read_nodes(f"{job}.inp")
    assert len(dofs) == len(stiffness)
    translation = (dofs.direction == 2).astype(float)  # all along z: the mass that is not at the clamped nodes
    assert 0 < translation @ mass @ translation < 0.4 * 0.12 * 0.012 * (2700 + 1550) / 2
    geometry = dofs.geometry(ids, coordinates)
    assert geometry.coordinates[geometry.node].min(axis=0)[0] > 0  # the root does not move


def test_the_deck_made_with_calculix_recovers_what_calculix_was_given():
    result = run(read_deck(DECKS / "plate_calculix.yaml"))
    sd = result.sd_theta
    assert result.exit_code == 0
    assert (abs(result.revised.theta - [66.5, 51.6]) < 2 * sd).all()
    assert (sd < [0.5, 0.5]).all()  # GPa, of 7 before


def test_calculix_agrees_with_the_revised_frequencies(tmp_path):
    truth = printed_frequencies(calculix(tmp_path, "*FREQUENCY\n6\n"))
    problem = read_deck(DECKS / "plate_calculix.yaml")
    found = np.sqrt(eigh(problem.structure.K, problem.structure.M, eigvals_only=True)[:6]) / (2 * np.pi)
    np.testing.assert_allclose(found, truth, rtol=5e-7)  # seven digits are printed
    assert problem.structure.labels[:3] == ("2TX", "2TY", "2TZ")


@pytest.fixture
def op4():
    return pytest.importorskip("pyyeti.nastran.op4", reason="needs pyyeti", exc_type=ImportError)


def nastran_files() -> Path:
    """The folder of Nastran files in pyyeti's distribution."""
    pyyeti = pytest.importorskip("pyyeti", reason="needs pyyeti", exc_type=ImportError)
    folder = Path(pyyeti.__file__).parent / "tests"
    if not folder.is_dir():
        pytest.skip("pyyeti came without its Nastran files")
    return folder


@pytest.mark.parametrize("binary", [True, False])
@pytest.mark.parametrize("sparse", ["dense", "bigmat", "nonbigmat"])
@pytest.mark.parametrize("endian", ["<", ">"])
def test_output4_of_pyyeti(binary, sparse, endian, op4, tmp_path):
    path = str(tmp_path / "k.op4")
    op4.write(path, {"kaa": K, "maa": np.diag([1.0, 2, 3])}, binary=binary, sparse=sparse, endian=endian)
    np.testing.assert_allclose(read_matrix(path, variable="KAA"), K, rtol=0 if binary else 1e-15)
    np.testing.assert_array_equal(read_matrix(path, variable="maa"), np.diag([1.0, 2, 3]))


def test_output4_of_nastran_as_pyyeti_reads_it(op4):
    """Every real matrix of every file: text and binary, single and double, words of 4 and 8 bytes, both byte orders."""
    compared = 0
    for path in sorted(nastran_files().rglob("*.op4")):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            names, matrices, _, types = op4.load(str(path), into="list", sparse=True)
        for name, matrix, kind in zip(names, matrices, types, strict=True):
            if kind > 2 or names.count(name) > 1 or max(matrix.shape) > 10_000 or name.startswith("m0"):
                continue
            try:
                found = read_table(str(path), name)
            except DeckError as error:
                assert "badname" in path.name, error  # pyyeti makes up names where Nastran's are none
                continue
            np.testing.assert_array_equal(found, csr_array(matrix).toarray(), err_msg=f"{path.name} {name}")
            compared += 1
    assert compared > 300


def test_nastran_finds_the_eigenvalues_of_its_matrices():
    """Free-free superelement: Nastran's own Lanczos eigenvalues beside its KAA and MAA."""
    path = str(nastran_files() / "nas2cam_extseout" / "nas2cam_notall6_msc2017.op4")
    stiffness, mass = (read_matrix(path, variable=name) for name in ("KAA:2", "MAA:2"))
    truth = read_table(path, "LAMBDA:2").ravel()
    found = eigh(stiffness, mass, eigvals_only=True)[: len(truth)]
    np.testing.assert_allclose(found[6:], truth[6:], rtol=1e-8)
    assert abs(found[:6]).max() < 1e-5


def test_dmig_punched_by_nastran_as_pyyeti_reads_it():
    bulk = pytest.importorskip("pyyeti.nastran.bulk", reason="needs pyyeti", exc_type=ImportError)
    path = str(nastran_files() / "nastran_dmig_data" / "matrix_factory.pch")
    truth = bulk.rddmig(path, expanded=False, square=True)
    for name in ("patrn", "ident", "randm"):
        frame = truth[name]
        try:
            found = read_contents(path, variable=name)
        except DeckError as error:
            assert error.diagnostics[0].code == "MD255" and not np.array_equal(frame, np.transpose(frame))
            continue
        np.testing.assert_array_equal(found.matrix, frame.to_numpy())
        assert [(n, d + 1) for n, d in zip(found.dofs.node, found.dofs.direction, strict=True)] == list(frame.index)


def test_dmig_written_by_pyyeti(tmp_path):
    bulk = pytest.importorskip("pyyeti.nastran.bulk", reason="needs pyyeti", exc_type=ImportError)
    pandas = pytest.importorskip("pandas", reason="needs pandas")
    index = pandas.MultiIndex.from_tuples([(3, 1), (12, 2), (40, 0)], names=["id", "dof"])
    path = str(tmp_path / "k.pch")
    bulk.wtdmig(path, {"kgg": pandas.DataFrame(K, index=index, columns=index)})
    found = read_contents(path)
    np.testing.assert_allclose(found.matrix, K, rtol=1e-9)  # ten digits on cards
    assert found.dofs.labels() == ("3TX", "12TY", "40S")


def test_superelement_of_nastran_has_its_boundary_nodes(op4):
    ids, coordinates = read_nodes(str(nastran_files() / "nas2cam_extseout" / "inboard.pch"))
    assert ids.tolist() == [3, 11, 19, 27]
    np.testing.assert_array_equal(coordinates[1], [600, 300, 300])


def test_octave_matlab_and_hdf5_files(tmp_path):
    if not shutil.which("octave-cli"):
        pytest.skip("needs GNU Octave")
    made = "K=[2 -1 0;-1 2 -1;0 -1 1/3]; M=sparse(K); s.K=K; "
    kinds = {"o7.mat": "-v7", "o6.mat": "-v6", "o.h5": "-hdf5"}
    saved = [f"save('{flag}','{tmp_path / name}','K','M','s');" for name, flag in kinds.items()]
    subprocess.run(
        ["octave-cli", "--quiet", "--eval", made + "".join(saved)], check=False, capture_output=True, timeout=120
    )
    truth = np.array([[2, -1, 0], [-1, 2, -1], [0, -1, 1 / 3]])
    pytest.importorskip("h5py", reason="needs h5py")
    for name in kinds:
        for variable in ("K", "M") if name == "o.h5" else ("K", "M", "s.K"):
            np.testing.assert_array_equal(
                read_matrix(str(tmp_path / name), variable=variable), truth, f"{name} {variable}"
            )


def test_matlab_7_3_of_hdf5storage(tmp_path):
    hdf5storage = pytest.importorskip("hdf5storage", reason="needs hdf5storage")
    path = str(tmp_path / "k.mat")
    hdf5storage.savemat(path, {"K": K, "phi": K[:, :2]}, format="7.3", truncate_existing=True)
    np.testing.assert_array_equal(read_matrix(path, variable="K"), K)
    np.testing.assert_array_equal(read_table(path, "phi"), K[:, :2])


@pytest.mark.parametrize("layout", ["dense", "csr", "csc", "coo", "matlab"])
def test_layouts_of_hdf5(layout, tmp_path):
    h5py = pytest.importorskip("h5py", reason="needs h5py")
    path = str(tmp_path / "k.h5")
    with h5py.File(path, "w") as file:
        if layout == "dense":
            file["model/K"] = K
        else:
            group = file.create_group("model/K")
            _sparse(group, layout)
    np.testing.assert_array_equal(read_matrix(path, variable="model/K"), K)


def _sparse(group, layout: str) -> None:
    if layout == "coo":
        stored = coo_array(K)
        group["row"], group["col"], group["data"], group["shape"] = stored.row, stored.col, stored.data, stored.shape
        return
    stored = csr_array(K) if layout == "csr" else csc_array(K)
    names = ("data", "ir", "jc") if layout == "matlab" else ("data", "indices", "indptr")
    for name, values in zip(names, (stored.data, stored.indices, stored.indptr), strict=True):
        group[name] = values
    if layout == "matlab":
        group.attrs["MATLAB_sparse"] = np.uint64(3)
    else:
        group.attrs["shape"], group.attrs["encoding-type"] = stored.shape, f"{layout}_matrix"


def test_hdf5_links_do_not_lead_out_of_the_file(tmp_path):
    h5py = pytest.importorskip("h5py", reason="needs h5py")
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["K"] = K
    with h5py.File(tmp_path / "k.h5", "w") as file:
        file["K"] = h5py.ExternalLink("other.h5", "K")
    with pytest.raises(DeckError, match=r"MD252.*another file"):
        read_matrix(str(tmp_path / "k.h5"))


def test_without_h5py_the_remedy_is_told(tmp_path, monkeypatch):
    h5py = pytest.importorskip("h5py", reason="needs h5py")
    with h5py.File(tmp_path / "k.h5", "w") as file:
        file["K"] = K
    monkeypatch.setitem(sys.modules, "h5py", None)
    with pytest.raises(DeckError, match="MD261") as caught:
        read_matrix(str(tmp_path / "k.h5"))
    assert "mouse-cli[hdf5]" in caught.value.diagnostics[0].help


def test_harwell_boeing_of_scipy(tmp_path):
    path = str(tmp_path / "k.hb")
    hb_write(path, csc_matrix(K))
    np.testing.assert_allclose(read_matrix(path), K, rtol=1e-15)


@pytest.mark.parametrize("version", ["4", "5"])
def test_matlab_of_scipy(version, tmp_path):
    path = str(tmp_path / "k.mat")
    savemat(path, {"K": K, "M": csc_array(K)}, format=version)
    for name in ("K", "M"):
        np.testing.assert_array_equal(read_matrix(path, variable=name), K)
