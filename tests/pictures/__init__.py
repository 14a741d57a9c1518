"""Pictures of results, histories and scenes."""
