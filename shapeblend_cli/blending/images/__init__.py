"""Pictures of pixels between two drawings."""
