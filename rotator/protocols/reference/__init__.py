"""The reference tables of docs/reference/wire.md, made from the code's own command tables."""
