"""Figures for the README, each from a command anyone can run again."""
