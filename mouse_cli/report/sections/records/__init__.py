"""Sections that tell of diagnoses and updates by recordings."""
