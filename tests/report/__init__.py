"""What is told of a scene and of its run."""
