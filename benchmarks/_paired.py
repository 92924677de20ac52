"""Two things timed in turn by processor time: a machine that slows down slows both, and what else it does counts little."""

import resource
import statistics
import time
from collections.abc import Callable


def paired(one: Callable[[], object], other: Callable[[], object], rounds: int) -> tuple[float, float, float]:
    """Median seconds of `one` and of `other`, and the median of their ratio, over `rounds` after one warm-up."""
    one(), other()
    pairs = [(seconds(one), seconds(other)) for _ in range(rounds)]
    ratio = statistics.median(a / b for a, b in pairs)
    return statistics.median(a for a, _ in pairs), statistics.median(b for _, b in pairs), ratio


def seconds(action: Callable[[], object]) -> float:
    """Processor time of one call, that of processes which it started and waited for included."""
    start = _spent()
    action()
    return _spent() - start


def _spent() -> float:
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime
