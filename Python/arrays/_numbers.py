# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of real numbers, some of which may be missing."""
import numpy as np


def numbers_and_gaps(values, name):
    """An array that VTK takes, and where its values are missing; None if nowhere. The array is a
    copy only if the memory's order or the type asks for it."""
    array, gaps = array_and_mask(values)
    if array.dtype.kind == "O":
        gaps = is_missing(array) | (False if gaps is None else gaps)
        array = numbers_of_objects(array, gaps)
    if array.dtype.kind in "SUT":
        array = numbers_of_texts(array, gaps, name)
    if array.dtype.kind not in "biuf":
        raise TypeError("%s has values of type %s; they must be real numbers" % (name, array.dtype))
    if gaps is None or not gaps.any():
        gaps = None
    elif gaps.all():
        raise ValueError("%s has no values: all %d are missing" % (name, gaps.size))
    if array.dtype.kind == "b":
        array = array.view(np.int8)
    elif array.dtype.kind == "f" and array.dtype.itemsize not in (4, 8):
        array = array.astype(np.float32 if array.dtype.itemsize < 4 else np.float64)
    return np.require(array, array.dtype.newbyteorder("="), ["C", "A"]), gaps


def all_numbers(values, name):
    """The same array, if none is missing."""
    array, gaps = numbers_and_gaps(values, name)
    if gaps is not None:
        raise ValueError("%s has missing values, the first at %s; all must be numbers"
                         % (name, place_of(name, np.argwhere(gaps)[0])))
    return array


def array_and_mask(values):
    """An array as numpy has it, and the mask of numpy.ma or of the types of pandas that have one."""
    values = with_masks(values)
    if isinstance(values, np.ma.MaskedArray):
        masked = values.mask is not np.ma.nomask
        return np.ma.getdata(values), np.ma.getmaskarray(values) if masked else None
    if hasattr(values, "isna") and hasattr(values, "to_numpy"):
        types = getattr(values, "dtypes", getattr(values, "dtype", None))
        if not all(isinstance(one, np.dtype) for one in getattr(types, "values", [types])):
            return values.to_numpy(dtype=object), np.asarray(values.isna(), dtype=bool)
    return np.asarray(values), None


def with_masks(values, levels=2):
    """Lists of arrays of numpy.ma as one of them; numpy itself forgets the masks of lists in lists."""
    if not isinstance(values, (list, tuple)) or levels == 0:
        return values
    rows = [with_masks(row, levels - 1) for row in values]
    return np.ma.array(rows) if any(isinstance(row, np.ma.MaskedArray) for row in rows) else values


def is_missing(objects):
    """Which objects are None, numpy's masked or pandas' NA."""
    test = np.frompyfunc(lambda value: value is None or value is np.ma.masked
                         or type(value).__name__ == "NAType", 1, 1)
    return np.asarray(test(objects), dtype=bool)


def numbers_of_objects(objects, gaps):
    """Objects as an array of the type that they need, with zeros in the gaps; as they are if it is
    none of numbers."""
    found = objects[~gaps].tolist()
    try:
        array = np.array(found)
        if array.dtype.kind == "O":  # decimals, fractions, integers of more than 64 bits
            array = array.astype(float)
    except (TypeError, ValueError, OverflowError):
        return objects
    if array.ndim != 1:
        return objects
    made = np.zeros(objects.shape, array.dtype)
    made[~gaps] = array
    return made


def numbers_of_texts(texts, gaps, name):
    """Texts of numbers as such, whole ones with all their digits; with zeros in the gaps."""
    if gaps is not None:
        texts = np.array(texts)
        texts[gaps] = "0"
    for place, text in np.ndenumerate(texts):
        if not is_number(text):
            raise TypeError("%s has values of type %s; they must be real numbers, and %s is %r"
                            % (name, texts.dtype, place_of(name, place), str(text)))
    for kind in (np.int64, np.uint64):
        try:
            return texts.astype(kind)
        except (ValueError, OverflowError):
            pass
    return texts.astype(np.float64)


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return "_" not in str(text)  # float would leave it out


def place_of(name, indices):
    return "%s[%s]" % (name, ", ".join(map(str, indices)))
