"""Saturn V of the 1972 report: five frequencies that no bending beam has, and what may be said of the mechanism.

    python -m benchmarks.saturn --vehicles 12 --seed 1     tables
    python -m benchmarks.saturn --decks DIRECTORY          the decks of each vehicle, to try by hand

stack.py      what is known of the vehicle, and what a vehicle is
vehicle.py    vehicles that might have been, bent until they have the frequencies that the report predicted
decks.py      a vehicle as decks: for calibration, with the upper half free, with its stages uncertain
of_1972.py    the loop of 1972, and the test that it did not make
rivals.py     candidates of `mouse diagnose` beside none; what modes 1 to 3 foretell of 4 and 5
tables.py     what is printed, with the figures of the study that these are compared with
"""
