"""The deck, the options of the run, and what was known before it."""

from collections.abc import Iterator

import numpy as np

from mouse_cli import __version__
from mouse_cli._errors import RULER
from mouse_cli.estimators import estimator
from mouse_cli.model.problem import Problem
from mouse_cli.model.result import Forecast, Result
from mouse_cli.report.blocks import Block, Cell, Heading, Lines, Matrix, Table, Text, heads
from mouse_cli.report.measured import NOT_MEASURED, eigenvalue_index, positions
from mouse_cli.report.section import APPENDIX, Options, Section
from mouse_cli.report.sections._wording import counted, finite, names
from mouse_cli.updating.loop import RECURSIONS

_SCALES = {
    "least-squares": "each measured shape is brought to the scale of the theory once, by least squares over its points",
    "fitted": "the scale of each shape is fitted along with the properties",
    "unit": "each measured shape is brought to unit modal mass over its points",
    "none": "measured shapes are taken as they were given",
}
_PAIRINGS = {
    "number": "each measured mode is the model's mode of the same number",
    "mac": "each measured mode is the model's mode that is most like it in shape (MAC) and frequency",
}
_RULES = {
    "ratio": "ratio of exceedances to non-exceedances",
    "fraction": "share of exceedances in all data",
}
_UNUSED = "not used by this recursion"
_STEPS = {
    "first-order": "along the partial derivatives",
    "second-order": "along the partial derivatives, with the curvature of the data along the step",
}


def heading(result: Result, options: Options) -> Iterator[Block]:
    """Everything that one needs to run the same run again."""
    problem = result.problem
    rejected = " The form of the model is rejected." if result.rejected else ""
    yield Table(
        heads("< | <"),
        (
            ("program", f"mouse {result.versions.get('mouse', __version__)}"),
            ("title", problem.title.strip()),
            ("source", problem.source.path),
            ("result", result.status.sentence + rejected),
        ),
    )
    yield Text(_size(result))
    columns = heads("<option | <value | <meaning")
    yield Table(columns, (*_method(problem), *_convergence(result), *_limits(problem)))


def _size(result: Result) -> str:
    problem = result.problem
    return (
        f"The model has {counted(problem.structure.n, 'degree', 'degrees')} of freedom and "
        f"{counted(len(problem.parameters), 'variable property', 'variable properties')}{_moved(problem)}; the test gave "
        f"{counted(len(result.y), 'datum', 'data')} of {' and of '.join(_measured(result))}."
    )


def _measured(result: Result) -> Iterator[str]:
    """What the data are of."""
    test = result.problem.test
    if test.m or not result.frf:
        yield f"{counted(test.m, 'mode')} at {counted(test.s, 'position')}"
    count = sum(int(fit.have.any(axis=0).sum()) for fit in result.frf)
    if count:
        lines = sum(len(fit.lines) for fit in result.frf)
        yield f"{counted(count, 'frequency response function')} at {counted(lines, 'line')}"


def _moved(problem: Problem) -> str:
    """What the properties move."""
    verb, parts = "move" if len(problem.parameters) != 1 else "moves", []
    bound = {(binding.set, i) for binding in problem.bindings for i in binding.members}
    if bound:
        whole = sum(map(len, problem.mesh.elements))
        parts.append(
            f"{len(bound)} of the {counted(whole, 'element')} between {counted(len(problem.mesh.node_ids), 'node')}"
        )
    if len(problem.elements) or not bound:
        parts.append(f"{counted(len(problem.elements), 'element')} of its matrices")
    return f" that {verb} {' and '.join(parts)}"


def _method(problem: Problem) -> tuple[tuple[Cell, ...], ...]:
    run, method = problem.run, estimator(problem.run.estimator)
    modal = (
        ("scale", problem.test.scale, _SCALES[problem.test.scale]),
        ("pairing", run.pairing, _PAIRINGS[run.pairing]),
    )
    return (
        ("estimator", run.estimator, f"{method.title}: {method.equation}"),
        ("recursion", run.recursion, RECURSIONS[run.recursion].MEANING),
        *(modal if problem.test.m else ()),
        ("step", run.step, _STEPS[run.step]),
    )


def _convergence(result: Result) -> tuple[tuple[Cell, ...], ...]:
    run, z = result.problem.run, result.z
    replaced = run.recursion == "replaced"
    ends = "until that many or fewer exceed" if replaced else "until a full step is negligible"
    cycles = ("as needed", ends) if run.cycles is None else (run.cycles, "exactly so many")
    extra = "one more cycle after convergence" if run.extra_update else "no cycle after convergence"
    passes = "passes over each set of partial derivatives (ITERMX)"
    may = f"{_RULES[run.convergence]}: {result.allowed} of {len(result.y)} may exceed"
    return (
        ("confidence", f"{run.confidence} %", f"a datum exceeds its limits beyond {z:.3f} standard deviations"),
        ("convergence", run.convergence, may),
        ("partials", run.partials, "most computations of the partial derivatives (NPARD)"),
        ("passes", run.passes, passes if replaced else _UNUSED),
        ("cycles", *cycles),
        ("extra update", "yes" if run.extra_update else "no", extra if replaced else _UNUSED),
    )


def _limits(problem: Problem) -> tuple[tuple[Cell, ...], ...]:
    run = problem.run
    bounded = "no revision is limited by its standard deviation"
    if run.limit_sd is not None:
        bounded = f"no property moves farther than {run.limit_sd:g} prior standard deviations"
    over = "all degrees of freedom"
    if run.total_mass_dofs:
        over = "degrees of freedom " + ", ".join(problem.structure.labels[d] for d in run.total_mass_dofs)
    mass = f"held, over {over}" if run.fix_total_mass else "free to change"
    limits = "of 1972, enforced" if run.legacy else "none"
    sizes = "orders and counts that the program of 1972 could hold" if run.legacy else ""
    return (
        ("limits", "none" if run.limit_sd is None else run.limit_sd, bounded),
        ("total mass", "held" if run.fix_total_mass else "free", mass),
        ("size limits", limits, sizes),
    )


def cards(subject: Result | Forecast, options: Options) -> Iterator[Block]:
    """Only a deck of cards is echoed; a YAML deck is short and at hand."""
    source = subject.problem.source
    if source.format != "cards" or not source.lines:
        return
    digits = max(4, len(str(len(source.lines))))
    ruler = tuple(f"{'':{digits}}   {line}" for line in RULER)
    yield Lines(ruler + tuple(f"{i:{digits}}   {line}" for i, line in enumerate(source.lines, 1)))


def prior(subject: Result | Forecast, options: Options) -> Iterator[Block]:
    """Properties; then, of a test, frequencies and shapes."""
    problem = subject.problem
    yield Heading("Properties", 2)
    yield _properties(problem)
    if changes_only(problem):
        yield Text("The deck gives no values of the properties; they are counted as changes from the model as given.")
    yield from _correlations(problem, options)
    if isinstance(subject, Result) and problem.test.m:
        yield Heading("Measured data", 2)
        yield _frequencies(subject)
        yield from _shapes(subject)


def changes_only(problem: Problem) -> bool:
    """Whether the deck gave no nominal value, as card decks cannot."""
    return not any(problem.prior.mean) and problem.source.format == "cards"


def _properties(problem: Problem) -> Table:
    columns = heads(
        "<property | <unit | nominal value | standard deviation | lower limit | upper limit | <transform | <"
    )
    rows = []
    for p, mean, sd in zip(problem.parameters, problem.prior.mean, problem.prior.sd, strict=True):
        transform, held = p.transform if p.transform != "identity" else None, None if sd > 0 else "held"
        rows.append((p.name, p.unit, mean, sd, finite(p.lower), finite(p.upper), transform, held))
    return Table(columns, rows).without_empty_columns()


def _correlations(problem: Problem, options: Options) -> Iterator[Block]:
    """The prior covariance, where properties are uncertain together."""
    cov = problem.prior.cov
    if cov.ndim == 1 or not (cov - np.diag(np.diag(cov))).any():
        return
    if len(cov) > options.properties:
        yield Text("The prior uncertainties of the properties are correlated.")
        return
    yield Matrix("prior covariance of the properties", cov, names(problem), names(problem))


def _frequencies(result: Result) -> Table:
    """One line a measured mode: frequency, eigenvalue and their accuracies; the factor that scaled its shape."""
    test, index = result.problem.test, eigenvalue_index(result)
    columns = heads(
        "mode | test frequency [Hz] | standard deviation [Hz] | test eigenvalue [rad2/s2] | "
        "standard deviation [rad2/s2] | positions measured | scale factor of shape"
    )
    rows = []
    for i, k in enumerate(index.tolist()):
        datum = (result.y[k], result.sd[k]) if k != NOT_MEASURED else (None, None)
        count = np.isfinite(test.shapes[:, i]).sum()
        factor = result.shape_factor[i] if count else None
        rows.append((test.number[i], test.frequency_hz[i], test.frequency_sd_hz[i], *datum, count, factor))
    return Table(columns, rows)


def _shapes(result: Result) -> Iterator[Block]:
    """The measured shapes as given, and their accuracy: one number where it is one."""
    test = result.problem.test
    measured = np.isfinite(test.shapes)
    if not measured.any():
        yield Text("No mode shape was measured.")
        return
    modes, corner = tuple(str(n) for n in test.number), ("position", "mode")
    yield Matrix("measured mode shapes, as given", test.shapes, positions(result), modes, corner=corner)
    sd = test.shape_sd[measured]
    if np.ptp(sd) == 0:
        yield Text("The standard deviation of every measured component is {}.", (sd[0],))
    else:
        shown = np.where(measured, test.shape_sd, np.nan)
        yield Matrix("their standard deviations", shown, positions(result), modes, corner=corner)


SECTIONS = (
    Section("heading", 10, "Modal Optimization Using Statistical Evaluators", heading, place=APPENDIX),
    Section("cards", 20, "Echo of the cards", cards, (Result, Forecast), place=APPENDIX),
    Section("prior", 30, "Before the test", prior, (Result, Forecast), place=APPENDIX),
)
