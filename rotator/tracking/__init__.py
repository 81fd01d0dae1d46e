"""Tracks targets of the sky by itself: when, by which way, and with which orders.

Knows orbits, plans and orders. It gives its orders as any link does; the control room decides what moves.
"""
