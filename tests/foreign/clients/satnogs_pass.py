"""Tracks one satellite with the tracking worker of satnogs-client, until its standard input ends.

Runs in Debian's Python, where Hamlib's binding is. The rotator is in the client's own environment variables; the first
line of the input is JSON: the station, and the satellite's elements. Of the client only the worker and what it imports
are loaded: the package's own start-up asks a server for work.
"""

import importlib.util
import json
import sys
import types

found = importlib.util.find_spec("satnogsclient")
assert found is not None
assert found.submodule_search_locations is not None
package = types.ModuleType("satnogsclient")
package.__path__ = list(found.submodule_search_locations)
sys.modules["satnogsclient"] = package
worker = importlib.import_module("satnogsclient.observer.worker")

station, satellite = json.loads(sys.stdin.readline())
tracking = worker.WorkerTrack(port=None)
tracking.trackobject(station, satellite)
tracking.trackstart()
sys.stdin.read()
tracking.trackstop()
