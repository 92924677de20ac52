"""Concealed causes in frequency response functions; truths in closed form. `python -m benchmarks.blind_frf` prints the tables."""
