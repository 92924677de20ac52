"""One structure tested in several arrangements: causes that all of them share, named one after another."""
