"""What each kind of data says of a hypothesis: modal, frequency responses, histories, and configurations of one structure."""
