# SPDX-License-Identifier: BSD-3-Clause
"""What TestRanksFiles.py runs on some ranks: filters on images that readers of files give each rank
a part of, or on the source of the files. Writes the outputs' digests and, where a name is given,
the image and the outputs as files of that name.

usage: ranks_files_script.py PATH FOLDER NAME-OR-NONE FILE..."""
import os
import pickle
import sys

from paraview import simple
from ranks_rows import RANK, gathered, give
from rt_testing import load_plugin

EXTENT = [0, 12, 0, 7, 0, 10]  # ParaView reads raw numbers on several ranks from 0 on only
# Appended data are not read where expat refuses what follows the end of the XML.
INLINE = dict(DataMode="Binary")


def source():
    return simple.Wavelet(WholeExtent=EXTENT)


def raw(path):
    reader = simple.ImageReader(FileNames=[path], DataScalarType="float", FileDimensionality=3,
                                DataByteOrder="LittleEndian", ScalarArrayName="RTData")
    if reader.GetProperty("Dimensions"):  # from ParaView 6.1 on
        reader.Dimensions = [last + 1 for last in EXTENT[1::2]]
    else:
        reader.DataExtent = EXTENT
    return reader


READERS = {".pvti": lambda path: simple.XMLPartitionedImageDataReader(FileName=[path]),
           ".vti": lambda path: simple.XMLImageDataReader(FileName=[path]), ".raw": raw,
           ".pvtp": lambda path: simple.XMLPartitionedPolydataReader(FileName=[path])}


def main(path, folder, name, *files):
    load_plugin()
    images = {"source": source()}
    for file in files:
        stem, ending = os.path.splitext(file)
        reader = READERS[ending](os.path.join(folder, file))
        if stem.endswith(("sample", "map")):
            give(file, reader)
        else:
            images[file] = reader
    for what, image in images.items():
        usual = dict(Input=image, NegativeValues="Clamp", NumberOfSteps=8)
        sample = simple.SampleDensity(NumberOfParticles=400, **usual)
        field = simple.TransportMap(**usual)
        give(what + " sample", sample)
        give(what + " map", field)
        if what == "source" and name != "none":
            for kind, output in (("image.pvti", image), ("sample.pvtp", sample),
                                 ("map.pvti", field)):
                simple.SaveData(os.path.join(folder, "%s-%s" % (name, kind)), proxy=output,
                                **INLINE)
            simple.SaveData(os.path.join(folder, name + "-drawing.svg"), proxy=sample)
            cells = simple.PointDatatoCellData(Input=image)
            simple.SaveData(os.path.join(folder, name + "-cells.pvti"), proxy=cells, **INLINE)
    with open("%s.%d" % (path, RANK), "wb") as file:
        pickle.dump(gathered, file)
    print("WROTE", RANK, flush=True)


main(*sys.argv[1:])
