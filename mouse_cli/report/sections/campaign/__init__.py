"""Sections that tell of sweeps and bootstraps."""
