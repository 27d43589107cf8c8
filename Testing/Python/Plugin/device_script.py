# SPDX-License-Identifier: BSD-3-Clause
"""What TestDevice.py runs in a pvpython of its own, with and without devices: writes what it finds as
JSON. Arguments: a folder, and a state to load (else the state is saved in the folder)."""
import json
import os
import sys

from rt_filters import with_property
from rt_testing import Listener, digest, load_plugin, output_of

simple = load_plugin()
FOLDER, STATE = sys.argv[1], sys.argv[2:]


def is_driver_loaded():
    """Of pocl; other libraries of ParaView may need OpenCL's loader."""
    with open("/proc/self/maps", encoding="utf-8") as maps:
        return "libpocl" in maps.read()


NAMES = [filter_.name for filter_ in with_property("Device")]


def filters():
    wavelet = simple.Wavelet(WholeExtent=[-12, 12, -10, 10, 0, 0])
    other = simple.Wavelet(WholeExtent=[-12, 12, -10, 10, 0, 0], XFreq=20)
    plane = simple.Plane(XResolution=6, YResolution=5)
    sources = {"density": lambda: wavelet, "Target": lambda: other, "densities": lambda: [wavelet, other],
               "mesh": lambda: plane}
    return {filter_.name: filter_.make(simple, sources, registrationName=filter_.name)
            for filter_ in with_property("Device")}


def names_of(proxy):
    """What the information property has, and what the panel offers."""
    proxy.SMProxy.UpdatePropertyInformation()
    names = proxy.SMProxy.GetProperty("DeviceNames")
    return {"names": [names.GetElement(i) for i in range(names.GetNumberOfElements())],
            "offered": list(proxy.DeviceName.Available)}


def run(proxy):
    """Anew: the hash of the output and the warnings."""
    warnings = Listener(proxy.GetClientSideObject()).warnings
    proxy.GetClientSideObject().Modified()
    hashed = digest(output_of(proxy))
    return hashed, [" ".join(warning.split()) for warning in warnings]


found = {}
if STATE:
    simple.LoadState(STATE[0])
    for name in NAMES:
        proxy = simple.FindSource(name)
        hashed, warnings = run(proxy)
        found[name] = {"digest": hashed, "warnings": warnings, "Device": proxy.Device.GetData(),
                       "DeviceName": proxy.DeviceName.GetData(), **names_of(proxy)}
else:
    found["driver"] = {}
    made = filters()
    for name, proxy in made.items():
        hashed, warnings = run(proxy)
        found[name] = {"cpu": hashed, "cpu warnings": warnings, "cpu names": names_of(proxy)}
    found["driver"]["cpu"] = is_driver_loaded()
    for name, proxy in made.items():
        values = found[name]
        proxy.Device = "OpenCL"
        values["digest"], values["warnings"] = run(proxy)
        values.update(names_of(proxy))
        values["default name"] = proxy.DeviceName.GetData()
        # Not in the list: a part of a name, or the name of a device of another machine.
        proxy.DeviceName = "Another"
        values["unlisted"] = run(proxy)
        values["kept name"] = proxy.DeviceName.GetData()
        proxy.DeviceName = ""
    found["driver"]["opencl"] = is_driver_loaded()
    made[NAMES[0]].DeviceName = "Another"
    simple.SaveState(os.path.join(FOLDER, "device.pvsm"))
with open(os.path.join(FOLDER, "found.json"), "w", encoding="utf-8") as file:
    json.dump(found, file)
sys.stdout.flush()
os._exit(0)
