"""Fields and whole cards against a FORTRAN compiler: the same bits, or the same refusal.

A small program, compiled here, reads generated cards with BLANK='ZERO' and prints every value in
hexadecimal. Its answers are kept in `gfortran_answers.json` under the hash of the cards, so that the
comparison is also made without a compiler.
Not generated: what gfortran reads and the 1972 rules refuse (NaN, Q exponents, commas, an exponent without
mantissa or digits, values outside the 1108's range, a blank after the digits of a nonzero exponent).
"""

import hashlib
import json
import random
import re
import shutil
import struct
import subprocess
from pathlib import Path

import pytest

from mouse_cli.formats.cards.layout import GROUPS
from mouse_cli.formats.edit import FieldError, read_field, write_field
from mouse_cli.formats.edit.descriptor import expand

ANSWERS = Path(__file__).with_name("gfortran_answers.json")
FIELDS = 250  # of each format
CARDS = 25  # of each group

PROGRAM = """
program reader
  implicit none
  character(len=20) :: kind, form
  character(len=40) :: formats(80)
  character(len=80) :: card
  integer :: n, k, status, count, first
  integer(4) :: i
  real(8) :: x
  open(10, file='cards.txt', form='formatted', blank='zero', pad='yes')
  open(11, file='plan.txt', form='formatted')
  open(12, file='answers.txt', form='formatted')
  do
    read(11, *, iostat=status) kind, form, first, count
    if (status /= 0) exit
    read(10, '(a80)') card
    if (kind == 'I') then
      read(card(first:first+count-1), form, iostat=status, blank='zero') i
      if (status == 0) write(12, '(z8.8)') i
    else
      read(card(first:first+count-1), form, iostat=status, blank='zero') x
      if (status == 0) write(12, '(z16.16)') x
    end if
    if (status /= 0) write(12, '(a)') 'error'
  end do
end program
"""


def _number(rng):
    """A number in one of the forms that cards hold, with signs, points, exponents and blanks where they may
    be."""
    whole = "".join(rng.choices("0123456789", k=rng.randint(0, 6)))
    fraction = "".join(rng.choices("0123456789", k=rng.randint(0, 7)))
    point = rng.choice([".", ".", ""])
    if not point or not (whole + fraction):
        whole, fraction = whole or rng.choice("123456789"), fraction if point else ""
    exponent = rng.choice(["", "", "E{}", "E+{:02d}", "D-{:02d}", "+{:02d}", "-{}", "e{}", "E 0{}", "D+ {}", "-{:03d}"])
    number = rng.choice(["", "", "-", "+"]) + whole + point + fraction + exponent.format(rng.randint(0, 9))
    if rng.random() < 0.3:
        at = rng.randrange(len(number))
        if re.fullmatch(r"[0-9.]", number[at]) and not re.search(r"[ED+-]", number[1:at], re.I):
            number = number[:at] + " " + number[at:]
    return number


def _real(rng, width):
    number = _number(rng)
    if not re.search(r"[EeDd]|(?<=.)[+-]", number):
        number += " " * rng.choice([0, 0, 0, 1, 3])
    return number[:width].rjust(width) if rng.random() < 0.9 else " " * width


def _integer(rng, width):
    number = rng.choice(["", "", "-", "+"]) + str(rng.randrange(10 ** rng.randint(1, width - 1)))
    number += " " * rng.choice([0, 0, 0, 1, 2])
    if rng.random() < 0.1:
        number = rng.choice(["", "-", "--1", "1.", "1E2", "1-", "A", "*" * width])
    return number[:width].rjust(width)


def _cases():
    """(format, text) of every generated field: loose ones, and those of whole cards as the groups lay them
    out."""
    rng = random.Random(1972)
    for format in ("I3", "I4", "I8", "E14.8", "E16.8", "E20.5"):
        yield from ((format, _field(rng, format)) for _ in range(FIELDS))
    for group in GROUPS[1:]:
        for _ in range(CARDS):
            yield from ((str(form), _field(rng, str(form))) for form in expand(group.format))
    for _ in range(FIELDS):
        value = rng.choice([-1, 1]) * rng.random() * 10.0 ** rng.randint(-30, 30)
        yield from ((format, write_field(value, format)) for format in ("E14.8", "E16.8", "E20.5"))


def _field(rng, format):
    form = expand(format)[0]
    return _integer(rng, form.width) if form.kind == "I" else _real(rng, form.width)


def _lax(text):
    """Where the rules of 1972 refuse more than gfortran does."""
    body = text.strip(" ")
    no_digit = body and not re.match(r"[+-]?[ ]*\.?[ ]*[0-9]", body)
    bare_exponent = re.search(r"[0-9. ](?:[EeDd][+-]?|[+-])$", body)
    return bool(
        no_digit
        or bare_exponent
        or re.search(r"[EeDd+-][ ]*[0-9]*[1-9][0-9]*[ ]", body[1:] + (" " if text[-1] == " " else ""))
    )


CASES = [case for case in _cases() if case[0][0] == "I" or not _lax(case[1])]
KEY = hashlib.sha256(json.dumps([PROGRAM, CASES]).encode()).hexdigest()


@pytest.fixture(scope="module")
def answers(tmp_path_factory):
    """What the FORTRAN reader made of each field: hexadecimal bits, or `error`."""
    kept = json.loads(ANSWERS.read_text()) if ANSWERS.exists() else {}
    if kept.get("key") != KEY:
        if not shutil.which("gfortran"):
            pytest.skip("no gfortran on this machine, and no kept answers for these cards")
        kept = {"key": KEY, "answers": " ".join(_ask_fortran(tmp_path_factory.mktemp("fortran")))}
        ANSWERS.write_text(json.dumps(kept) + "\n")
    return kept["answers"].split(" ")


def _ask_fortran(folder):
    (folder / "reader.f90").write_text(PROGRAM)
    subprocess.run(["gfortran", "-o", "reader", "reader.f90"], cwd=folder, check=True, timeout=120)
    (folder / "cards.txt").write_text("".join(f"{text:80}\n" for _, text in CASES))
    plan = (f"'{format[0]}' '({format})' 1 {len(text)}\n" for format, text in CASES)
    (folder / "plan.txt").write_text("".join(plan))
    subprocess.run(["./reader"], cwd=folder, check=True, timeout=120)
    return (folder / "answers.txt").read_text().split("\n")[:-1]


def _ours(format, text):
    try:
        value = read_field(text, format)
    except FieldError:
        return "error"
    return f"{value & 0xFFFFFFFF:08X}" if format[0] == "I" else struct.pack(">d", value).hex().upper()


def test_every_field_reads_to_the_same_bits(answers):
    assert len(answers) == len(CASES) > 5000
    wrong = [
        (format, text, ours, theirs)
        for (format, text), theirs in zip(CASES, answers, strict=True)
        if (ours := _ours(format, text)) != theirs
    ]
    assert not wrong, f"{len(wrong)} of {len(CASES)}: {wrong[:20]}"


def test_both_readings_and_refusals_are_compared(answers):
    refused = sum(answer == "error" for answer in answers)
    assert 100 < refused < len(answers) / 4
