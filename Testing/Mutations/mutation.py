# SPDX-License-Identifier: BSD-3-Clause
"""What a wrong change is.

Each names a file, a piece of text that stands there once, and what is wrong instead: an expression
(E), whole statements (S), or, with MUTANT for the condition that switches it on, any text that has
to compile both ways (T). X replaces text of the plugin's XML, which takes a build of its own. Where
«» stand in the text, only what is between them is replaced.
"""
from collections import namedtuple

Mutation = namedtuple("Mutation", "kind file right wrong")


def E(file, right, wrong):
    return Mutation("E", file, right, wrong)


def S(file, right, wrong):
    return Mutation("S", file, right, wrong)


def T(file, right, wrong):
    return Mutation("T", file, right, wrong)


def X(file, right, wrong):
    return Mutation("X", file, right, wrong)


CORE = "Filters/Core/"
SURFACES = "Filters/Surfaces/"
DEVICES = "Filters/Devices/"
BRIDGE = "Filters/Bridge/"
