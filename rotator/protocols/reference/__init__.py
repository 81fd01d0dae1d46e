"""The reference pages of the protocols, made from their command tables."""
