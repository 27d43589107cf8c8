# SPDX-License-Identifier: BSD-3-Clause
"""Filters with properties by name, whose errors are exceptions and whose warnings are Python's."""
import re
import sys
import warnings

import numpy as np
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.vtkConstants import VTK_STRING

PACKAGE = __name__.partition(".")[0]


def setters_of(kind):
    """The names of the properties that the project's classes give to a class of filters."""
    own = [vars(base) for base in kind.__mro__ if base.__module__.startswith(PACKAGE)]
    names = {name[3:] for members in own for name in members if name.startswith("Set")}
    return {name for name in names if any("Get" + name in members for members in own)}


def set_property(algorithm, name, value):
    """Sets a property; a text is one of an enumeration's, as in SetMethodToOptimal, or a name."""
    start = "Set%sTo" % name
    choices = sorted(member[len(start):] for member in dir(algorithm) if member.startswith(start))
    if isinstance(value, str) and choices:
        if value not in choices:
            raise ValueError("%s is %r; it must be %s or %s"
                             % (name, value, ", ".join(choices[:-1]), choices[-1]))
        getattr(algorithm, start + value)()
        return
    if isinstance(value, (bool, np.bool_)):
        value = int(value)
    several = not isinstance(value, str) and np.ndim(value) > 0
    getattr(algorithm, "Set" + name)(*value if several else [value])


def set_properties(algorithm, own, given, kind=None):
    """Sets the properties that a function chooses, and those that its caller gives."""
    known = setters_of(kind or type(algorithm))
    for name in given:
        if name in own:
            raise TypeError("%s is set by the function itself" % name)
        if name not in known:
            raise TypeError("%s has no property %r; it has %s"
                            % (type(algorithm).__name__, name, ", ".join(sorted(known - set(own)))))
    for name, value in {**own, **given}.items():
        set_property(algorithm, name, value)


def text_of(message):
    """What the filter says, without the place in its source and its address."""
    return re.sub(r"^\w+: In .*?, line \d+\n.*? \(0x[0-9a-f]+\): ", "", message, count=1,
                  flags=re.DOTALL).strip()


def with_place(text, shapes):
    """The text, with the indices of the value whose number it gives; shapes are those of the arrays
    that it may name."""
    number = re.search(r"at index (\d+)", text)
    for name, shape in shapes.items():
        if number and "'%s'" % name in text and int(number[1]) < np.prod(shape):
            place = np.unravel_index(int(number[1]), shape)
            return "%s: %s[%s]" % (text, name, ", ".join(map(str, place)))
    return text


def calling_level():
    """How many frames the caller of the package is above the caller of this function."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back and frame.f_globals.get("__name__", "").startswith(PACKAGE + "."):
        level, frame = level + 1, frame.f_back
    return level


def kept_messages(algorithm, event):
    """A list that gets the messages of an event; they are then not shown."""
    messages = []

    @calldata_type(VTK_STRING)
    def keep(_source, _event, message):
        messages.append(message)

    # The executive adds a line that a request failed.
    for source in (algorithm, algorithm.GetExecutive()):
        source.AddObserver(event, keep)
    return messages


def update(algorithm, shapes, expected=None):
    """Runs a filter. Raises its error: MemoryError, else ValueError; issues its warnings, but for an
    expected one that begins so."""
    errors = kept_messages(algorithm, "ErrorEvent")
    said = kept_messages(algorithm, "WarningEvent")
    done = algorithm.GetExecutive().Update()
    for text in map(text_of, said):
        if expected is None or not text.startswith(expected):
            warnings.warn(with_place(text, shapes), RuntimeWarning, calling_level())
    if errors:
        text = with_place(text_of(errors[0]), shapes)
        raise (MemoryError if text.startswith("Not enough memory") else ValueError)(text)
    if not done or algorithm.HasFailed():
        raise ValueError("%s failed; vtkObject.GlobalWarningDisplayOn() lets it say why"
                         % type(algorithm).__name__)
