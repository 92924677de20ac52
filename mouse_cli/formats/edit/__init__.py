"""FORTRAN edit descriptors: a field of a card to a value and back, as a FORTRAN 66 reader understands it."""

from mouse_cli.formats.edit.descriptor import FieldError
from mouse_cli.formats.edit.reading import Suspicion, clean_reader, field_warnings, read_field, read_fields
from mouse_cli.formats.edit.writing import write_field

__all__ = ["FieldError", "Suspicion", "clean_reader", "field_warnings", "read_field", "read_fields", "write_field"]
