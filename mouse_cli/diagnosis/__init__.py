"""From a model and a test that do not agree to what the model left out: locate, name, model, prove."""

from mouse_cli.diagnosis.diagnose import diagnose

__all__ = ["diagnose"]
