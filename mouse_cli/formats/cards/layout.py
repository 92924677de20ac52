"""The twelve groups of a card deck as data.

Reader, writer, messages, `mouse show` and the user's manual come from here. Source: the report's Appendix A
(user's manual). Columns are not written down at all: they follow from the FORMAT.
"""

from dataclasses import dataclass
from functools import cached_property

from mouse_cli.formats.edit.descriptor import Format, expand

COLUMNS = 80
INPUT_FORMAT = "4(2I3,E14.8)"
LARGEST_INDEX = 999  # an I3 field holds no more
MOST_INDIC_CARDS = 7


@dataclass(frozen=True, slots=True)
class Row:
    """What one field of a card means. `{i}` in the name is its ordinal in the group, from 1.

    low, high: bounds in any program. limit: the bound of the 1972 program (storage). at_most: the control
    integer that bounds it.
    """

    name: str
    meaning: str
    unit: str = ""
    legal: str = ""
    low: int | None = None
    high: int | None = None
    limit: int | None = None
    at_most: str = ""


@dataclass(frozen=True, slots=True)
class Field:
    """One field of one card: where it stands and what it is."""

    row: Row
    column: int
    format: Format

    @property
    def width(self) -> int:
        """Number of columns."""
        return self.format.width

    @property
    def columns(self) -> str:
        """First and last column, e.g. `41-48`."""
        return f"{self.column}-{self.column + self.width - 1}"

    def cut(self, card: str) -> str:
        """The field's text on a card of 80 columns."""
        return card[self.column - 1 : self.column - 1 + self.width]

    def label(self, ordinal: int) -> str:
        """The field's name when it is the `ordinal`-th of its kind in the group, from 1."""
        return self.row.name.format(i=ordinal)


@dataclass(frozen=True)
class Group:
    """One of the twelve groups. `rows` repeat along the card; `cards` and `ended` say how many there are."""

    number: int
    name: str
    symbol: str
    format: str
    rows: tuple[Row, ...]
    cards: str
    ended: str
    text: str

    @cached_property
    def fields(self) -> tuple[Field, ...]:
        """The fields of one card, with columns from the FORMAT."""
        found, column = [], 1
        for i, descriptor in enumerate(expand(self.format)):
            found.append(Field(self.rows[i % len(self.rows)], column, descriptor))
            column += descriptor.width
        return tuple(found)

    @cached_property
    def items(self) -> tuple[tuple[Field, ...], ...]:
        """The fields of one card, item by item: single fields, pairs (I, J), or triples (I, J, value)."""
        size = len(self.rows)
        return tuple(self.fields[k : k + size] for k in range(0, len(self.fields), size))

    @cached_property
    def cuts(self) -> tuple[tuple[slice, ...], ...]:
        """Where each field of each item stands on a card, for reading many at once."""
        return tuple(
            tuple(slice(field.column - 1, field.column - 1 + field.width) for field in item) for item in self.items
        )

    @property
    def is_input(self) -> bool:
        """Whether the group is read by routine INPUT and ended by a blank card."""
        return self.format == INPUT_FORMAT

    @property
    def title(self) -> str:
        """`group 2, control integers`."""
        return f"group {self.number}, {self.name}"

    def cards_for(self, items: int) -> int:
        """Cards that hold so many items."""
        return -(-items // len(self.items))


def _input(symbol: str, rows: str, columns: str, value: Row) -> tuple[Row, ...]:
    """The three fields of an element as routine INPUT reads it."""
    return (
        Row(f"row of {symbol}", "row index I", legal=rows),
        Row(f"column of {symbol}", "column index J", legal=columns),
        value,
    )


CONTROL = (
    Row("N", "order of M and K", legal="1 to 140", low=1, high=LARGEST_INDEX, limit=140),
    Row("NM", "number of measured modes", legal="1 to 10, at most N", low=1, limit=10, at_most="N"),
    Row(
        "NVEC",
        "highest system mode in the test data, rigid-body modes counted",
        legal="MODE(NM)",
        low=1,
        at_most="N",
    ),
    Row("JFLAG", "print the matrix of partial derivatives: 0 no, 1 yes", legal="0 or 1", low=0, high=1),
    Row("KONF", "confidence level: 1 is 99 %, 2 is 95 %, 3 is 90 %", legal="1, 2 or 3", low=1, high=3),
    Row(
        "IROW",
        "measured elements per eigenvector",
        legal="0 to N, the count of INDIC",
        low=0,
        limit=140,
        at_most="N",
    ),
    Row("ITERMX", "passes of O-7 and O-8 before the partials are recomputed", legal="1 or more", low=1),
    Row(
        "INTR",
        "number of variable properties: columns of A, order of COV",
        legal="1 to 140",
        low=1,
        high=LARGEST_INDEX,
        limit=140,
    ),
    Row(
        "NRS",
        "number of variable elements of K and M: rows of A",
        legal="1 to 140",
        low=1,
        high=LARGEST_INDEX,
        limit=140,
    ),
    Row("NPARD", "maximum number of computations of the partial derivatives", legal="1 or more", low=1),
)
CONFIDENCE = {1: 99, 2: 95, 3: 90}

HEADING = Group(
    1, "case heading", "", "20A4", (Row("heading", "80 characters of free text"),), "1", "count",
    "Any text. It is printed at the head of the results.",
)  # fmt: skip
CONTROLS = Group(
    2, "control integers", "", "10I8", CONTROL, "1", "count",
    "Ten integers, each right justified in its eight columns: a blank after a digit is a zero.",
)  # fmt: skip
MODE = Group(
    3, "measured modes", "MODE", "10I8",
    (Row("MODE({i})", "system mode number of measured mode {i}", legal="ascending, 1 to N"),), "1", "count",
    "System mode numbers, strictly ascending, rigid-body modes counted: with two rigid-body modes and "
    "measured flexural "
    "modes 1, 3 and 4 punch 3 5 6. Unused fields are blank.",
)  # fmt: skip
RS = Group(
    4, "random elements", "RS", "20I4",
    (Row("row of RS({i})", "row of a variable element", legal="1 to N"),
     Row("column of RS({i})", "column of a variable element", legal="1 to N")),
    "(NRS+1)/10, rounded up", "count of NRS+1 pairs",
    "The elements of K that may vary, then one pair 0 0, then those of M. Give the upper triangle; an "
    "element and its "
    "mirror image move together. With elements of K only, the pair 0 0 comes last.",
)  # fmt: skip
INDIC = Group(
    5, "measured positions", "INDIC", "20I4",
    (Row("INDIC({i})", "degree of freedom measured", legal="1 to N, no repeats"),), "1 to 7",
    "a card whose 20th value is 0, or 7 cards",
    "The degrees of freedom at which the test eigenvectors were measured; one list serves every mode, and "
    "its order is that of the eigenvector data. When IROW is 20, 40, ... 120 a blank card must follow.",
)  # fmt: skip
COV = Group(
    6, "standard deviations of the properties", "COV", INPUT_FORMAT,
    _input("COV", "1 to INTR", "1 to INTR",
           Row("COV", "standard deviation of a property", "of the property", "> 0")),
    "1 or more", "blank card",
    "Standard deviations on the diagonal. A property without an entry has none and stays at its prior value.",
)  # fmt: skip
A = Group(
    7, "partial derivatives of the elements", "A", INPUT_FORMAT,
    _input("A", "1 to NRS", "1 to INTR",
           Row("A", "derivative of an element by a property", "element/property")),
    "1 or more", "blank card",
    "Row i is the i-th pair of group 4, without the pair 0 0; column r is the r-th property, as in COV.",
)  # fmt: skip
LAMTST = Group(
    8, "test frequencies", "LAMTST", "4E20.5",
    (Row("LAMTST({i})", "natural frequency of measured mode {i}", "Hz", "ascending, > 0"),),
    "NM/4, rounded up", "count of NM values",
    "Natural frequencies in Hz, in spite of the name; the i-th belongs to MODE(i).",
)  # fmt: skip
X = Group(
    9, "test eigenvectors", "X", INPUT_FORMAT,
    _input("X", "a number in INDIC", "1 to NM", Row("X", "component of a test eigenvector", "any")),
    "1 or more", "blank card",
    "I is the degree of freedom, J the position of the mode in MODE. Any scale and sign for each mode. An "
    "element that is not punched is a measured zero.",
)  # fmt: skip
VAR = Group(
    10, "standard deviations of the data", "VAR", "5E16.8",
    (Row("VAR({i})", "standard deviation of datum {i}", "Hz, then units of X", "> 0"),),
    "NM(1+IROW)/5, rounded up", "count of NM(1+IROW) values",
    "First NM values for the frequencies, in Hz; then, without starting a new card, IROW values for the "
    "first mode in the order of INDIC, IROW for the second, and so on.",
)  # fmt: skip
M = Group(
    11, "mass matrix", "M", INPUT_FORMAT,
    _input("M", "1 to N", "1 to N", Row("M", "element of the mass matrix", "mass")),
    "1 or more", "blank card",
    "Diagonal and upper triangle; every diagonal element is positive. The 1972 program took a diagonal "
    "matrix only.",
)  # fmt: skip
K = Group(
    12, "stiffness matrix", "K", INPUT_FORMAT,
    _input("K", "1 to N", "1 to N", Row("K", "element of the stiffness matrix", "stiffness")),
    "1 or more", "blank card",
    "Diagonal and upper triangle. The units of K and M make an eigenvalue (rad/s)**2.",
)  # fmt: skip

GROUPS = (HEADING, CONTROLS, MODE, RS, INDIC, COV, A, LAMTST, X, VAR, M, K)
