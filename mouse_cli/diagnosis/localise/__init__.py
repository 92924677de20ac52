"""Where the model is wrong, before any physics is assumed."""
