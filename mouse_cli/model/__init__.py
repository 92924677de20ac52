"""Data only, frozen: what a deck says and what a run found. Shapes are checked here and nowhere else."""
