"""The blind benchmark of `mouse diagnose`: truths by CalculiX, decks without the cause, answers kept apart, tables.

    python -m benchmarks.blind --verify              the truth solver beside closed forms
    python -m benchmarks.blind --config A --seed 1   truths, decks, diagnoses, tables

case.py       what a case is: its cause, its place, the numbers that its truth is made from; how numbers are drawn
calculix.py   runs ccx and reads what it prints; truths are kept in a cache
solids.py     plane-stress meshes of straight beams, with slits, soft parts, masses, springs, tension
beams.py      family of straight beams;  frames.py, chains.py, plate.py: the other structures
test_data.py  sensors and noise of the configurations A, B, D, and noise that the deck misstates
decks.py      a case as a YAML deck, which holds what an engineer would know, and as an answer, which is kept elsewhere
diagnose.py   runs `mouse diagnose` on the decks, and predicts what was held out
scoring.py    confusion, places, reliability, false alarms, gains, times
verify.py     checks of the truth solver on closed forms
"""
