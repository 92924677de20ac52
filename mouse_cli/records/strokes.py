"""Strokes of a hammer in a recording of its force."""

import numpy as np

_LEVEL = 0.2  # of the largest stroke, at which one begins
_CONTACT = 0.01  # of the largest value of a stroke, below which it has ended
_ROOM = 2  # contacts that a force window is long
_NOISE = 4.0  # sd of the force at rest, above which it is a stroke
_CREST = 5.0  # peak of a random excitation, by its rms
_QUIET = 0.05  # of the rms of an excitation, up to which what is read between strokes is noise
_STRUCK, _BESIDE, _WHITE = 5.0, 4, 0.3  # sd from which on a stroke acts; samples on either side of it; correlation of noise at most
_BOUNCE = 0.1  # of the largest value of a stroke: a second contact above it is a double stroke


def strokes(force: np.ndarray, block: int, pretrigger: int) -> tuple[np.ndarray, np.ndarray]:
    """First samples of the blocks of strokes whose whole block was recorded; and whether each is a double stroke.

    A block begins `pretrigger` samples before the force rises above a fifth of its largest value. The next stroke is looked for
    after the end of the block.
    """
    size = np.abs(force - np.median(force))
    level = _LEVEL * size.max()
    above = np.flatnonzero(size > level) if block > pretrigger else []  # a shorter block would end before its stroke
    begin, double, free = [], [], 0
    for at in above:
        first = at - pretrigger
        if at < free or first < 0:
            continue
        if first + block > len(force):
            break
        begin.append(first)
        double.append(_double(size[at : first + block]))
        free = first + block
    return np.array(begin, dtype=int), np.array(double, dtype=bool)


def struck(force: np.ndarray) -> np.ndarray | None:
    """Mask (t,) of when an excitation (t,) acts that is little and white noise most of the time; None: it is no strokes."""
    still = force - np.median(force)
    sd = _at_rest(np.abs(still))
    if not 0 < sd < _QUIET * loud(force):
        return None
    acts = np.convolve(np.abs(still) > _STRUCK * sd, np.ones(2 * _BESIDE + 1), "same") > 0
    quiet = still[~acts]
    white = len(quiet) > len(force) / 2 and abs(quiet[1:] @ quiet[:-1]) < _WHITE * (quiet @ quiet)
    return acts if white else None


def loud(force: np.ndarray) -> float:
    """rms of an excitation (t,); strokes are short, and their rms is no measure of them."""
    return max(float(force.std()), float(np.abs(force - np.median(force)).max()) / _CREST)


def _at_rest(size: np.ndarray) -> float:
    """sd of a force that is normal noise most of the time, by its size (t,) about its median."""
    return 1.4826 * float(np.median(size))


def _double(size: np.ndarray) -> bool:
    """Whether a second contact follows the first."""
    peak = int(np.argmax(size[: max(2, len(size) // 8)]))
    limit = _BOUNCE * size[peak]
    after = size[peak:] < limit
    end = peak + int(np.argmax(after)) if after.any() else len(size)
    return bool((size[end:] > 2 * limit).any())


def contact(force: np.ndarray, begin: np.ndarray, block: int) -> int:
    """Samples from the beginning of a block within which every stroke has ended, with room for as much again."""
    size = np.abs(force - np.median(force))
    least = _NOISE * _at_rest(size)
    longest = 0
    for first in begin:
        own = size[first : first + block]
        peak = int(np.argmax(own))
        over = own[peak:] < max(_CONTACT * own[peak], least)
        end = peak + int(np.argmax(over)) if over.any() else block
        start = int(np.argmax(own > max(_CONTACT * own[peak], least)))
        longest = max(longest, min(start + _ROOM * (end - start), block))
    return longest


def windowed(force: np.ndarray, begin: np.ndarray, block: int, length: int) -> tuple[np.ndarray, float]:
    """The force (t, i) without its offset, 0 from `length` samples after each beginning on, and the share of its power cut off.

    What a force cell reads after the stroke is noise: without it H1 keeps what the stroke alone put in, without bias. A half cosine
    over a quarter of the window more ends it (D. J. Ewins, Modal Testing, 2000, section 3.7).
    """
    fade = max(1, length // 4)
    shape = np.concatenate([np.ones(length), 0.5 * (1 + np.cos(np.pi * np.arange(1, fade + 1) / (fade + 1)))])[:block]
    still = force - np.median(force, axis=0)
    kept, cut, whole = np.zeros_like(still), 0.0, 0.0
    for first in begin:
        own = still[first : first + block]
        kept[first : first + len(shape)] = own[: len(shape)] * shape[:, None]
        after, rest = own[length:], own[-(block // 4) :]
        cut += float((after**2).sum() - len(after) * (rest**2).mean(axis=0).sum())
        whole += float((own**2).sum())
    return kept, max(cut, 0.0) / max(whole, 1e-300)
