"""Reading in a process of its own: what it gives, and what becomes of a crash, a refusal and a file that is not there."""

import ctypes
import multiprocessing
import operator
import os
import signal

import numpy as np
import pytest

from mouse_cli._errors import DeckError
from mouse_cli.formats import isolated
from mouse_cli.formats.data_files import check_memory
from mouse_cli.formats.recording_files import read_contents


def test_a_crash_is_an_error_and_the_next_file_is_read():
    for _ in range(2):
        with pytest.raises(ValueError, match=r"crashed the library that reads it \(SIGSEGV\)"):
            isolated.call(ctypes.string_at, 0)
        assert isolated.call(operator.add, 1, 2) == 3


def test_a_process_that_the_system_killed_had_too_little_memory():
    with pytest.raises(MemoryError):
        isolated.call(signal.raise_signal, signal.SIGKILL)


def test_errors_arrive_as_they_were():
    with pytest.raises(FileNotFoundError):
        isolated.call(os.stat, "nowhere")
    with pytest.raises(DeckError) as found:
        isolated.call(check_memory, "k.h5", 2**60)
    assert [each.code for each in found.value.diagnostics] == ["MD258"]


def test_what_a_library_prints_is_no_answer(capfd):
    assert isolated.call(os.write, 1, b"HDF5-DIAG") == 9
    assert capfd.readouterr() == ("", "")


def test_one_process_serves_many_and_a_fork_has_its_own():
    first = isolated.call(os.getpid)
    assert isolated.call(os.getpid) == first != os.getpid()
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert first not in pool.map(_pid, range(2))
    assert isolated.call(os.getpid) == first


def test_names_of_files_are_those_of_the_folder_of_now(tmp_path, monkeypatch):
    h5py = pytest.importorskip("h5py")
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        with h5py.File(tmp_path / name / "run.h5", "w") as file:
            file["force"] = np.full(3, ord(name))
    for name in ("a", "b"):
        monkeypatch.chdir(tmp_path / name)
        assert read_contents("run.h5").columns[0].values[0] == ord(name)


def _pid(_):
    return isolated.call(os.getpid)
