"""The inputs I-1 to I-5, the operations O-1 to O-12 and the words of the report of 1972, and what of this program does them."""

from collections.abc import Iterator

from mouse_cli.formats.cards.layout import GROUPS, Field, Group

_SECTION = "J. H. Wiggins Company 1972, section {}"
_WORDS = {
    "I-1": (
        "stiffness and mass matrices",
        "K and M of the model: groups 11 and 12 of the cards; `model` of a YAML deck.",
    ),
    "I-2": (
        "matrix [A]",
        "Derivatives of the listed elements of K and M by the independent properties, groups 4 and 7; `stiffness` and `mass` of "
        "each of `parameters`.",
    ),
    "I-3": (
        "prior covariance",
        "Covariance of the independent properties, group 6; diagonal where they are independent; `sd`, or `prior.covariance`.",
    ),
    "I-4": (
        "test measurements",
        "Frequencies, squared at once to eigenvalues (2 pi f)^2, and components of eigenvectors, as many as were measured; one "
        "is enough: groups 8 and 9; `test.modes`.",
    ),
    "I-5": (
        "accuracies",
        "Variance of each measurement, the diagonal of R, in the same order: group 10; `frequency_sd`, `shape_sd`.",
    ),
    "O-1": (
        "eigenvalues and eigenvectors",
        "K x = lambda M x for the modes that were measured; in 1972 by Givens and Householder, here by LAPACK, or by block Lanczos "
        "iteration where K and M are sparse. `mouse modes` prints the model as it is.",
    ),
    "O-2": (
        "confidence limits",
        "Each difference of measured and predicted data beside z sigma, z = 1.645, 1.960 or 2.576 for 90, 95 or 99 per cent "
        "(KONF): of 20 data one may exceed its limits at 95 per cent. `--confidence`, `--convergence`.",
    ),
    "O-3": (
        "decision",
        "The run ends when no more data exceed their limits than O-2 allows; else it goes on with O-4.",
    ),
    "O-4": (
        "matrix [B]",
        "B = d(lambda, x) / d(k, m): derivatives of the measured data by the listed elements, by the method of VIDAP in 1972, "
        "which took all modes of the model; exact here (Fox and Kapoor 1968; Nelson 1976). `--print-partials` prints it.",
    ),
    "O-5": ("matrix [T]", "T = B A: derivatives of the measured data by the independent properties."),
    "O-6": (
        "Bayes estimator [W]",
        "W = S T' (R + T S T')^-1; see `mouse explain bayes` and `mouse explain table-3-1`.",
    ),
    "O-7": (
        "revised properties",
        "p* = p + W (y - h(p)), y measured and h predicted. `mouse explain replaced` and `mouse explain anchored` give what stays "
        "from pass to pass.",
    ),
    "O-8": (
        "another pass",
        "p* replaces p, and O-7 is done ITERMX times with one T; `passes` of a YAML deck.",
    ),
    "O-9": ("changes of the elements", "dk = A (p* - p): what the listed elements of K and M change by."),
    "O-10": ("revised matrices", "K and M with these changes, for the next O-1."),
    "O-11": (
        "revised covariance",
        "S* = S - S T' (R + T S T')^-1 T S, with T of the last model, in square-root form here.",
    ),
    "O-12": ("printout", "Revised K and M, eigenvalues and eigenvectors, S* and confidence limits: `mouse run`."),
    "table-3-1": (
        "the estimators",
        "Least squares, weighted least squares, maximum likelihood, minimum variance and Bayes: the first knows neither accuracies "
        "nor prior, the next three the accuracies R, the last both. `mouse list estimators`; `run: {estimator: ...}`.",
    ),
    "VIDAP": (
        "the program of 1970",
        "By the same company for the same centre: from the uncertainty of masses and stiffnesses to that of frequencies and mode "
        "shapes. MOUSE took its derivatives (O-4). `mouse modes` does what it did: sd of each frequency and component.",
    ),
}


def explanations() -> Iterator[tuple[str, str]]:
    """Each name with its explanation: words of the report, then the arrays and the fields of the cards."""
    for name, (title, text) in _WORDS.items():
        section = {"I": "4.2", "O": "4.3", "t": "3.8", "V": "1"}[name[0]]
        yield name, f"{name}: {title} ({_SECTION.format(section)})\n\n{text}"
    for group in GROUPS:
        if group.symbol:
            yield (
                group.symbol,
                f"{group.symbol}: {group.name}\n\nCards of group {group.number}, FORMAT {group.format}. {group.text}",
            )
        for field in group.fields[: len(group.rows)]:
            if "{i}" not in field.row.name and field.row.name.isupper() and field.row.name != group.symbol:
                yield field.row.name, _about(group, field)


def _about(group: Group, field: Field) -> str:
    """A field of the cards: what it means, where it is punched, what it may be."""
    row = field.row
    text = f"{row.name}: {row.meaning}\n\nCards of {group.title}, columns {field.columns}, FORMAT {field.format}."
    return f"{text} Legal: {row.legal}." if row.legal else text
