"""The notebook: its cells run in order and print what it shows."""

import ast
import contextlib
import io
import json
from base64 import b64encode

import pytest
from pages import DOCS

NOTEBOOK = DOCS / "notebook.ipynb"


def ran(source: str, names: dict[str, object]) -> tuple[str, object]:
    """What a cell prints, and the value of its last line where that is an expression."""
    tree, last = ast.parse(source), None
    if isinstance(tree.body[-1], ast.Expr) and not source.splitlines()[-1].lstrip().startswith("print("):
        last = ast.Expression(tree.body.pop().value)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, NOTEBOOK.name, "exec"), names)
        value = eval(compile(last, NOTEBOOK.name, "eval"), names) if last else None
    return printed.getvalue(), value


def image(figure) -> str:
    """A figure as a notebook holds it, without the date and the versions that made it."""
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=80, metadata={"Software": None})
    return b64encode(stream.getvalue()).decode() + "\n"


def outputs(printed: str, value: object, count: int) -> list[dict]:
    """The outputs of a cell as a notebook holds them."""
    found: list[dict] = []
    if printed:
        found.append({"name": "stdout", "output_type": "stream", "text": printed.splitlines(keepends=True)})
    if value is not None:
        data = {"image/png": image(value), "text/plain": ["<Figure>"]}
        found.append({"data": data, "execution_count": count, "metadata": {}, "output_type": "execute_result"})
    return found


def test_notebook_runs_as_written(monkeypatch, request):
    for package in ("pandas", "xarray", "matplotlib"):
        pytest.importorskip(package, reason="the extras `frames` and `plot` are not installed")
    monkeypatch.chdir(DOCS)
    monkeypatch.setenv("MPLBACKEND", "agg")
    notebook = json.loads(NOTEBOOK.read_text("utf-8"))
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    names: dict[str, object] = {"__name__": "__main__"}
    for count, cell in enumerate(cells, 1):
        printed, value = ran("".join(cell["source"]), names)
        if request.config.getoption("--update-golden"):
            cell |= {"execution_count": count, "outputs": outputs(printed, value, count)}
            continue
        assert cell["execution_count"] == count
        assert "".join(line for each in cell["outputs"] for line in each.get("text", [])) == printed
        assert ("image/png" in str(cell["outputs"])) == (value is not None)
    if request.config.getoption("--update-golden"):
        NOTEBOOK.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", "utf-8")
    drawn = [bar.get_height() for bars in names["axes"].containers for bar in bars]
    assert drawn == [*names["held"].baseline, *names["held"].revised]
    assert "accept the model with the spring\n" in printed
