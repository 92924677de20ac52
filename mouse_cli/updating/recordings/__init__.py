"""Output-error estimation by recordings: simulation of short horizons, parameters of the deck and of local laws, validation."""
