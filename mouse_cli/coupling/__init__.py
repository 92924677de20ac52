"""Substructuring and structural modification (lecture 22 on modal testing): by FRFs, by modes, by matrices."""

from mouse_cli.coupling.couple import couple
from mouse_cli.coupling.modify import modify

__all__ = ["couple", "modify"]
