"""Sections that tell of a comparison of test and model."""
