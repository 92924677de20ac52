"""Sections that tell of spectra of recordings."""
