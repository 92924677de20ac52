"""Many decks: jobs from names or a manifest, done by processes, kept as one file each, summed up. See `mouse batch`."""
