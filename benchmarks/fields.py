"""How many fields of cards are read a second."""

import argparse
import time

import numpy as np

from mouse_cli.formats.edit import read_field, read_fields, write_field

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--count", type=int, default=200_000)
count = parser.parse_args().count
rng = np.random.default_rng(1972)
values = rng.standard_normal(count) * 10.0 ** rng.integers(-8, 9, count)
clean = [write_field(float(v), "E14.8") for v in values]
integers = [f"{i:8d}" for i in rng.integers(0, 140, count)]
odd = ["    1.28872+04", "         85000", "85000.        ", "      1. 5D+02", "        - 1.E5"] * (count // 20)


def rate(texts: list[str], format: str) -> float:
    """Fields a second, the best of five, as the reader of a deck takes them in."""
    best = min(_seconds(texts, format) for _ in range(5))
    return len(texts) / best


def _seconds(texts: list[str], format: str) -> float:
    start = time.process_time()
    read_fields(texts, format)
    return time.process_time() - start


assert read_fields(odd, "E14.8").tolist() == [read_field(text, "E14.8") for text in odd]
print(f"E14.8, as printed by a program  {rate(clean, 'E14.8'):12,.0f} fields/s")
print(f"I8                              {rate(integers, 'I8'):12,.0f} fields/s")
print(f"E14.8, blanks, implied points   {rate(odd, 'E14.8'):12,.0f} fields/s")
