"""Diagnosis by recordings: is the structure linear, where does it depart, which law, how much, and is it true."""
