"""One file, one kind of measurement: what was measured, and what a model predicts for it."""
