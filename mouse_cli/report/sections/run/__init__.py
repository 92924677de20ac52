"""Sections that tell of runs and forecasts."""
