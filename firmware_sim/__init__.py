"""The simulated world the real drivers and the real protocols are run against: boards, chips, motors, rotors.

Knows hardware as the datasheets describe it. Knows nothing of the product: it imports neither `rotator` nor `hw`.
"""
