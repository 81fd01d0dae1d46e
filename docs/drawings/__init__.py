"""The wiring pictures of the documents, as source: parts with named pins, and the wires between them.

`python -m docs.drawings` writes docs/img/wiring-*.svg. A drawing says what is connected with what; where a wire runs is
found by `route`, how it looks is `svg`'s. GPIO numbers come from the shipped configurations, never from a copy here.
"""
