"""Figures of an answer: one module = one kind of answer, found by `registry`; matplotlib is optional."""

import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from mouse_cli import _registry
from mouse_cli._errors import ERROR, Diagnostic, MouseError, WrittenError
from mouse_cli.model.diagnosis import Diagnosis

_INSTALL = "install it: pip install 'mouse-cli[plot]'"
WIDTH, HEIGHT, DPI = 6.3, 3.4, 200  # of one figure in inches, as wide as the text of a printed page
STYLE = {
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "0.9",
    "axes.axisbelow": True,
    "legend.frameon": False,
    "legend.fontsize": 8,
    "savefig.facecolor": "white",
}
_FILES = (".pdf", ".png", ".svg")
BEFORE, AFTER = "0.55", "#0b5394"  # the model as it is, and extended; apart in grey print too


@dataclass(frozen=True)
class Plot:
    """A figure. draw(subject, axes) draws it into matplotlib axes and returns whether there was anything to draw.

    subjects: of what it can be drawn.
    """

    key: str
    order: int
    title: str
    draw: Callable[[Any, Any], bool]
    subjects: tuple[type, ...] = (Diagnosis,)


def registry() -> dict[str, Plot]:
    """All figures by key."""
    return _registry.discover(__name__, "PLOT")


def labelled(axes: Any, x: str, y: str | None = None, columns: int = 0) -> bool:
    """Name the axes, with a legend of so many columns above them, 0: none. True: there was something to draw."""
    axes.set_xlabel(x)
    if y is not None:
        axes.set_ylabel(y)
    if columns:
        axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns, borderaxespad=0.1)
    return True


def require(path: str = "") -> None:
    """Raise MouseError (MD530) where matplotlib is not installed, and WrittenError (MD531) where it cannot write such a file."""
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        problem = Diagnostic(
            "MD530", ERROR, "figures need the package matplotlib, which is not installed", help=_INSTALL
        )
        raise MouseError(problem) from None
    kind = _kind(path)
    if kind and kind not in _FILES:
        message = f"cannot write figures to {path}: '{kind}' is no kind of figure"
        raise WrittenError.of("MD531", message, help=f"name a folder, or a file that ends in {', '.join(_FILES)}")


def draw(found: Any, path: str, only: tuple[str, ...] = ()) -> list[str]:
    """Write every figure that has something to show; returns the names of the files, none where there is nothing to draw.

    only: keys of the figures that are wanted; empty for all. A path that ends in .pdf has one page a figure, another file suffix
    all figures below each other; else it is a folder, made where there is none, of PNG files. Raises WrittenError (MD531).
    """
    require(path)
    import matplotlib

    kind = _kind(path)
    with matplotlib.rc_context(STYLE):
        drawn = _figures(found, only)
        if not drawn:
            return []
        try:
            if kind == ".pdf":
                return _pages(drawn, path)
            return _sheet(found, [plot for plot, _ in drawn], path) if kind else _folder(drawn, path)
        except OSError as error:
            message = f"cannot write figures to {path}: {error.strerror or error}"
            raise WrittenError.of("MD531", message, help="name a folder or .pdf, .png") from error


def _kind(path: str) -> str:
    """Suffix of a file of figures; empty for a folder."""
    return "" if os.path.isdir(path) else os.path.splitext(path)[1].lower()


def figures_of(kind: type) -> dict[str, Plot]:
    """Figures that can be drawn of such an answer, by key, in their order."""
    plots = sorted(registry().values(), key=lambda plot: plot.order)
    return {plot.key: plot for plot in plots if issubclass(kind, plot.subjects)}


def _figures(found: Any, only: tuple[str, ...]) -> list[tuple[Plot, Any]]:
    """Each figure that has something to show, drawn."""
    from matplotlib.figure import Figure

    drawn = []
    for plot in figures_of(type(found)).values():
        if only and plot.key not in only:
            continue
        figure = Figure(figsize=(WIDTH, HEIGHT), layout="constrained")
        axes = figure.add_subplot()
        if plot.draw(found, axes):
            _titled(axes, plot)
            drawn.append((plot, figure))
    return drawn


def _titled(axes: Any, plot: Plot) -> None:
    """The title, from the left edge of the figure on, above what names of bars take."""
    axes.set_title(plot.title, loc="left", pad=22 if axes.get_legend() else 6)


def _pages(drawn: list[tuple[Plot, Any]], path: str) -> list[str]:
    from matplotlib.backends.backend_pdf import PdfPages

    with PdfPages(path) as pages:
        for _, figure in drawn:
            pages.savefig(figure)
    return [path]


def _folder(drawn: list[tuple[Plot, Any]], path: str) -> list[str]:
    os.makedirs(path, exist_ok=True)
    written = []
    for plot, figure in drawn:
        written.append(os.path.join(path, f"{plot.key}.png"))
        figure.savefig(written[-1], dpi=DPI)
    return written


def _sheet(found: Any, plots: list[Plot], path: str) -> list[str]:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDTH, HEIGHT * max(len(plots), 1)), layout="constrained")
    for i, plot in enumerate(plots, 1):
        axes = figure.add_subplot(len(plots), 1, i)
        plot.draw(found, axes)
        _titled(axes, plot)
    figure.savefig(path, dpi=DPI)
    return [path]
