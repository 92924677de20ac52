"""What a card deck cannot hold of a Problem: errors where the problem would change, else warnings."""

from dataclasses import dataclass, field
from math import inf

import numpy as np

from mouse_cli._errors import ERROR, WARNING, DeckError, Diagnostic
from mouse_cli.formats.cards import layout
from mouse_cli.model.modal_test import ModalTest
from mouse_cli.model.parameter import Parameter
from mouse_cli.model.problem import Problem, RunOptions
from mouse_cli.model.theory import Theory

MOST = 20  # of one kind are listed one by one
IN_YAML = "keep the deck in YAML"

# Run options that no card holds, with what every card deck stands for.
AS_IN_1972 = {
    "estimator": "bayes",
    "recursion": "replaced",
    "convergence": "ratio",
    "pairing": "number",
    "cycles": None,
    "extra_update": False,
    "step": "first-order",
    "limit_sd": None,
}


GIVES_WAY = ("MD141", "MD142", "MD143", "MD147", "MD148")  # what may be left out or rounded when losses are allowed


@dataclass
class Losses:
    """Errors and warnings about what cannot be punched."""

    lossy: bool = False
    errors: list[Diagnostic] = field(default_factory=list)
    warnings: list[Diagnostic] = field(default_factory=list)
    numbers: int = 0

    def error(self, code: str, message: str, help: str = IN_YAML) -> None:
        """A loss that would change the problem; with `lossy`, those in GIVES_WAY are warnings."""
        if self.lossy and code in GIVES_WAY:
            self.warn(code, message, "the cards hold it rounded" if code == "MD147" else "the cards leave it out")
        else:
            self.errors.append(Diagnostic(code, ERROR, message, help=help))

    def warn(self, code: str, message: str, help: str) -> None:
        """A loss that changes no answer, or that can be made good elsewhere."""
        self.warnings.append(Diagnostic(code, WARNING, message, help=help))

    def rounded(self, name: str, value: float, format: str, shown: str) -> None:
        """A value that its field cannot hold to the last digit."""
        self.numbers += 1
        if self.numbers <= MOST:
            message = f"{name} = {value!r} does not fit {format} exactly: {shown}"
            self.error("MD147", message, f"round the number to what fits, or {IN_YAML}")

    def refused(self, name: str, value: float, format: str, reason: str) -> None:
        """A value that its field cannot hold at all."""
        message = f"{name} = {value!r} cannot be punched in {format}: {reason}"
        self.errors.append(Diagnostic("MD147", ERROR, message, help=IN_YAML))

    def stop_if_any(self) -> None:
        """Raise DeckError with all errors and warnings so far."""
        if self.numbers > MOST:
            self.error("MD147", f"{self.numbers - MOST} more numbers do not fit their columns")
        if self.errors:
            raise DeckError([*self.errors, *self.warnings])


def losses(problem: Problem, lossy: bool = False) -> Losses:
    """Everything but the numbers, which are tried one by one as they are punched.

    Raises DeckError for a structure, of which cards hold nothing.
    """
    found = Losses(lossy)
    if problem.terms:
        message = "the model is made of elements of a structure; cards hold matrices and what moves them in proportion"
        found.error("MD152", message)
        found.stop_if_any()
    _heading(found, problem.title)
    _sizes(found, problem)
    for parameter in problem.parameters:
        _parameter(found, parameter)
    if problem.prior.cov.ndim == 2 and np.any(problem.prior.cov - np.diag(np.diag(problem.prior.cov))):
        found.error("MD144", "the prior of the properties is correlated; cards hold standard deviations only")
    if problem.test is None:
        found.error("MD140", "the deck has no modal test; five of the twelve groups of cards hold one")
    else:
        _test(found, problem.test)
    _besides(found, problem)
    _options(found, problem.run)
    _names(found, problem)
    return found


def _besides(found: Losses, problem: Problem) -> None:
    """What a diagnosis, or a run by other data, has besides."""
    beyond = {
        "frequency response functions and recordings are not on cards": problem.frf or problem.recordings,
        "what the deck holds out is not on cards, which fit the rest": problem.hold_out is not None,
        "the errors of theory that the deck states are not on cards": problem.theory != Theory(),
    }
    for message in (message for message, there in beyond.items() if there):
        found.warn("MD150", message, "keep the YAML deck beside the cards")


def _heading(found: Losses, title: str) -> None:
    if len(title) > layout.COLUMNS or not (title.isascii() and title.isprintable()):
        help = f"give a title of at most {layout.COLUMNS} printable ASCII characters"
        found.error("MD149", f"the title '{title[:100]}' does not fit the heading card", help)


def _sizes(found: Losses, problem: Problem) -> None:
    sizes = {"N": problem.structure.n, "INTR": len(problem.parameters), "NRS": len(problem.elements)}
    for row in layout.CONTROL:
        size = sizes.get(row.name, row.low)
        if size < row.low or size > (row.high or size):
            found.error("MD146", f"{row.name}, the {row.meaning}, is {size}; cards hold {row.low} to {row.high}")
    if np.any(np.diff(problem.elements.is_mass.astype(int)) < 0):
        found.error("MD146", "mass elements stand before stiffness elements; cards list stiffness first")
    test = problem.test
    if test is not None and test.s > layout.MOST_INDIC_CARDS * len(layout.INDIC.fields):
        message = f"{test.s} positions are more than the 140 of the 1972 program"
        found.warn("MD121", message, "the old program cannot read it")


def _parameter(found: Losses, parameter: Parameter) -> None:
    """Value, limits and transform: cards know only the change of a property."""
    name = parameter.name
    if parameter.nominal != 0:
        found.error("MD141", f"{name} has the prior value {parameter.nominal:.8g}; cards hold no values of properties")
    if parameter.lower != -inf or parameter.upper != inf:
        found.error("MD142", f"{name} has limits, {parameter.lower:.8g} to {parameter.upper:.8g}; cards hold none")
    if parameter.transform != "identity":
        found.error("MD143", f"{name} has transform {parameter.transform}; cards hold none")


def _test(found: Losses, test: ModalTest) -> None:
    missing = int(np.count_nonzero(np.isnan(test.frequency_hz)))
    if missing or test.m == 0:
        found.error("MD145", f"{missing} of {test.m} modes have no frequency; every mode of a card deck has one")
    blank = int(np.count_nonzero(np.isnan(test.shapes)))
    if blank:
        found.error("MD145", f"{blank} components of mode shapes are missing; on cards they would be measured zeros")
    if test.scale != "least-squares":
        found.warn("MD151", f"scale: {test.scale} is not on cards", f"run the cards with --scale {test.scale}")


def _options(found: Losses, run: RunOptions) -> None:
    for name, value in AS_IN_1972.items():
        chosen = getattr(run, name)
        if chosen != value:
            option = f"--{name.replace('_', '-')}" + ("" if chosen is True else f" {chosen}")
            message = f"{name}: {chosen} is not on cards, which stand for {value}"
            found.warn("MD151", message, f"run the cards with {option}")
    if run.fix_total_mass:
        found.error("MD148", "the total mass is held fixed, which cards cannot express")


def _names(found: Losses, problem: Problem) -> None:
    lost = []
    if any(p.name != f"p{i}" or p.unit for i, p in enumerate(problem.parameters, 1)):
        lost.append("names and units of the properties")
    if problem.structure.labels != tuple(str(i + 1) for i in range(problem.structure.n)):
        lost.append("names of the degrees of freedom")
    for what in lost:
        found.warn("MD150", f"the {what} are not on cards", "keep the YAML deck beside the cards")
