"""Sealed blind trials of `mouse diagnose`: truths without mouse, decks and a seal first, answers next, truths last.

    python -m benchmarks.trials seal --seed 1 --cases 40 --out trial
    python -m benchmarks.trials answer trial
    python -m benchmarks.trials open trial --page trial/page.md

assembly.py, bars.py, plate.py   finite elements in numpy; tests compare them with closed forms and scikit-fem
case.py                          what a structure and a mechanism are
beam.py, frame.py, chain.py      the other structures, and their decks
library.py, outside/             mechanisms that the library has, and physics that it has not
kinds.py, draw.py                all kinds of trials; from a seed to trials
test_data.py                     sensors and noise
seal.py, answer.py               decks and the seal; answers
scoring.py, calibration.py       answers beside truths
page.py                          the page
"""
