"""The watch over a measured axis formulated anew: one estimator in place of eight windows. Not in the box yet.

`python -m benchmarks.scores --trial` plays the same worlds with it. It takes the place of `motion_watch`,
`driven_watch`, `opening_watch`, `weld_watch`, `seen_run`, `run_on`, `standing` and `observed_motion` once no score, no
test of these watches, no fault of `tests/rotors` and no drill is worse with it.
"""
