# SPDX-License-Identifier: BSD-3-Clause
"""Every filter of the register on small sources, for clients of a server."""
from rt_filters import FILTERS
from rt_proxies import proxies

SHORT = dict(NegativeValues="Clamp", NumberOfSteps=2)
PROPERTIES = {proxy.label: proxy.properties for proxy in proxies()}


def made_filters(simple):
    """Each filter with a proxy of it."""
    def wavelet():
        return simple.Wavelet(WholeExtent=[-4, 4] * 3)

    sources = {"density": wavelet, "densities": lambda: [wavelet(), wavelet()],
               "points": simple.Sphere, "mesh": simple.Sphere, "image": wavelet,
               "solid": simple.Sphere, "disk": simple.Plane,
               "map": lambda: simple.Calculator(Input=simple.Plane(), AttributeType="Cell Data",
                                                ResultArrayName="Mass", Function="3")}
    for filter_ in FILTERS:
        yield filter_, filter_.make(simple, sources, registrationName=filter_.label, **{
            name: value for name, value in SHORT.items() if name in PROPERTIES[filter_.label]})
