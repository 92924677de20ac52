"""Which quick tests go through which function, and how long they take: what a fault in it is shown to first."""

import json
import os
import sys
import time
from pathlib import Path

import pytest

FOLDERS = ("tests/reference", "tests/property", "tests/differential")  # of tests of numbers


class Watched:
    """Plugin of pytest: functions of the package that each test calls, by file and qualified name."""

    def __init__(self, package: Path):
        self.package, self.found, self.broken = f"{package}{os.sep}", {}, set()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item):
        """One test, its fixtures included."""
        called: set[object] = set()

        def profile(frame: object, event: str, argument: object) -> None:
            if event == "call":
                called.add(frame.f_code)

        start = time.process_time()
        sys.setprofile(profile)
        try:
            return (yield)
        finally:
            sys.setprofile(None)
            names = {
                f"{code.co_filename.removeprefix(self.package)}:{plain(code.co_qualname)}"
                for code in called
                if code.co_filename.startswith(self.package)
            }
            self.found[item.nodeid] = (time.process_time() - start, sorted(names))

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """A test that fails without a fault says nothing of one."""
        if report.failed or report.skipped:
            self.broken.add(report.nodeid)


def plain(name: str) -> str:
    """A qualified name without what is local: what is defined in a function is the function's."""
    return name.replace("<locals>.", "").split(".<")[0]


def read(root: Path, kept: Path) -> dict[str, list[str]]:
    """Tests of each function, the quickest first; kept in a file, as the run takes a minute."""
    if not kept.exists():
        if (pid := os.fork()) == 0:
            os.chdir(root)
            watched = Watched(root / "mouse_cli")
            asked = ["-q", "-m", "quick", "-p", "no:cacheprovider", "-p", "no:randomly", *FOLDERS]
            pytest.main(asked, plugins=[watched])
            rows = {name: row for name, row in watched.found.items() if name not in watched.broken}
            kept.write_text(json.dumps(rows))
            os._exit(0)
        os.waitpid(pid, 0)
    rows = json.loads(kept.read_text())
    found: dict[str, list[tuple[float, str]]] = {}
    for test, (seconds, names) in rows.items():
        for name in names:
            found.setdefault(name, []).append((seconds, test))
    return {name: [test for _, test in sorted(tests)] for name, tests in found.items()}
