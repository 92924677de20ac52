"""What a model is made of, as another process needs it: what it computed when asked is computed there again."""

from dataclasses import fields
from typing import Any, ClassVar


class Given:
    """What is made of `made_of`, in order, or of the fields of a dataclass, whatever else it keeps."""

    made_of: ClassVar[tuple[str, ...]] = ()

    @property
    def given(self) -> tuple[Any, ...]:
        """What it is made of."""
        return tuple(getattr(self, name) for name in self.made_of or [each.name for each in fields(self)])
