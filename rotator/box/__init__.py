"""The whole box: built from its parts, started, and stopped in a safe order."""
