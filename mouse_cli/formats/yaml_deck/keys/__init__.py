"""Every key of a deck, once, as data; one module = one part of a deck, found by `schema.SECTIONS`."""
