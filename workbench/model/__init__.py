"""What can be stated: laws, references, events, sensing, as expressions and records."""
