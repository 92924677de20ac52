"""The commands of `mouse`; each file holds one, called `command`, and is loaded only when that command is used."""
