"""Sweeps, bootstraps and samples of a posterior: mark, first sentence, figures and tables."""

from collections.abc import Callable, Iterator

from mouse_cli.page.charts import Interval, intervals
from mouse_cli.page.html import Markup
from mouse_cli.page.numbers import shown
from mouse_cli.page.sections._words import shares
from mouse_cli.page.tables import Column, Listing, columns_of
from mouse_cli.report.reading import Part

_MOST = 40  # lines of a figure
_NAMED = columns_of("parameter: name name | unit: unit text")
_MODE = columns_of("mode: name name")


def mark(document: Part) -> tuple[str, str]:
    """Whether the answer stands: its exit code, and what the remarks doubt."""
    what = {"sweep": "Sweep", "bootstrap": "Bootstrap"}.get(document.text("kind"), "Posterior by samples")
    code = document.number("exit_code") or 0
    if code > 1:
        return "bad", f"✗ {what}: runs without an answer"
    return ("doubt", f"! {what}, with doubts") if code or document.texts("warnings") else ("good", f"✓ {what}")


def sentence(document: Part) -> str:
    """The parameter that moves most, or that is most scattered, and why."""
    kind = document.text("kind")
    lengths = {p.text("name"): x for p in document.parts("parameters") if (x := _length(p, kind)) is not None}
    if not lengths:
        return f"No answer in {len(document.parts('points' if kind == 'sweep' else 'replicates'))} runs."
    name = max(lengths, key=lengths.__getitem__)
    part = next(p for p in document.parts("parameters") if p.text("name") == name)
    if kind == "sweep":
        by = _largest(part.part("shares"))
        words = f"{name} moves most: by {shown(lengths[name], 2)} posterior standard deviations"
        return f"{words}{by and f', mainly by {by}'}, over {len(document.parts('points'))} points."
    words = f"{name} is scattered most: {shown(lengths[name], 3)} times as much as the stated accuracies predict"
    without = part.label("most_influential")
    return f"{words}, in {len(document.parts('replicates'))} replicates{without and f'; most influential: {without}'}."


def _length(parameter: Part, kind: str) -> float | None:
    """What parameters are compared by: movement by posterior sd, or scatter over the predicted one."""
    if kind == "sweep":
        return parameter.number("moves_by_sd")
    sd, predicted = parameter.number("sd"), parameter.number("predicted_sd")
    return sd / predicted if sd is not None and predicted else None


def _largest(found: Part) -> str:
    known = {key: x for key in found.values if (x := found.number(key)) is not None}
    return max(known, key=known.__getitem__, default="")


def figures(document: Part) -> Iterator[Markup]:
    """What parameters are compared by, as bars."""
    kind = document.text("kind")
    title = "Movement of parameters" if kind == "sweep" else "Scatter of parameters"
    by = "In posterior standard deviations." if kind == "sweep" else "Over that which the stated accuracies predict."
    found = [(p.text("name"), _length(p, kind)) for p in document.parts("parameters")]
    yield shares("compared", title, by, [(name, shown(x, 3), x) for name, x in found])


def tables(document: Part) -> Iterator[Listing]:
    """Parameters and frequencies, then single runs."""
    of = _sweep if document.text("kind") == "sweep" else _bootstrap
    yield from of(document, document.parts("parameters"), document.parts("frequencies"))


def _sweep(document: Part, parameters: list[Part], frequencies: list[Part]) -> Iterator[Listing]:
    varied = document.labels("varied")
    shares = (Column(f"share of {name}", _below("shares", name, 3)) for name in varied)
    moves = (*columns_of("from: lowest | to: highest | moves by, posterior sd: moves_by_sd 3"), *shares)
    yield Listing("moved", "Parameters over the sweep", (*_NAMED, *moves), parameters)
    yield Listing("frequencies-moved", "Natural frequencies, Hz", (*_MODE, *moves), frequencies)
    values = (Column(name, _below("values", name)) for name in varied)
    found = (Column(p.text("name"), _below("posterior", p.text("name"))) for p in parameters[:_MOST])
    heads = (*values, *columns_of("ended: ended text | chi-square: chi2 | p-value: p p"), *found)
    yield Listing("points", "Points of the sweep", heads, document.parts("points"))


def _bootstrap(document: Part, parameters: list[Part], frequencies: list[Part]) -> Iterator[Listing]:
    spread = columns_of(
        "run: value | posterior sd: posterior_sd | predicted sd: predicted_sd | bootstrap sd: sd | jackknife sd: jackknife_sd | "
        "bias: bias | 95 % from: () | to: ()",
        _item("percentile_95", 0),
        _item("percentile_95", 1),
    )
    yield Listing("spread", "Parameters by the bootstrap", (*_NAMED, *spread), parameters)
    yield Listing("frequencies-spread", "Natural frequencies, Hz", (*_MODE, *spread), frequencies)
    units = [Part({"unit": unit}, document.file) for unit in document.labels("units")]
    moved = lambda p: Column(p.text("name"), lambda unit: Column("", unit.text("unit"), 3).cell(p.part("influence")))
    heads = (*columns_of("without: unit text"), *map(moved, parameters[:_MOST]))
    yield Listing("influence", "Movement without one datum, in posterior standard deviations", heads, units)


def _below(key: str, name: str, digits: int = 5) -> Callable[[Part], object]:
    """The value called `name` of the object below `key`: names of parameters are no keys of the document."""

    def cell(part: Part) -> object:
        value = part.part(key).values.get(name)
        return value if isinstance(value, str) else Column("", name, digits).cell(part.part(key))

    return cell


def _item(key: str, i: int) -> Callable[[Part], float | None]:
    return lambda part: dict(enumerate(part.numbers(key))).get(i)


def sampled(document: Part) -> str:
    """Whether the normal density of the run stands for the posterior."""
    may = "must not" if document.flag("doubtful") else "may"
    modes = len(document.parts("places"))
    several = f" The posterior has {modes} modes." if modes > 1 else ""
    k_hat = shown(document.number("k_hat"), 2)
    return f"The normal density of the run {may} stand for the posterior: Pareto k-hat {k_hat}.{several}"


def sample_figures(document: Part) -> Iterator[Markup]:
    """Mean and standard deviation of the samples by those of the run."""
    rows = [_interval(p) for p in document.parts("parameters")[:_MOST]]
    words = "; ".join(f"{row.label}: {row.words}" for row in rows)
    description = f"Mean of the samples less the value of the run, and one sd, both in sd of the run. {words}."
    yield intervals("samples", "Samples beside the normal density of the run", description, rows, ("run", "samples"))


def _interval(parameter: Part) -> Interval:
    value, sd, mean, spread = (parameter.number(key) for key in ("run", "run_sd", "mean", "sd"))
    if not sd or None in (value, mean, spread):
        return Interval(parameter.text("name"), "unknown", None, None)
    centre, half = (mean - value) / sd, spread / sd
    words = f"{'−' if centre < 0 else '+'}{abs(centre):.2f} ± {half:.2g} sd of the run"
    return Interval(parameter.text("name"), words, centre, half)


def sample_tables(document: Part) -> Iterator[Listing]:
    """Parameters, frequencies, modes of the posterior."""
    common = columns_of(
        "run: run | sd of run: run_sd | mean: mean | sd: sd | median: median | 95 % from: () | to: ()",
        _item("interval_95", 0),
        _item("interval_95", 1),
    )
    parameters, modes = document.parts("parameters"), document.parts("places")
    chain = columns_of("effective sample size: effective_size 4 | R-hat: r_hat 4")
    yield Listing("samples-parameters", "Parameters by samples", (*_NAMED, *common, *chain), parameters)
    new = columns_of("new test from: () | to: ()", _item("predicted", 0), _item("predicted", 1))
    heads = (*_MODE, *columns_of("test: measured"), *common, *new)
    yield Listing("samples-frequencies", "Natural frequencies, Hz", heads, document.parts("frequencies"))
    values = (Column(p.text("name"), _item("values", i)) for i, p in enumerate(parameters))
    heads = (*values, *columns_of("J: cost | share: share p"))
    yield Listing("samples-modes", "Modes of the posterior", heads, modes if len(modes) > 1 else [])
