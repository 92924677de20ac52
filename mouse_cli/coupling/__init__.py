"""Structures put together, taken apart and modified (lecture 22 on modal testing): by functions, by modes, by matrices."""

from mouse_cli.coupling.couple import couple
from mouse_cli.coupling.modify import modify

__all__ = ["couple", "modify"]
