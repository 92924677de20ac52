"""Many decks: jobs from names or a manifest, run by processes, kept as one file each, summarised. See `mouse batch`."""
