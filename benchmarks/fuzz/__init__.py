"""Inputs damaged at random, through every command: none may end in a traceback, take long, grow large or write elsewhere."""
