"""Options of the test run."""

import os
import signal
from pathlib import Path

import once
import pytest
from hypothesis import HealthCheck, settings
from proofs import LONG
from quick import QUICK

# processes share the cores, and small matrices gain nothing by threads
for _threads in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ.setdefault(_threads, "1")

settings.register_profile(
    "mouse", deadline=None, suppress_health_check=[HealthCheck.too_slow]
)  # no test fails for load
settings.load_profile("mouse")

_TESTS = Path(__file__).parent
_QUICK = {name.partition("::")[0] for names in QUICK.values() for name in names}


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--update-golden", action="store_true", help="write the golden files anew, then read the diff")


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """With `-m quick` alone, files without a quick test are not even read."""
    if config.option.markexpr != "quick" or not collection_path.is_file():
        return None
    return not (collection_path.is_relative_to(_TESTS) and str(collection_path.relative_to(_TESTS)) in _QUICK) or None


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the quick tests, and the long ones."""
    chosen = {name for names in QUICK.values() for name in names}
    for item in items:
        path = item.path.relative_to(_TESTS).as_posix() if item.path.is_relative_to(_TESTS) else ""
        if path in chosen or f"{path}::{item.name.partition('[')[0]}" in chosen:
            item.add_marker(pytest.mark.quick)
        if not {item.name, item.name.partition("[")[0]}.isdisjoint(LONG.get(path, ())):
            item.add_marker(pytest.mark.proof)


@pytest.fixture(scope="session", autouse=True)
def one_folder(tmp_path_factory: pytest.TempPathFactory):
    """A folder of all processes of this run, for what one of them makes for all; see `once`."""
    if "PYTEST_XDIST_WORKER" in os.environ and os.name == "posix":
        once.folder = tmp_path_factory.getbasetemp().parent


@pytest.fixture
def no_hang():
    """A minute for a test that takes seconds: not a matter of speed, but of an end."""
    if not hasattr(signal, "SIGALRM"):
        yield
        return
    before = signal.signal(signal.SIGALRM, lambda *_: pytest.fail("no answer within a minute"))
    signal.alarm(60)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)
