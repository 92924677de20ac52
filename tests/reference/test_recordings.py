"""Measured data of decks: files written by independent programs read back, units, faults with channel and sample, real data."""

import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "property"))
import samples

from mouse_cli._errors import DeckError, RecordError
from mouse_cli.cli.main import _run
from mouse_cli.formats import read_deck, write_deck
from mouse_cli.formats.recording_files import read_contents
from mouse_cli.formats.recording_source import Choice, read_recording
from mouse_cli.model.channel_units import ratio, unit
from mouse_cli.records.faults import clock, faults

SHARED = Path(__file__).resolve().parents[3] / "shared" / "data"
FS = 500.0
T = np.arange(1000) / FS
FORCE = np.sin(2 * np.pi * 7 * T) + 0.1 * np.cos(2 * np.pi * 31 * T)
MOTION = np.cos(2 * np.pi * 11 * T) + 0.2 * np.sin(2 * np.pi * 23 * T)

DECK = """\
mouse: 1
title: two masses
{units}model: {{stiffness: {{order: 2, entries: [[1,1,2e4],[1,2,-1e4],[2,2,1e4]]}}, mass: {{diagonal: [1, 1]}}}}
parameters: [{{name: k, sd: 100, stiffness: [[1,1,1]]}}]
test:
{test}
"""


def problem(tmp_path, test: str, units: str = ""):
    """The deck with this `test:`, in `tmp_path`."""
    path = tmp_path / "deck.yaml"
    path.write_text(DECK.format(test="\n".join(f"  {line}" for line in test.strip().splitlines()), units=units))
    return read_deck(path)


def found(tmp_path, test: str, code: str) -> str:
    """The message of the finding `code`, an error."""
    with pytest.raises(DeckError) as caught:
        problem(tmp_path, test)
    messages = [d.message for d in caught.value.diagnostics if d.code == code]
    assert messages, [d.headline for d in caught.value.diagnostics]
    return messages[0]


def table(path, *columns, head="t,force,acc", delimiter=","):
    np.savetxt(path, np.column_stack(columns), delimiter=delimiter, header=head, comments="", fmt="%.9g")


RUN = "recordings: [{file: run.csv, inputs: {1: force}, outputs: {2: acc}}]"


# --- formats, each written by somebody else ---


def test_csv_with_names_and_units(tmp_path):
    table(tmp_path / "run.csv", T, FORCE, MOTION, head="time (s);force (kN);acc [g]", delimiter=";")
    recording = problem(tmp_path, RUN).recordings[0]
    assert recording.sample_rate_hz == pytest.approx(FS)
    assert [c.unit for c in recording.channels] == ["N", "m/s2"]
    assert recording.samples[:, 0] == pytest.approx(1000 * FORCE, abs=1e-4)
    assert recording.samples[:, 1] == pytest.approx(9.80665 * MOTION, abs=1e-6)


def test_csv_of_other_countries(tmp_path):
    """Semicolons, decimal commas, a line of units, a byte order mark, CR LF."""
    rows = [f"{t:.4f};{x:.6f}".replace(".", ",") for t, x in zip(T, MOTION, strict=True)]
    text = "\ufeffProtokoll 7\r\nZeit;Kanal 1\r\ns;mm/s²\r\n" + "\r\n".join(rows) + "\r\n"
    (tmp_path / "run.csv").write_bytes(text.encode("utf-8"))
    recording = problem(tmp_path, "recordings: [{file: run.csv, outputs: {2: Kanal 1}}]").recordings[0]
    assert recording.samples[:, 0] == pytest.approx(MOTION / 1000, abs=1e-9)
    assert recording.sample_rate_hz == pytest.approx(FS)


def test_wav(tmp_path):
    from scipy.io import wavfile

    wavfile.write(tmp_path / "run.wav", 8000, (np.column_stack([FORCE, MOTION]) * 20000).astype(np.int16))
    recording = problem(tmp_path, "recordings: [{file: run.wav, inputs: {1: 1}, outputs: {2: 2}}]").recordings[0]
    assert recording.sample_rate_hz == 8000
    assert recording.samples[:, 1] == pytest.approx(MOTION * 20000 / 2**15, abs=1 / 2**15)


def test_mat_and_structs(tmp_path):
    from scipy.io import savemat

    savemat(tmp_path / "run.mat", {"run": {"force": FORCE, "Y": np.column_stack([FORCE, MOTION]), "fs": FS}})
    recording = problem(
        tmp_path, "recordings: [{file: run.mat, inputs: {1: run.force}, outputs: {2: 'run.Y[2]'}}]"
    ).recordings[0]
    assert recording.sample_rate_hz == FS
    assert (recording.samples == np.column_stack([FORCE, MOTION])).all()


def test_a_channel_is_found_by_its_name_within_a_struct(tmp_path):
    from scipy.io import savemat

    path = str(tmp_path / "run.mat")
    savemat(path, {"run": {"force": FORCE, "acc": MOTION, "fs": FS}})
    found, _ = read_recording(path, Choice(forces=("1=Force",)))
    assert [one.name for one in found.channels] == ["run.force", "run.acc"]
    with pytest.raises(RecordError) as refused:
        read_recording(path, Choice())
    assert "run.force, run.acc" in refused.value.diagnostics[0].note
    savemat(path, {"run": {"force": FORCE}, "more": {"force": FORCE}, "fs": FS})
    with pytest.raises(RecordError, match="2 channels of the file"):
        read_recording(path, Choice(forces=("1=force",)))


def test_hdf5_and_mat_7_3(tmp_path):
    h5py = pytest.importorskip("h5py")
    hdf5storage = pytest.importorskip("hdf5storage", reason="needs hdf5storage, which writes MATLAB 7.3")
    with h5py.File(tmp_path / "run.h5", "w") as file:
        file.attrs["fs"] = FS
        group = file.create_group("run")
        group["force"], group["acc"] = FORCE, MOTION
        group["acc"].attrs["unit"] = "g"
    hdf5storage.savemat(str(tmp_path / "run.mat"), {"force": FORCE, "acc": MOTION, "fs": FS}, format="7.3")
    recording = problem(
        tmp_path, "recordings: [{file: run.h5, inputs: {1: run.force}, outputs: {2: run.acc}}]"
    ).recordings[0]
    assert recording.sample_rate_hz == FS and recording.samples[:, 1] == pytest.approx(9.80665 * MOTION)
    recording = problem(tmp_path, "recordings: [{file: run.mat, inputs: {1: force}, outputs: {2: acc}}]").recordings[0]
    assert recording.sample_rate_hz == FS and (recording.samples[:, 1] == MOTION).all()


def test_tdms(tmp_path):
    nptdms = pytest.importorskip("nptdms")
    properties = {"wf_increment": 1 / FS, "unit_string": "g"}
    with nptdms.TdmsWriter(tmp_path / "run.tdms") as writer:
        writer.write_segment(
            [
                nptdms.ChannelObject("run", "force", FORCE, {"wf_increment": 1 / FS, "unit_string": "N"}),
                nptdms.ChannelObject("run", "acc", MOTION, properties),
            ]
        )
    recording = problem(
        tmp_path, "recordings: [{file: run.tdms, inputs: {1: run.force}, outputs: {2: run.acc}}]"
    ).recordings[0]
    assert recording.sample_rate_hz == pytest.approx(FS)
    assert recording.samples == pytest.approx(np.column_stack([FORCE, 9.80665 * MOTION]))


def lvm(path, *segments: str) -> None:
    """Segments as LabVIEW writes them, in the sample of `tests/property`, which the package lvm_read reads too."""
    path.write_text(samples.LVM + "".join(segments))


def test_lvm_as_another_program_reads_it(tmp_path):
    """lvm_read of Slavic et al. is the independent reader; a comment and a decimal comma are in the file."""
    lvm_read = pytest.importorskip("lvm_read", reason="needs lvm_read")
    values = np.column_stack([FORCE, MOTION])
    lvm(
        tmp_path / "run.lvm",
        samples.segment(values[:400], 0.0, 1 / FS),
        samples.segment(values[400:], 400 / FS, 1 / FS),
    )
    other = lvm_read.read_str((tmp_path / "run.lvm").read_text())
    ours = read_contents(str(tmp_path / "run.lvm"))
    theirs = np.vstack([other[0]["data"], other[1]["data"]])[:, :3]
    assert np.column_stack([each.values for each in ours.columns]) == pytest.approx(theirs)
    assert not ours.stretches  # the second segment goes on where the first ended


@pytest.mark.parametrize("name", ["run.lvm", "run.txt"])
def test_lvm(tmp_path, name):
    lvm(tmp_path / name, samples.segment(np.column_stack([FORCE, MOTION]), 0.0, 1 / FS))
    recording = problem(
        tmp_path, f"recordings: [{{file: {name}, inputs: {{1: hammer}}, outputs: {{2: 12TY}}}}]"
    ).recordings[0]
    assert recording.sample_rate_hz == pytest.approx(FS) and [c.unit for c in recording.channels] == ["N", "m/s2"]
    assert recording.samples == pytest.approx(np.column_stack([FORCE, 9.80665 * MOTION]), abs=1e-5)


def test_lvm_of_two_records_says_where_the_second_begins(tmp_path):
    values = np.column_stack([FORCE, MOTION])
    lvm(tmp_path / "run.lvm", samples.segment(values[:400], 0, 1 / FS), samples.segment(values[400:], 0, 1 / FS))
    assert read_contents(str(tmp_path / "run.lvm")).stretches == ((0, 400), (400, 1000))
    run = "recordings: [{file: run.lvm, inputs: {1: hammer}, outputs: {2: 12TY}}]"
    message = "time runs backwards in column 'X_Value' at sample 400"
    assert found(tmp_path, run, "MD604") == message
    second = problem(tmp_path, run.replace("}]", ", segment: [400, 1000]}]"))
    assert second.recordings[0].samples[:, 0] == pytest.approx(FORCE[400:], abs=1e-6)


def test_lvm_damaged(tmp_path):
    values = np.column_stack([FORCE, MOTION])
    text = samples.LVM + samples.segment(values, 0, 1 / FS)
    run = "recordings: [{file: run.lvm, inputs: {1: hammer}, outputs: {2: 12TY}}]"
    (tmp_path / "run.lvm").write_text("\n".join(text.split("\n")[:800]))
    assert "channel 'hammer' has 782 samples" in found(tmp_path, run, "MD252")
    (tmp_path / "run.lvm").write_text(text.replace("0,100000\t", "0,1#0000\t"))
    assert found(tmp_path, run, "MD252") == "'0,1#0000' is no number"
    (tmp_path / "run.lvm").write_text(text[: text.index("***End")])
    assert "no head of a segment" in found(tmp_path, run, "MD252")
    rows = text.split("\n")
    short = [row if k < 1008 else "\t".join([*row.split("\t")[:2], "", ""]) for k, row in enumerate(rows)]
    (tmp_path / "run.lvm").write_text("\n".join(short).replace("Samples\t1000\t1000", "Samples\t1000\t990"))
    assert "channel 'hammer' has 1000 samples, channel '12TY' 990" in found(tmp_path, run, "MD608")


HEADS = {
    "Sample rate;500,0;Hz\nStart;12:00\n\nAI 1;AI 2\nN;g\n": ";",  # names, then units, below lines of the program
    "# operator: me\n# fs = 0.5 kHz\n# AI_1 [N]\tAI_2 [g]\n": "\t",
    "Operator,me\nSampling interval: 2 ms\nAI 1 (N),AI 2 (g)\n": ",",
    "channel names:\nAI 1 (N)\tAI 2 (g)\nstart times:\n1/2/2024 10:00\t1/2/2024 10:00\ndt:\n0.002000\t0.002000\ndata:\n": "\t",
    "AI 1;AI 2\nN;g\nSampling frequency [Hz];500\n": ";",
}


@pytest.mark.parametrize(("head", "delimiter"), HEADS.items())
def test_heads_of_other_programs(tmp_path, head, delimiter):
    """Names, units and the rate are where Dewesoft, catman, SignalExpress and hands put them; there is no time column."""
    rows = [f"{a:.6f}{delimiter}{b:.6f}" for a, b in zip(FORCE, MOTION, strict=True)]
    text = head + "\n".join(row.replace(".", ",") if delimiter == ";" else row for row in rows) + "\n"
    (tmp_path / "run.csv").write_bytes(text.encode("cp1252"))
    held = read_contents(str(tmp_path / "run.csv"))
    assert held.sample_rate_hz == pytest.approx(FS)
    assert [(each.name.replace("_", " "), each.unit) for each in held.columns] == [("AI 1", "N"), ("AI 2", "g")]
    assert held.columns[1].values == pytest.approx(MOTION, abs=1e-6)


@pytest.mark.parametrize(("date", "comma"), [("", "."), ("2024-02-28 ", ","), ("2024-12-31T", ".")])
def test_times_of_day(tmp_path, date, comma):
    """A logger that writes the clock beside each sample, over midnight where it writes the date."""
    from datetime import datetime, timedelta

    start = datetime.fromisoformat(f"{date.strip(' T') or '2024-01-01'}T23:59:5{'0' if not date else '9'}.500")
    stamp = lambda t: (start + timedelta(seconds=float(t))).isoformat(sep=date[-1:] or " ", timespec="milliseconds")
    clock = [stamp(t) if date else stamp(t).partition(" ")[2] for t in T]
    rows = [f"{at.replace('.', comma)};{a:.6f};{b:.6f}" for at, a, b in zip(clock, FORCE, MOTION, strict=True)]
    (tmp_path / "run.csv").write_text("Timestamp;force;acc\n" + "\n".join(rows) + "\n")
    recording = problem(tmp_path, RUN).recordings[0]
    assert recording.sample_rate_hz == pytest.approx(FS, rel=1e-6)
    assert recording.samples[:, 1] == pytest.approx(MOTION, abs=1e-6)


def test_a_rate_of_the_head_that_the_time_column_contradicts(tmp_path):
    table(tmp_path / "run.csv", T, FORCE, MOTION, head="Sample rate,512\nt,force,acc")
    assert "the file says 512 samples a second, its time column 500" in found(tmp_path, RUN, "MD603")


def universal(path, binary: int, sets: list[dict]) -> None:
    """Data sets 58 as pyuff writes them."""
    pyuff = pytest.importorskip("pyuff")
    file = pyuff.UFF(str(path))
    for each in sets:
        common = {
            "type": 58,
            "binary": binary,
            "id1": "id",
            "z_axis_axis_units_lab": "NONE",
            "abscissa_inc": 0,
            "load_case_id": 0,
        }
        axes = {"abscissa_spec_data_type": 18, "ordinate_spec_data_type": 12, "orddenom_spec_data_type": 13}
        labels = {"ordinate_axis_units_lab": "m/s^2", "orddenom_axis_units_lab": "N", "ref_node": 1, "ref_dir": 1}
        file.write_sets({**common, **axes, **labels, **each}, "add")


@pytest.mark.parametrize("binary", [0, 1])
@pytest.mark.parametrize("spacing", [0, 1])
def test_universal_functions(tmp_path, binary, spacing):
    hz = np.arange(1, 41) * 0.5
    H = np.exp(0.3j * hz) * (1 + hz)
    sets = [
        {"func_type": 4, "rsp_node": 2, "rsp_dir": sign, "x": hz, "data": sign * H, "abscissa_spacing": spacing}
        for sign in (1, -1)
    ]
    universal(tmp_path / "tap.unv", binary, [{**each, "abscissa_inc": 0.5, "abscissa_min": 0.5} for each in sets])
    contents = read_contents(str(tmp_path / "tap.unv"))
    assert [(f.output, f.input, f.kind, f.unit) for f in contents.functions] == [
        ("2TX", "1TX", "accelerance", "(m/s^2)/N"),
        ("2-TX", "1TX", "accelerance", "(m/s^2)/N"),
    ]
    assert contents.functions[0].frequency_hz == pytest.approx(hz, rel=1e-6)
    assert contents.functions[0].values == pytest.approx(H, rel=1e-6)
    test = "frf: [{file: tap.unv, inputs: {1: 1TX}, outputs: {2: 2TX}}]"
    frf = problem(tmp_path, test).frf[0]
    assert frf.H[:, 0, 0] == pytest.approx(H, rel=1e-6) and frf.outputs.tolist() == [1] and frf.inputs.tolist() == [0]


def test_universal_time_histories(tmp_path):
    sets = [
        {"func_type": 1, "rsp_node": node, "rsp_dir": 2, "x": T, "data": y, "abscissa_spacing": 1, "abscissa_inc": 1 / FS,
         "abscissa_min": 0.0, "abscissa_spec_data_type": 17, "ordinate_axis_units_lab": label, "ordinate_spec_data_type": kind}
        for node, y, label, kind in ((1, FORCE, "N", 13), (2, MOTION, "g", 12))
    ]  # fmt: skip
    universal(tmp_path / "run.uff", 1, sets)
    recording = problem(tmp_path, "recordings: [{file: run.uff, inputs: {1: 1TY}, outputs: {2: 2TY}}]").recordings[0]
    assert recording.samples == pytest.approx(np.column_stack([FORCE, 9.80665 * MOTION]), rel=1e-6)
    assert recording.sample_rate_hz == pytest.approx(FS, rel=1e-5)


def test_universal_files_as_instruments_write_them(tmp_path):
    """A line end between head and binary numbers, numbers that touch, a coordinate of -1 alone in its line, lines padded to 80."""
    hz = np.arange(1, 9) * 0.5
    H = -(1 + hz) - 1j * hz
    universal(tmp_path / "binary.unv", 1, [{"func_type": 4, "rsp_node": 2, "rsp_dir": 1, "x": hz, "data": H, "abscissa_spacing": 1,
                                           "abscissa_inc": 0.5, "abscissa_min": 0.5}])  # fmt: skip
    raw = (tmp_path / "binary.unv").read_bytes()
    numbers = np.column_stack([H.real, H.imag]).astype("<f8").tobytes()
    assert numbers in raw
    (tmp_path / "stray.unv").write_bytes(raw.replace(numbers, b"\n" + numbers))
    assert read_contents(str(tmp_path / "stray.unv")).functions[0].values == pytest.approx(H)
    head = raw[: raw.index(numbers)].decode().splitlines()
    touching = "".join(f"{part:13.5e}" for value in H for part in (value.real, value.imag))
    head[1] = f"{'    58':<80}"
    head[8] = "         5" + head[8][10:]
    points = ["    -1", "    15", "         1         0         0         0  1.0", "    -1", "  0.0", "    -1"]
    text = "\n".join([*points, *head, *(touching[i : i + 78] for i in range(0, len(touching), 78)), "    -1", ""])
    (tmp_path / "text.unv").write_text(text)
    assert read_contents(str(tmp_path / "text.unv")).functions[0].values == pytest.approx(H, rel=1e-5)


# --- units ---


@pytest.mark.parametrize(
    ("text", "quantity", "factor"),
    [
        ("g", "acceleration", 9.80665), ("mm/s²", "acceleration", 1e-3), ("m/s**2", "acceleration", 1),
        ("[m/s^2]", "acceleration", 1), ("in/sec2", "acceleration", 0.0254), ("lbf", "force", 4.4482216152605),
        ("kN", "force", 1e3), ("mm/s", "velocity", 1e-3), ("µm", "displacement", 1e-6), ("N m", "moment", 1),
        ("mV", "voltage", 1e-3), ("deg", "rotation", np.pi / 180),
    ],
)  # fmt: skip
def test_units(text, quantity, factor):
    """Factors by their definitions (CGPM 1901; international yard and pound, 1959)."""
    assert unit(text).quantity == quantity and unit(text).factor == pytest.approx(factor, rel=1e-12)


def test_no_units():
    assert unit("EU") is None and unit("") is None and ratio("g") is None and ratio("furlong/N") is None
    assert [u.quantity for u in ratio("(1/N)*(m/s²)")] == ["acceleration", "force"]


def test_file_and_deck_must_agree(tmp_path):
    table(tmp_path / "run.csv", T, FORCE, MOTION, head="t,force (N),acc (g)")
    test = "recordings: [{file: run.csv, inputs: {1: force}, outputs: {2: {channel: acc, unit: m/s2}}}]"
    assert found(tmp_path, test, "MD610") == "the deck states that channel 'acc' is in m/s2; its file states g"
    test = "recordings: [{file: run.csv, inputs: {1: {channel: force, quantity: moment}}, outputs: {2: acc}}]"
    assert "its unit, N, is one of force" in found(tmp_path, test, "MD610")


def test_sensitivity(tmp_path):
    """100 mV/g: 0.1 V is 1 g."""
    table(tmp_path / "run.csv", T, FORCE, 0.1 * MOTION, head="t,force (N),acc (V)")
    test = "recordings: [{file: run.csv, inputs: {1: force}, outputs: {2: {channel: acc, sensitivity: 100 mV/g}}}]"
    assert problem(tmp_path, test).recordings[0].samples[:, 1] == pytest.approx(9.80665 * MOTION, abs=1e-6)
    assert "does not determine what it measures" in found(tmp_path, RUN, "MD611")


def test_units_of_the_deck(tmp_path):
    """In mm, t and N an acceleration of 1 g is 9806.65 mm/s2, and an accelerance of 1 g/N as many mm/s2/N."""
    table(tmp_path / "run.csv", T, FORCE, MOTION, head="t,force (kN),acc (g)")
    recording = problem(tmp_path, RUN, "units: mm-t-N\n").recordings[0]
    assert recording.samples == pytest.approx(np.column_stack([1000 * FORCE, 9806.65 * MOTION]), abs=1e-3)
    assert recording.channels[1].unit == "mm/s2"
    test = "frf: [{unit: g/N, input: 1, frequency: [1, 2], outputs: {1: {real: [1, 0], imag: [0, 2]}}}]"
    assert problem(tmp_path, test, "units: mm-t-N\n").frf[0].H[:, 0, 0] == pytest.approx([9806.65, 19613.3j])


def test_unit_taken_for_granted_is_told(tmp_path):
    table(tmp_path / "run.csv", T, FORCE, MOTION)
    warned = [d for d in problem(tmp_path, RUN).warnings if d.code == "MD612"]
    assert len(warned) == 1 and "force, acc" in warned[0].message


# --- faults, with channel and sample ---


def spoilt(tmp_path, column, at, value, code, test=RUN):
    columns = {"t": T.copy(), "force": FORCE.copy(), "acc": MOTION.copy()}
    columns[column][at] = value
    table(tmp_path / "run.csv", *columns.values())
    return found(tmp_path, test, code)


def test_gaps(tmp_path):
    message = spoilt(tmp_path, "acc", slice(321, 330), np.nan, "MD605")
    assert message == "9 samples of channel 'acc' are no numbers, the first is sample 321"
    problem(tmp_path, RUN.replace("inputs", "segment: [330, 1000], inputs"))  # as the message advises
    text = (tmp_path / "run.csv").read_text().replace("nan", "")
    (tmp_path / "run.csv").write_text(text)
    assert found(tmp_path, RUN, "MD605") == message


def test_dead_and_constant(tmp_path):
    assert "'acc' is dead: all 1000 samples from 0 on" in spoilt(tmp_path, "acc", slice(None), 0, "MD607")
    assert "'force' is constant" in spoilt(tmp_path, "force", slice(None), 2.5, "MD607")


def test_dropped_samples(tmp_path):
    keep = np.delete(np.arange(len(T)), [400, 401, 402])
    table(tmp_path / "run.csv", T[keep], FORCE[keep], MOTION[keep])
    assert found(tmp_path, RUN, "MD604").startswith("3 samples are missing before sample 400 by the time column 't'")
    assert "runs backwards in column 't' at sample 600" in spoilt(tmp_path, "t", slice(600, None), T[:400], "MD604")


def test_sample_rate(tmp_path):
    table(tmp_path / "run.csv", T, FORCE, MOTION)
    message = found(tmp_path, RUN.replace("inputs", "sample_rate: 512, inputs"), "MD603")
    assert message == "the deck says 512 samples a second, its time column 500"
    table(tmp_path / "run.csv", FORCE, MOTION, head="force,acc")
    assert "neither deck nor file" in found(tmp_path, RUN, "MD602")


def test_lengths_segments_and_names(tmp_path):
    np.savez(tmp_path / "run.npz", force=FORCE, acc=MOTION[:-1], fs=FS)
    test = "recordings: [{file: run.npz, inputs: {1: force}, outputs: {2: acc}}]"
    assert "'force' has 1000 samples, channel 'acc' 999" in found(tmp_path, test, "MD608")
    table(tmp_path / "run.csv", T, FORCE, MOTION)
    assert "from 0 to 1000" in found(tmp_path, RUN.replace("inputs", "segment: [900, 1001], inputs"), "MD609")
    assert "no channel 'aac'" in found(tmp_path, RUN.replace("2: acc", "2: aac"), "MD600")
    assert "degree of freedom 3 is outside 1 to 2" in found(tmp_path, RUN.replace("2: acc", "3: acc"), "MD323")


def test_clipped_channel(tmp_path):
    table(tmp_path / "run.csv", T, FORCE, np.clip(MOTION, -0.8, 2))
    first = int(np.argmax(MOTION < -0.8))
    message = next(d.message for d in problem(tmp_path, RUN).warnings if d.code == "MD606")
    assert message.startswith("channel 'acc' is clipped at -0.8") and message.endswith(f"first is sample {first}")


def test_what_is_no_fault():
    """Rounded peaks, a binary excitation, rest between strokes of a hammer."""
    assert not faults(np.round(20 * np.sin(2 * np.pi * 0.002 * np.arange(5000))) / 20)
    assert not faults(np.where(np.sin(np.arange(2000) ** 1.3) > 0, 1.0, -1.0))
    stroke = np.zeros(4000)
    stroke[100:110] = stroke[2100:2110] = np.hanning(10)
    assert not faults(stroke)


def test_zeros_in_the_midst_of_a_motion_are_a_loose_cable():
    """60 of 6000 samples passed for noise, hum or drift."""
    x = np.random.default_rng(3).standard_normal(6000)
    x[2000:2060] = 0.0
    (found,) = faults(x)
    assert (found.kind, found.sample, found.count, found.value) == ("stuck", 2000, 60, 0.0)
    x[:4000] = 0.0  # before anything moves
    assert not faults(x)


def test_clock_of_rounded_times():
    """Times of 5 kHz printed to 1 ms: steps are 0 or 1 ms, and 5 kHz all the same."""
    ticks = clock(np.round(np.arange(20000) / 5000, 3))
    assert not ticks.breaks and 1 / ticks.step_s == pytest.approx(5000, rel=1e-3)


# --- frequency response functions ---


def test_forms_of_functions(tmp_path):
    """One function as complex text, in two parts, in dB and degrees, and given in the deck."""
    hz = np.array([1.0, 2.0, 4.0])
    H = np.array([1 + 2j, -3 + 0.5j, 0.25j])
    lines = [f"{f:g};{h.real:g}{h.imag:+g}j" for f, h in zip(hz, H, strict=True)]
    (tmp_path / "text.csv").write_text("\n".join(lines))
    db, deg = 20 * np.log10(np.abs(H)), np.degrees(np.angle(H))
    np.savez(tmp_path / "parts.npz", f=hz, re=H.real, im=H.imag, db=db, deg=deg, coh=[0.9, 0.8, 1.0])
    test = """
frf:
  - {file: text.csv, title: a, kind: mobility, input: 1, outputs: {1: 2}}
  - {file: parts.npz, title: b, kind: mobility, input: 1, outputs: {1: {real: re, imag: im, coherence: coh}}, averages: 10}
  - {file: parts.npz, title: c, kind: mobility, input: 1, outputs: {1: {magnitude_db: db, phase: deg}}, sd: 3 %}
  - {title: d, kind: mobility, input: 1, frequency: [1, 2, 4], outputs: {1: {value: [1+2j, -3+0.5j, 0.25j]}}, band: [1.5, 9]}
"""
    frf = {each.title: each for each in problem(tmp_path, test).frf}
    assert all(frf[t].H[:, 0, 0] == pytest.approx(H) for t in "abc") and frf["d"].H[:, 0, 0] == pytest.approx(H[1:])
    g2 = np.array([0.9, 0.8, 1.0])
    assert frf["b"].variance[:, 0, 0] == pytest.approx(np.abs(H) ** 2 * (1 - g2) / (10 * g2))  # Bendat & Piersol, ch. 9
    assert frf["c"].variance[:, 0, 0] == pytest.approx(2 * (0.03 * np.abs(H)) ** 2)
    assert np.isnan(frf["a"].variance).all()


def test_functions_of_one_title_are_one_measurement(tmp_path):
    test = """
frf:
  - {title: m, kind: receptance, input: 1, frequency: [1, 2], outputs: {1: {value: [1j, 2]}, 2: {value: [3, 4]}}}
  - {title: m, kind: receptance, input: 2, frequency: [1, 2], outputs: {2: {value: [5, 6]}}}
"""
    frf = problem(tmp_path, test).frf[0]
    assert frf.H.shape == (2, 2, 2) and frf.output_names == ("1", "2")
    assert (
        frf.H[:, :, 0].tolist() == [[1j, 3], [2, 4]]
        and frf.H[:, 1, 1].tolist() == [5, 6]
        and np.isnan(frf.H[:, 0, 1]).all()
    )
    assert "line 2" in found(tmp_path, test.replace("[1, 2], outputs: {2", "[1, 3], outputs: {2"), "MD614")
    assert "receptance and of mobility" in found(
        tmp_path, test.replace("receptance, input: 2", "mobility, input: 2"), "MD614"
    )


def test_arrays_of_functions_and_repeats(tmp_path):
    """A matrix of functions (f, o, i) as others save it: `H[2,1]` is response 2 by force 1."""
    hz, H = np.arange(1.0, 30), np.random.default_rng(2).standard_normal((29, 2, 3)) + 1j
    np.savez(tmp_path / "frf.npz", freq=hz, H=H)
    entry = "{title: m, file: frf.npz, kind: mobility, input: 1, outputs: {1: 'H[1,3]', 2: 'H[2,3]'}}"
    given = problem(tmp_path, f"frf: [{entry}]")
    assert (given.frf[0].H[:, :, 0] == H[:, :, 2]).all() and not given.warnings
    assert [d.code for d in problem(tmp_path, f"frf: [{entry}, {entry}]").warnings] == ["MD623"]


def test_backward_and_named_sensors(tmp_path):
    deck = """\
mouse: 1
model:
  structure:
    nodes: {1: [0, 0, 0], 2: [1, 0, 0]}
    elements: [{id: 1, type: spring, nodes: [1, 2], stiffness: {TX: 1e4, TY: 1e4}}, {id: 2, type: mass, nodes: [2], mass: 1}]
    supports: {1: all}
    plane: XY
parameters: [{name: k, elements: 1, property: stiffness TX, sd: 1 %}]
test:
  sensors: [{name: skew, node: 2, direction: [1, 1, 0]}]
  frf: [{kind: mobility, input: 2TX, frequency: [1, 2], outputs: {2-TY: {value: [1, 2]}, skew: {value: [1, 2]}}}]
"""
    (tmp_path / "deck.yaml").write_text(deck.replace("property: stiffness TX", "property: TX"))
    try:
        frf = read_deck(tmp_path / "deck.yaml").frf[0]
    except DeckError as error:
        pytest.fail(str(error))
    labels = read_deck(tmp_path / "deck.yaml").structure.labels
    weights = frf.outputs.toarray()
    x, y = labels.index("2TX"), labels.index("2TY")
    assert weights[0, y] == -1 and weights[0, x] == 0
    assert weights[1, [x, y]] == pytest.approx([0.5**0.5] * 2)
    written = write_deck(read_deck(tmp_path / "deck.yaml"), tmp_path / "again.yaml")
    again = read_deck(written[-1]).frf[0]
    assert (again.outputs.toarray() == weights).all() and again.output_names == frf.output_names


def test_held_out_records(tmp_path):
    table(tmp_path / "run.csv", T, FORCE, MOTION, head="t,force (N),acc (g)")
    test = """
recordings:
  - {file: run.csv, title: a, inputs: {1: force}, outputs: {2: acc}, segment: [0, 600]}
  - {file: run.csv, title: b, inputs: {1: force}, outputs: {2: acc}, segment: [600, 1000]}
frf: [{title: m, kind: mobility, input: 1, frequency: [1, 2, 3], outputs: {1: {value: [1, 2, 3]}}}]
hold_out: {recordings: [b], segments: [{recording: a, segment: [100, 200]}], lines: [[1.5, 2.5]]}
"""
    given = problem(tmp_path, test)
    assert [(r.start, len(r.samples)) for r in given.recordings] == [(0, 100), (200, 400)]
    assert [(r.title, r.start, len(r.samples)) for r in given.held_records.recordings] == [
        ("b", 600, 400),
        ("a", 100, 100),
    ]
    assert given.frf[0].frequency_hz.tolist() == [1, 3] and given.held_records.frf[0].frequency_hz.tolist() == [2]
    again = read_deck(write_deck(given, tmp_path / "again.yaml")[-1])
    assert [(r.start, len(r.samples)) for r in again.recordings] == [(0, 100), (200, 400)]
    assert again.held_records.frf[0].H.tolist() == given.held_records.frf[0].H.tolist()
    assert "has no test.modes" in found(tmp_path, test.replace("recordings: [b]", "modes: [1]"), "MD430")
    assert "'c', which is no title" in found(tmp_path, test.replace("[b]", "[c]"), "MD433")


def test_a_deck_stays_with_its_recordings(tmp_path):
    table(tmp_path / "run.csv", T, FORCE, MOTION)
    given = problem(tmp_path, RUN)
    (tmp_path / "below").mkdir()
    with pytest.raises(Exception, match="MD617"):
        write_deck(given, tmp_path / "below" / "deck.yaml")
    assert "file: run.csv" in Path(write_deck(given, tmp_path / "again.yaml")[-1]).read_text()


def test_a_diagnosis_whose_deck_could_not_be_written_is_not_begun(tmp_path, monkeypatch, capsys):
    """It ran for 213 s first."""
    monkeypatch.setattr("mouse_cli.cli.commands.diagnose._Asked.of", None)  # what comes next
    table(tmp_path / "run.csv", T, FORCE, MOTION)
    problem(tmp_path, RUN)
    (tmp_path / "below").mkdir()
    assert _run(["diagnose", str(tmp_path / "deck.yaml"), "-o", str(tmp_path / "below" / "deck.yaml"), "-q"]) == 5
    assert "MD617" in capsys.readouterr().err and not list((tmp_path / "below").iterdir())


def test_file_without_data(tmp_path):
    (tmp_path / "run.csv").write_text("nothing but words\nand more\n")
    with pytest.raises(RecordError) as caught:
        read_contents(str(tmp_path / "run.csv"))
    assert caught.value.diagnostics[0].code == "MD601" and caught.value.exit_code == 4


@pytest.mark.parametrize(("name", "package"), [("run.h5", "h5py"), ("run.tdms", "nptdms")])
def test_packages_that_are_not_installed(tmp_path, monkeypatch, name, package):
    monkeypatch.setitem(sys.modules, package, None)
    (tmp_path / name).write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(600))
    with pytest.raises(RecordError) as caught:
        read_contents(str(tmp_path / name))
    told = caught.value.diagnostics[0]
    assert told.code == "MD261" and package in told.message and told.help.startswith("pip install 'mouse-cli[")


def test_a_deck_above_its_recordings(tmp_path):
    """Written to the folder above, it names them through their own."""
    (tmp_path / "runs").mkdir()
    table(tmp_path / "runs" / "run.csv", T, FORCE, MOTION)
    written = write_deck(problem(tmp_path / "runs", RUN), tmp_path / "deck.yaml")[-1]
    assert "file: runs/run.csv" in Path(written).read_text()
    assert read_deck(written).recordings[0].samples[:, 1] == pytest.approx(MOTION, abs=1e-6)


# --- real recordings, decks of a few lines ---

shared = pytest.mark.skipif(not SHARED.is_dir(), reason="the measured data are not beside the project")


@shared
def test_three_storeys(tmp_path):
    """Three files, each of one force, are a 3 x 3 matrix that is reciprocal within 5 per cent at its peaks, as its makers say."""
    for file in (SHARED / "three_storey_uk").glob("*.csv"):
        shutil.copy(file, tmp_path)
    entry = (
        "  - {{file: {}, title: building, kind: accelerance, input: {}, outputs: {{1: 2, 2: 3, 3: 4}}, band: [2, 40]}}"
    )
    files = ("frf_Experimental.csv", "frf_test_2.csv", "frf_test_3.csv")
    test = "frf:\n" + "\n".join(entry.format(file, i) for i, file in enumerate(files, 1))
    path = tmp_path / "deck.yaml"
    path.write_text(
        "mouse: 1\nmodel: {stiffness: {order: 3, entries: [[1,1,104920],[1,2,-52460],[2,2,104920],[2,3,-52460],[3,3,52460]]}, "
        "mass: {diagonal: [5.2, 5.2, 5.2]}}\nparameters: []\ntest:\n"
        + "\n".join("  " + line for line in test.splitlines())
    )
    H = read_deck(path).frf[0]
    assert H.H.shape == (1217, 3, 3) and np.isfinite(H.H).all()
    peak = np.argmax(np.abs(H.H[:, 0, 0]))
    assert H.frequency_hz[peak] == pytest.approx(17.47, abs=0.05)
    assert abs(H.H[peak, 0, 2] / H.H[peak, 2, 0]) == pytest.approx(1, abs=0.05)


@shared
def test_silverbox(tmp_path):
    shutil.copy(SHARED / "silverbox" / "SNLS80mV.mat", tmp_path)
    channels = "inputs: {1: {channel: V1, quantity: force, unit: V}}, outputs: {1: {channel: V2, quantity: displacement, unit: V}}"
    given = problem(
        tmp_path, f"recordings: [{{file: SNLS80mV.mat, sample_rate: 610.35, {channels}, segment: [41000, 71000]}}]"
    )
    assert given.recordings[0].samples.shape == (30000, 2)
    assert given.recordings[0].samples[:, 1].std() == pytest.approx(0.054, abs=0.001)  # the makers: 54 mV rms


@shared
def test_beam_with_masses(tmp_path):
    shutil.copy(SHARED / "beam_masses" / "beam_masses_frf.npz", tmp_path)
    values = '{magnitude_db: "healthy_mag_dB[1]", phase: "healthy_phase_deg[1]"}'
    given = problem(
        tmp_path,
        f"frf: [{{file: beam_masses_frf.npz, kind: accelerance, input: 1, outputs: {{2: {values}}}, band: [15, 30]}}]",
    )
    frf = given.frf[0]
    assert frf.frequency_hz[np.argmax(np.abs(frf.H[:, 0, 0]))] == pytest.approx(21.87, abs=0.4)  # the makers: 21.87 Hz
