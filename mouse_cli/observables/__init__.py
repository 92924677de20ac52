"""One file, one kind of measurement: measured values and their prediction by a model."""
