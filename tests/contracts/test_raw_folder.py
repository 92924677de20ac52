"""`mouse diagnose --recordings FOLDER`: from the raw files of a laboratory to a verdict, what was passed over, and refusals."""

import re
from pathlib import Path

import numpy as np
import pytest
import yaml

from mouse_cli.cli.main import main
from mouse_cli.formats import read_deck
from mouse_cli.formats.recording_folder import Sensors

DECK = """\
mouse: 1
title: three masses
units: SI
model:
  stiffness: {order: 3, entries: [[1,1,2e5], [1,2,-1e5], [2,2,2e5], [2,3,-1e5], [3,3,1e5]]}
  mass: {diagonal: [1, 1, 1]}
  damping: {order: 3, entries: [[1,1,5], [1,2,-2], [2,2,5], [2,3,-2], [3,3,3]]}
parameters: [{name: k1, sd: 1e4, stiffness: [[1,1,1]]}]
"""
SENSORS = """\
test:
  sensors:
    - {name: acc1, weights: {1: 1}}
    - {name: acc2, weights: {2: 1}}
    - {name: acc3, weights: {3: 1}}
"""
SPRING = 2e4  # N/m, from mass 3 to the ground: in the structure, not in the deck
FS = 1000.0


def structure(spring: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """K, C, and A of its first-order form; unit masses."""
    K = 1e5 * np.array([[2, -1, 0], [-1, 2, -1], [0, -1, 1.0]]) + np.diag([0, 0, spring])
    C = np.array([[5, -2, 0], [-2, 5, -2], [0, -2, 3.0]])
    return K, C, np.block([[np.zeros((3, 3)), np.eye(3)], [-K, -C]])


def measured(seed: int, spring: float = SPRING, n: int = 3000) -> np.ndarray:
    """Force in N and accelerations in g (n, 4) of the structure with the spring: linear between samples, integrated by scipy."""
    from scipy.signal import butter, cont2discrete, dlsim, sosfilt

    K, C, A = structure(spring)
    B = np.array([[0], [0], [0], [1.0], [0], [0]])
    rng = np.random.default_rng(seed)
    force = 30 * sosfilt(butter(4, 120, fs=FS, output="sos"), rng.standard_normal(n))
    motion = dlsim(cont2discrete((A, B, np.hstack([-K, -C]), B[3:]), 1 / FS, "foh"), force)[1]
    motion += 0.05 * motion.std() * rng.standard_normal(motion.shape)
    return np.column_stack([force, motion / 9.80665])


def laboratory(folder: Path, runs: int = 3, spring: float = SPRING) -> None:
    """The folder as a laboratory leaves it: decimal commas, a head of its program, notes beside."""
    folder.mkdir()
    for run in range(1, runs + 1):
        rows = [";".join(f"{x:.8g}" for x in row).replace(".", ",") for row in measured(run, spring)]
        head = "Operator;me\nSample rate;1000;Hz\n\nhammer;acc1;acc2;acc3\nN;g;g;g\n"
        (folder / f"run{run}.csv").write_text(head + "\n".join(rows) + "\n")
    (folder / "notes.docx").write_text("on Monday")
    (folder / "readme.txt").write_text("all on Monday\n")


@pytest.fixture
def told(capsys, monkeypatch, tmp_path):
    """Runs the command beside `deck.yaml`; gives exit code, standard output and standard error."""
    monkeypatch.chdir(tmp_path)
    Path("deck.yaml").write_text(DECK + SENSORS)

    def run(*arguments: str) -> tuple[int, str, str]:
        with pytest.raises(SystemExit) as end:
            main(["diagnose", *arguments])
        return int(end.value.code or 0), *capsys.readouterr()

    return run


@pytest.mark.proof
def test_from_raw_files_to_the_spring(told):
    """Truth: 20 kN/m between mass 3 and the ground; the deck that -o writes needs no option any more."""
    laboratory(Path("raw"))
    code, out, err = told("deck.yaml", "--recordings", "raw", "--force", "1=hammer", "-o", "revised.yaml")
    assert code == 1 and "between degree of freedom 3 and the ground" in out.split("\n")[1]
    assert float(re.search(r"stiffness (\S+) N/m", out)[1]) == pytest.approx(SPRING, rel=0.02)
    for words in (
        "raw: 3 recordings in 3 files", "1000 Hz, forces 1 = hammer, responses acc1, acc2, acc3",
        "held out from every fit: run3", "no format of recordings: notes.docx", "raw/readme.txt:1:1: warning[MD601]: passed over",
    ):  # fmt: skip
        assert words in err
    again = read_deck("revised.yaml")
    assert [each.title for each in again.recordings] == ["run1", "run2"]
    assert [each.title for each in again.held_records.recordings] == ["run3"]
    assert again.recordings[0].samples[:, 1] == pytest.approx(9.80665 * measured(1)[:, 1], rel=1e-5, abs=1e-6)


def test_without_forces_the_modes_of_the_responses_judge(told):
    """Wind on all masses, nobody measured it: three records of 20 s, whose modes show the same spring."""
    from scipy.signal import cont2discrete, dlsim

    K, C, A = structure(SPRING)
    B, D = np.vstack([np.zeros((3, 3)), np.eye(3)]), np.eye(3)
    Path("raw").mkdir()
    for run in range(3):
        rng = np.random.default_rng(run)
        wind = rng.standard_normal((5000, 3))
        motion = dlsim(cont2discrete((A, B, np.hstack([-K, -C]), D), 1 / 250), wind)[1]
        motion += 0.02 * motion.std() * rng.standard_normal(motion.shape)
        np.savetxt(f"raw/run{run}.txt", motion, header="fs = 250 Hz\nacc1 acc2 acc3\nm/s2 m/s2 m/s2")
    code, out, err = told("deck.yaml", "--recordings", "raw", "-o", "revised.yaml")
    assert "no force was measured: judged by the modes that the responses show" in err
    assert code == 1 and "degree of freedom 3" in out.split("\n")[1]
    again = read_deck("revised.yaml")
    true = np.sqrt(np.linalg.eigvalsh(K)) / 2 / np.pi
    assert np.abs((again.test.frequency_hz - true) / again.test.frequency_sd_hz).max() < 4


@pytest.mark.parametrize(
    ("other", "rate", "words"),
    [("acc1 acc3", 1000, "'setup1' and 'setup2' have different responses"), ("acc1 acc2", 500, "'setup2' 500")],
)
def test_set_ups_without_forces_are_told_what_to_do(told, other, rate, words):
    """A roving sensor beside a reference, and runs at two rates, are none of one test: the remedy is one of this command."""
    Path("raw").mkdir()
    for run, (names, hz) in enumerate([("acc1 acc2", 1000), (other, rate)], 1):
        np.savetxt(f"raw/setup{run}.txt", measured(run)[:600, 1:3], header=f"fs = {hz} Hz\n{names}\ng g")
    code, out, err = told("deck.yaml", "--recordings", "raw")
    assert code == 4 and not out and "error[MD655]" in err and words in err
    assert "give those of each set-up a folder of their own: --recordings FOLDER" in err


def test_the_deck_is_written_where_nothing_is_missing(told):
    laboratory(Path("raw"), runs=1, spring=0.0)
    code, out, err = told("deck.yaml", "--recordings", "raw", "--force", "1=hammer", "-o", "measured.yaml")
    assert code == 0
    assert out.rstrip().endswith(
        "No mechanism is named. The deck with what was measured is in measured.yaml; `mouse diagnose` accepts it."
    )
    assert [each.title for each in read_deck("measured.yaml").recordings] == ["run1"]
    assert "held out from every fit" not in err  # one record alone: its end is held out, as ever


def test_a_force_without_a_place_is_told(told):
    laboratory(Path("raw"), runs=1)
    code, out, err = told("deck.yaml", "--recordings", "raw", "-o", "revised.yaml")
    assert code == 4 and not out
    assert "error[MD626]: none of 3 files in raw is a recording of the model" in err
    assert "raw/run1.csv:1:1: warning[MD627]: passed over: channel 'hammer' is one of force" in err
    assert "--force SENSOR=hammer" in err
    assert not Path("revised.yaml").exists()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--force", "1=hammer"), "--force without --recordings FOLDER"),
        (("--recordings", "raw", "--force", "9=hammer"), "the model has no sensor '9'"),
        (("--recordings", "raw", "--force", "1=hammer", "--unit", "acc9=g"), "no recording uses a channel 'acc9'"),
        (("--recordings", "raw", "--force", "1=hammer", "-o", "other/deck.yaml"), "files below its own folder"),
        (("second.yaml", "--recordings", "raw"), "--recordings gives one deck its test"),
        (("--recordings", "raw", "--set", "NPARD=5"), "--set and --strip-73-80 are for card decks"),
        (("--recordings", ".."), "is not below the folder of the deck"),
        (("--recordings", "deck.yaml"), "is a file"),
    ],
)
def test_refusals(told, arguments, words):
    laboratory(Path("raw"), runs=1)
    Path("second.yaml").write_text(Path("deck.yaml").read_text())
    code, out, err = told("deck.yaml", *arguments)
    assert code == 2 and not out and words in err


def test_a_deck_that_names_its_recordings(told):
    laboratory(Path("raw"), runs=1)
    named = "  recordings: [{file: raw/run1.csv, inputs: {1: hammer}, outputs: {1: acc1}}]\n"
    Path("deck.yaml").write_text(DECK + SENSORS + named)
    code, _, err = told("deck.yaml", "--recordings", "raw", "--force", "1=hammer")
    assert code == 2 and "names recordings or functions itself" in err


TESTS = {
    "none": "",
    "empty": "test:\n",
    "block": SENSORS,
    "flow": "test: {sensors: [{name: acc1, weights: {1: 1}}, {name: acc2, weights: {2: 1}}, {name: acc3, weights: {3: 1}}]}\n",
    "held": "test:\n  modes: {frequency: [20, 50], frequency_sd: 1 %}\n  hold_out:\n    modes: [2]\n",
    "held in flow": "test:\n  modes: {frequency: [20, 50], frequency_sd: 1 %}\n  hold_out: {modes: [2]}\nrun: {cycles: 2}\n",
}


@pytest.mark.parametrize("kind", TESTS)
def test_recordings_in_the_text_of_any_deck(told, kind):
    """However the test of the deck is written, its recordings come into it, and all else stays."""
    from mouse_cli.formats import read_draft
    from mouse_cli.formats.assemble import assemble
    from mouse_cli.formats.recording_folder import read_folder
    from mouse_cli.formats.recording_source import Choice
    from mouse_cli.formats.yaml_deck.add_recordings import sensor_names, with_recordings

    laboratory(Path("raw"))
    choice = Choice(("1=hammer",), ("1=acc1", "2=acc2", "3=acc3"))
    before = DECK + TESTS[kind]
    sensors = Sensors(sensor_names(before, "deck.yaml")[0], ("1", "2", "3"))
    found = read_folder("raw", choice, sensors)
    after = with_recordings(before, "deck.yaml", found.records, found.held, choice)
    problem = assemble(read_draft(after, "deck.yaml"))
    assert [each.title for each in problem.recordings] == ["run1", "run2"]
    assert [each.title for each in problem.held_records.recordings] == ["run3"]
    kept, had = yaml.safe_load(after), yaml.safe_load(before)
    kept["test"].pop("recordings")
    kept["test"]["hold_out"].pop("recordings")
    had["test"] = (had.get("test") or {}) | {"hold_out": (had.get("test") or {}).get("hold_out", {})}
    assert kept == had


@pytest.mark.parametrize(
    ("channel", "sensor"),
    [
        ("12TY", "12TY"), ("acc 12ty", "12TY"), ("Run.12-TY", "12-TY"), ("12:+Y", None), ("112TY", None), ("12TYX", None),
        ("tip", "tip"), ("run 1.TIP", "tip"), ("3", None), ("12TY-12TX", None),
    ],
)  # fmt: skip
def test_channels_by_their_names(channel, sensor):
    assert Sensors(("tip",), ("3", "12TX", "12TY")).of(channel) == sensor


def test_what_is_wrong_with_a_file_is_told_with_channel_and_sample(told):
    """One sound file among damaged ones: it is taken, each of the others is told by its fault."""
    from mouse_cli.formats.recording_folder import read_folder
    from mouse_cli.formats.recording_source import Choice

    Path("raw").mkdir()
    values = np.column_stack([np.arange(500) / FS, measured(1)[:500, :2]])

    def write(name: str, table: np.ndarray, head: str = "t (s),1TX (N),2TX (g)") -> None:
        np.savetxt(f"raw/{name}", table, delimiter=",", header=head, comments="", fmt="%.9g")

    dead, gap, back, twice, clipped = (values.copy() for _ in range(5))
    dead[:, 2], gap[77, 2], back[300:, 0], twice[300:, 0] = 0.0, np.nan, back[300:, 0] - 0.2, twice[300:, 0] - 1e-3
    clipped[:, 2] = np.clip(clipped[:, 2], -clipped[:, 2].std(), clipped[:, 2].std())
    tables = {"a": values, "dead": dead, "gap": gap, "back": back, "twice": twice, "clipped": clipped}
    for name, table in tables.items():
        write(f"{name}.csv", table)
    write("slow.csv", values, "Sample rate,512\nt (s),1TX (N),2TX (g)")
    Path("raw/cut.csv").write_text(Path("raw/a.csv").read_text()[:5000].rpartition(",")[0])
    Path("raw/empty.csv").write_text("")
    found = read_folder("raw", Choice(), Sensors((), ("1TX", "2TX")))
    assert [each.recording.title for each in found.records] == ["a"]
    said = {f"{each.span.file} {each.code} {each.message}" for each in found.passed}
    for words in (
        "raw/dead.csv MD607 passed over: channel '2TX' is dead: all 500 samples from 0 on are zero",
        "raw/gap.csv MD605 passed over: 1 samples of channel '2TX' are no numbers, the first is sample 77",
        "raw/back.csv MD604 passed over: time runs backwards in column 't' at sample 300",
        "raw/twice.csv MD604 passed over: sample 300 has the time of the one before it in column 't'",
        "raw/slow.csv MD603 passed over: the file says 512 samples a second, its time column 1000",
        "raw/empty.csv MD252 passed over: the file is empty",
    ):
        assert words in said, said
    assert any(each.startswith("raw/cut.csv MD252 passed over: the line has") for each in said), said
    top = clipped[:, 2].max()
    runs = np.flatnonzero(np.diff(clipped[:, 2] == top, prepend=False, append=False)).reshape(-1, 2)
    first = next(begin for begin, end in runs if end - begin >= 3)  # two samples may be equal by chance
    begun = f"raw/clipped.csv MD606 passed over: channel '2TX' is clipped at {9.80665 * top:.6g} m/s2: "
    assert any(each.startswith(begun) and each.endswith(f"the first is sample {first}") for each in said), said
    assert all(each.severity == "warning" for each in found.passed)


def test_recordings_that_are_all_clipped_are_taken_with_a_warning(told):
    """There is nothing better to judge by."""
    laboratory(Path("raw"), runs=1)
    values = measured(1, 0.0)
    values[:, 2] = np.clip(values[:, 2], -2 * values[:, 2].std(), 2 * values[:, 2].std())
    for run in (1, 2):
        np.savetxt(
            f"raw/run{run}.csv", values, delimiter=",", header="hammer [N],acc1 [g],acc2 [g],acc3 [g]", comments=""
        )
    _, out, err = told(
        "deck.yaml", "--recordings", "raw", "--force", "1=hammer", "--sample-rate", "1000", "--candidates", "spring"
    )
    assert out and "raw: 2 recordings in 2 files" in err and "warning[MD606]: channel 'acc2' is clipped" in err


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-be"])
@pytest.mark.parametrize("point", [".", ","])
def test_tables_that_windows_calls_unicode(told, encoding, point):
    from mouse_cli.formats.recording_files import read_contents

    mark = "\ufeff" if encoding == "utf-16-be" else ""
    rows = [["0.001", "2.5"], ["0.002", "-1"], ["0.003", ""]]
    text = "t (s)\tF (N)\n" + "".join("\t".join(row) + "\n" for row in rows).replace(".", point)
    for name, part in (("gap.txt", text), ("whole.txt", text.rpartition("0" + point)[0])):
        Path(name).write_bytes((mark + part).encode(encoding))
        columns = read_contents(name).columns
        assert [(each.name, each.unit) for each in columns] == [("t", "s"), ("F", "N")]
        assert columns[1].values[:2] == pytest.approx([2.5, -1.0])


def test_labview_without_heads(told):
    """`Segment headers: none`, and no times: the first column is empty."""
    from mouse_cli.formats.recording_folder import read_folder
    from mouse_cli.formats.recording_source import Choice

    Path("raw").mkdir()
    values = measured(1)[:500, :2]
    rows = ["\t" + "\t".join(f"{x:.7g}" for x in row) for row in values]
    Path("raw/run.lvm").write_text("X_Value\t1TX\t2TX\tComment\n" + "\n".join(rows) + "\n")
    found = read_folder("raw", Choice(("1TX",), sample_rate_hz=1000.0), Sensors((), ("1TX", "2TX")))
    assert found.records[0].recording.samples[:, 1] == pytest.approx(values[:, 1], abs=1e-5)


def test_channels_of_a_struct_by_their_own_names(told):
    """A `.mat` whose struct `meas` holds hammers and sensors: forces, units and time are found in each."""
    from scipy.io import savemat

    from mouse_cli.formats.recording_folder import read_folder
    from mouse_cli.formats.recording_source import Choice

    Path("raw").mkdir()
    values = measured(1)[:500]
    for run, hammer in enumerate(("H1", "H2"), 1):
        meas = {"clock": np.arange(500) / FS, hammer: values[:, 0], "ax": values[:, 1], "acc2": values[:, 2]}
        savemat(f"raw/hit{run}.mat", {"meas": meas})
    choice = Choice(("1=H1", "2=h2"), (), {"acc2": "g", "meas.H1": "kN"}, time="clock")
    found = read_folder("raw", choice, Sensors(("acc1", "acc2"), ("1", "2", "3")))
    assert [each.channels("input") for each in found.records] == [[("1", "meas.H1")], [("2", "meas.H2")]]
    assert [each.channels("output") for each in found.records] == 2 * [[("acc2", "meas.acc2")]]
    assert not found.passed and found.unused == ("meas.ax",)
    one = found.records[0].recording
    assert one.sample_rate_hz == pytest.approx(FS)
    assert one.samples == pytest.approx(values[:, [0, 2]] * [1000.0, 9.80665])
    code, _, err = told("deck.yaml", "--recordings", "raw", "--force", "1=H1", "--unit", "acc9=g", "--time", "clock")
    assert code == 2 and "no recording uses a channel 'acc9'; they use meas.H1, meas.acc2" in err


def test_an_own_name_that_two_structs_have_is_told(told):
    from scipy.io import savemat

    Path("raw").mkdir()
    fast, slow = measured(1)[:500], measured(2)[:500]
    structs = {name: {"hammer": table[:, 0], "acc1": table[:, 1]} for name, table in (("fast", fast), ("slow", slow))}
    savemat("raw/hit.mat", {"fs": FS, **structs})
    code, _, err = told("deck.yaml", "--recordings", "raw", "--force", "1=hammer")
    assert code == 4 and "the file has several channels 'hammer'; it has fast.hammer" in err


def stood_still(values: np.ndarray) -> None:
    values[1000:1400, 2] = values[1000, 2]


def exchanged(values: np.ndarray) -> None:
    values[:, [1, 3]] = values[:, [3, 1]]


@pytest.mark.parametrize(
    ("fault", "words"),
    [
        (
            exchanged,
            "% of recording 'run2' (raw/run2.csv) unexplained; with channels acc1 and acc3 exchanged, it would leave",
        ),
        (stood_still, "Recording 'run2' alone is at odds with the model:"),
    ],
)
def test_one_run_that_is_at_odds_with_the_others_is_named(told, fault, words):
    """A fit looks for laws and noise in the loudest run; what another one left was called noise, and nothing missing."""
    Path("raw").mkdir()
    for run, size in ((1, 1.5), (2, 1.0), (3, 1.5)):
        values = size * measured(run, 0.0)
        if run == 2:
            fault(values)
        np.savetxt(
            f"raw/run{run}.csv", values, delimiter=",", header="hammer [N],acc1 [g],acc2 [g],acc3 [g]", comments=""
        )
    code, out, err = told(
        "deck.yaml", "--recordings", "raw", "--force", "1=hammer", "--sample-rate", "1000", "--candidates", "spring"
    )
    assert code != 0 and words in " ".join((out + err).split())
    assert fault is exchanged or "of channel acc2 remains, from sample" in " ".join(out.split())


def test_segments_of_one_file_are_recordings_of_their_own(told):
    import sys

    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "property"))
    import samples

    from mouse_cli.formats.recording_folder import read_folder
    from mouse_cli.formats.recording_source import Choice

    Path("raw").mkdir()
    values = measured(1)[:, :2]
    parts = [samples.segment(values[k : k + 500], 0.0, 1 / FS, "1TX\t2TX") for k in (0, 500, 1000)]
    Path("raw/run.lvm").write_text(samples.LVM + "".join(parts))
    found = read_folder("raw", Choice(), Sensors((), ("1TX", "2TX")))
    assert [each.recording.title for each in found.records] == ["run[0:500]", "run[500:1000]", "run[1000:1500]"]
    assert found.held == "run[1000:1500]"
    assert [pick.role for pick in found.records[0].picks] == ["input", "output"]  # by their units
    assert found.records[1].recording.samples[:, 0] == pytest.approx(values[500:1000, 0], abs=1e-5)
