"""Data only, frozen: the content of a deck and the result of a run. Shapes are checked here and nowhere else."""
