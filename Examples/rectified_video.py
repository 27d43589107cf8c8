# SPDX-License-Identifier: BSD-3-Clause
"""What films share: image series, ParaView's animation, and how steady points are in one."""
import os
import sys

import numpy as np
import rectified_figures as figures
from paraview import simple
from PIL import Image
from vtkmodules.util.numpy_support import vtk_to_numpy


def write_series(folder, name, images):
    """Writes pictures as numbered PNGs. Returns a reader of them as time steps; as it
    is made, it would read one volume of them."""
    os.makedirs(folder, exist_ok=True)
    files = [os.path.join(folder, "%s-%03d.png" % (name, i)) for i in range(len(images))]
    for path, image in zip(files, images):
        figures.save(path, image)
    return simple.PNGSeriesReader(FileNames=files, ReadAsImageStack=0)


def played(view, number, prepare=lambda step: None):
    """Goes from time step to time step as ParaView's play button does; yields each one's number."""
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.PlayMode = "Snap To TimeSteps"
    for i in range(number):
        prepare(i)
        scene.GoToNext() if i else scene.GoToFirst()
        simple.Render(view)
        yield i


def dots(sampler, ids="SeedId"):
    """Where the particles are that were made last, and whose they are; nothing is brought up to
    date."""
    data = sampler.GetClientSideObject().GetOutputDataObject(0)
    if data.GetNumberOfPoints() == 0:
        sys.exit(1)  # the filter has said why
    return (vtk_to_numpy(data.GetPoints().GetData())[:, :2].copy(),
            vtk_to_numpy(data.GetPointData().GetArray(ids)).copy())


def write_film(path, frames, seconds):
    """Writes pictures as a GIF that repeats, with so many seconds a picture."""
    film = [Image.fromarray(np.ascontiguousarray(frame[::-1])) for frame in frames]
    film[0].save(path, save_all=True, append_images=film[1:], loop=0,
                 duration=round(1000 * seconds))


def same(ids):
    """For each pair of frames the row in the second of each point of the first, by numbers that
    points keep; -1 for those that end."""
    rows = []
    for before, after in zip(ids, ids[1:]):
        row = np.full(1 + max(before.max(), after.max()), -1)
        row[after] = np.arange(len(after))
        rows.append(row[before])
    return rows


def nearest(frames, follow):
    """The same by the points nearest to the places follow(i, points) of those of frame i."""
    from scipy.spatial import cKDTree  # only who compares with redrawn points needs it
    return [cKDTree(after).query(follow(i, before))[1]
            for i, (before, after) in enumerate(zip(frames, frames[1:]))]


def paths(frames, successor):
    """Where those points of the first frame go that stay in all of them: rows of frames."""
    followed = [np.arange(len(frames[0]))]
    for row in successor:
        followed.append(np.where(followed[-1] < 0, -1, row[followed[-1]]))
    stay = np.array(followed)[:, followed[-1] >= 0]
    return np.array([points[rows] for points, rows in zip(frames, stay)])


def length(vectors):
    return np.sqrt((vectors ** 2).sum(axis=-1))


def steadiness(frames, successor, follow, size):
    """Means over the points that stay, and whose place in the picture does: how far the picture
    moves there from frame to frame, how far the points move, how far that is off the picture's
    motion, how much the motion of a point changes to the next frame; and the part of new points."""
    picture, moved, off, change, new = [], [], [], [], []
    for i in range(len(frames) - 1):
        two = paths(frames[i:i + 2], successor[i:i + 1])
        places = follow(i, two[0])
        inside = ((places >= 0) & (places <= size)).all(axis=1)
        picture.append(length(places - two[0])[inside])
        moved.append(length(two[1] - two[0])[inside])
        off.append(length(two[1] - places)[inside])
        if i + 2 < len(frames):
            three = paths(frames[i:i + 3], successor[i:i + 2])
            change.append(length(three[0] - 2 * three[1] + three[2]))
        found = np.unique(successor[i])
        new.append(1 - (found >= 0).sum() / len(frames[i + 1]))
    return [np.concatenate(values).mean() for values in (picture, moved, off, change)] + [
        np.mean(new)]
