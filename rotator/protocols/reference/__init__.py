"""The reference tables of docs/protocols.md, made from the code's own command tables."""
