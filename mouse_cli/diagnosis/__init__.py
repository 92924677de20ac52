"""From a model and a test that disagree to the missing physics: locate, name, model, validate."""

from mouse_cli.diagnosis.diagnose import diagnose

__all__ = ["diagnose"]
