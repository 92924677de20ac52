"""Answers and decks as frames of pandas, which is optional."""

from typing import Any

from mouse_cli._errors import MouseError
from mouse_cli.model.problem import Problem
from mouse_cli.report import problem_document
from mouse_cli.report.answers import document
from mouse_cli.report.tables import tables


def frames(answer: Any) -> dict[str, Any]:
    """Frames of pandas by name: of what `run` or `diagnose` found, of a deck, of a document or of the name of its file.

    `summary` has one row of all that is single, such as `status` and `residual.p`. Each list of a document is a frame called as
    there: `parameters`, `modes`, `shapes`, `cycles`, `covariance`, `candidates`, `location.places`, `extended.parameters`, ... The
    numbers are those of the document, None as NaN. Of a deck there are `parameters`, `prior_covariance`, and of its test `modes`
    and `shapes`. Raises MouseError (MD960) where pandas is not installed, else as `document`.

    >>> import mouse_cli
    >>> found = mouse_cli.frames(mouse_cli.run(mouse_cli.read_deck("decks/sound_chain.yaml")))
    >>> found["parameters"].set_index("name").posterior.round(1).to_dict()
    {'k1': 1105.4, 'k2': 951.1, 'k3': 1055.1, 'k4': 899.9}
    """
    pandas = required("pandas", "frames")
    values = plain_document(answer)
    return {
        name: pandas.DataFrame(table.columns, index=table.index if table.index is None else pandas.Index(table.index))
        for name, table in tables(values).items()
    }


def plain_document(answer: Any) -> dict[str, Any]:
    """The document of an answer, or what a deck says."""
    return problem_document.document(answer) if isinstance(answer, Problem) else document(answer)


def required(package: str, what: str) -> Any:
    """The package. Raises MouseError (MD960) where it is not installed."""
    from importlib import import_module

    try:
        return import_module(package)
    except ImportError:
        message = f"{what} need the package {package}, which is not installed"
        raise MouseError.of("MD960", message, help="install it: pip install 'mouse-cli[frames]'") from None
