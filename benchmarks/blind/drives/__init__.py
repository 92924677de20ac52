"""The blind benchmark of drives: free masses with dry friction, truths located event by event, decks as a newcomer writes them."""
