# SPDX-License-Identifier: BSD-3-Clause
"""Stipples a film, an image series that pans and zooms over a photograph, with one dot a seed from
frame to frame as ParaView plays it, and measures how steady the dots are."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
import numpy as np
import rectified_example as example
import rectified_figures as figures
import rectified_print as pages
import rectified_video as video
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkImagingCore import vtkImageReslice

ROOM = 1.25  # the photograph's width over a frame's, in pixels
PAN, NEAR, ZOOM = 0.05, 0.9, 0.1  # of the photograph; how far apart the pixels of a frame are there
DISC = 0.08  # radius of the moving disc, of the frame's width
BANDS = [0, 1, 2, 4, np.inf]  # distances from the disc in radii
LONGEST = 2  # pixels: red in the picture of motion
DETAIL = 3  # times that paths are enlarged


def grey(path, width, height):
    """A photograph's luminance, 0 to 1, at a size: its middle where the aspect is another."""
    values = figures.colours_of(figures.photograph(path)) @ figures.LUMINANCE
    rows, columns = values.shape
    zoom = min(columns / width, rows / height)
    across, up = max(1, round(zoom * width)), max(1, round(zoom * height))
    left, low = (columns - across) // 2, (rows - up) // 2
    middle = figures.image_of(values[low:low + up, left:left + across])
    return figures.image_of(figures.values_of(figures.resized(middle, width, height)))


class Camera:
    """Where the frames of a film that ends as it begins lie in a photograph."""

    def __init__(self, size, number):
        self.size, self.number = np.array(size), number

    def window(self, frame):
        """The middle of a frame in the photograph, and how far apart its pixels are there."""
        angle = 2 * np.pi * frame / self.number
        pan = PAN * np.array([np.cos(angle), np.sin(angle)])
        return ROOM * self.size * (0.5 + pan), NEAR - ZOOM * np.cos(angle)

    def follow(self, frame, points):
        """Where what is at points of a frame is in the next one."""
        (middle, zoom), (after, zoom_after) = self.window(frame), self.window(frame + 1)
        return (middle + zoom * (points - self.size / 2) - after) / zoom_after + self.size / 2

    def picture(self, photograph, frame):
        middle, zoom = self.window(frame)
        reslice = vtkImageReslice()
        reslice.SetInterpolationModeToLinear()
        reslice.SetOutputExtent(0, self.size[0] - 1, 0, self.size[1] - 1, 0, 0)
        reslice.SetOutputSpacing(zoom, zoom, 1)
        reslice.SetOutputOrigin(*(middle + zoom * (0.5 - self.size / 2)), 0)
        return figures.values_of(figures.apply(reslice, photograph))


def film(photographs, camera):
    """The frames of a film, from one photograph to the second, if there is one, and back."""
    frames = []
    for i in range(camera.number):
        part = 0.5 - 0.5 * np.cos(2 * np.pi * i / camera.number) if len(photographs) > 1 else 0
        shown = [camera.picture(photograph, i) for photograph in photographs]
        frames.append(figures.bytes_of((1 - part) * shown[0] + part * shown[-1]))
    return frames


def discs(still, number):
    """A still with a disc that moves over its middle, and the disc's middles."""
    height, width = still.shape
    y, x = np.mgrid[:height, :width] + 0.5
    middles = [(width * (0.3 + 0.4 * i / (number - 1)), height / 2) for i in range(number)]
    return [np.where(np.hypot(x - u, y - v) < DISC * width, 40, still).astype(np.uint8)
            for u, v in middles], np.array(middles)


class Stippling:
    """Sample Density of a series of pictures, in a view."""

    def __init__(self, folder, name, frames, number, panel):
        height, width = frames[0].shape
        self.size, self.number = (width, height), len(frames)
        self.series = video.write_series(folder, name, frames)
        self.sampler = simple.SampleDensity(self.series, InvertDensity=1,
                                            NumberOfParticles=number)
        example.result(self.sampler)
        self.view = example.picture_view([panel, round(panel * height / width)], [1, 1, 1])
        self.shown = simple.Show(self.sampler, self.view, "GeometryRepresentation")
        self.shown.SetRepresentationType("Point Gaussian")
        self.shown.ShaderPreset = "Plain circle"
        example.paint(self.shown, [0, 0, 0])
        simple.Render(self.view)  # the first one sets the camera
        middle = [width / 2 - 0.5, height / 2 - 0.5]
        example.look_down(self.view, middle, height, max(width, height))

    def radius(self):
        """That of the dots, for the frame's amount of ink."""
        data = self.sampler.GetClientSideObject().GetOutputDataObject(0)
        return np.sqrt(data.GetPointData().GetArray("Mass").GetValue(0) / 255 / np.pi)

    def play(self, drawn=False, ids="SeedId", **options):
        """The dots of each frame as ParaView plays the series, whose they are, and pictures."""
        points, numbers, pictures = [], [], []
        for _ in video.played(self.view, self.number, **options):
            found, whose = video.dots(self.sampler, ids)
            points.append(found + 0.5)  # the pixels fill [0, w] x [0, h]
            numbers.append(whose)
            if drawn:
                self.shown.GaussianRadius = self.radius()
                pictures.append(figures.drawn(example.save_picture, self.view))
        return points, numbers, pictures

    def reseed(self, frame):
        """What a program does that stipples each frame by itself."""
        self.sampler.RandomSeed = 1 + frame

    def close(self):
        for proxy in self.view, self.sampler, self.series:
            simple.Delete(proxy)


class CameraSeeds:
    """Seeds that are fixed to the photograph: each frame has those that it shows."""

    def __init__(self, camera, number):
        self.camera, extent = camera, ROOM * camera.size
        zooms = [camera.window(frame)[1] for frame in range(camera.number)]
        shown = np.mean(np.square(zooms)) / ROOM ** 2
        source = simple.UniformSeeds(Bounds=[0, extent[0], 0, extent[1], 0, 0],
                                     NumberOfPoints=round(number / shown))
        self.points = vtk_to_numpy(example.result(source).GetPoints().GetData())[:, :2].copy()
        simple.Delete(source)
        self.source = simple.TrivialProducer()
        self.choose(0)

    def choose(self, frame):
        middle, zoom = self.camera.window(frame)
        places = (self.points - middle) / zoom + self.camera.size / 2
        shown = ((places > 0) & (places < self.camera.size)).all(axis=1)
        data = figures.polydata(places[shown] - 0.5)  # the centre of the first pixel is 0
        array = numpy_to_vtkIdTypeArray(np.flatnonzero(shown), deep=1)
        array.SetName("Seed")
        data.GetPointData().AddArray(array)
        self.source.GetClientSideObject().SetOutput(data)


def compare(stippling, camera):
    """Prints how steady the dots of several seeds are. Returns pictures of the first two, and
    paths."""
    same, ids, pictures = stippling.play(drawn=True)
    sampler, size = stippling.sampler, stippling.size
    seeds = CameraSeeds(camera, len(same[0]))
    sampler.Seeds = seeds.source
    moving, numbers, moving_pictures = stippling.play(drawn=True, ids="Seed", prepare=seeds.choose)
    sampler.Seeds = None
    redrawn = stippling.play(prepare=stippling.reseed)[0]
    sampler.SeedPattern = "Random"
    random = stippling.play(prepare=stippling.reseed)[0]

    cases = {"same seeds": (same, video.same(ids)),
             "seeds moved along": (moving, video.same(numbers)),
             "others each frame": (redrawn, video.nearest(redrawn, camera.follow)),
             "random each frame": (random, video.nearest(random, camera.follow))}
    rows = []
    for words, case in cases.items():
        picture, *found, new = video.steadiness(*case, camera.follow, size)
        rows.append([words, *("%.2f" % value for value in [picture, *found]),
                     "%.1f %%" % (100 * new)])
    figures.table("%d frames of %d x %d pixels, %d dots: pixels a frame"
                  % (camera.number, *size, len(same[0])),
                  ["dots", "picture moves", "dots move", "off the picture's motion",
                   "change of motion", "new dots"], rows)
    some = camera.number // 6 + 2
    return [pictures, moving_pictures], {words: video.paths(case[0][:some], case[1][:some - 1])
                                         for words, case in list(cases.items())[:3]}


def local_edit(stippling, middles):
    """Prints how far dots move where nothing changes, by their distance from a moving disc. Returns
    the frames' dots of the same seeds."""
    radius = DISC * stippling.size[0]
    same, ids, _ = stippling.play()
    redrawn = stippling.play(prepare=stippling.reseed)[0]
    columns = []
    for points, successor in ((same, video.same(ids)),
                              (redrawn, video.nearest(redrawn, lambda _, before: before))):
        steps = [video.paths(points[i:i + 2], successor[i:i + 1]) for i in range(len(middles) - 1)]
        moved = [video.length(after - before) for before, after in steps]
        far = [np.minimum(*(video.length(before - middle) for middle in middles[i:i + 2]))
               for i, (before, _) in enumerate(steps)]
        columns.append((np.concatenate(moved), np.concatenate(far) / radius - 1))
    rows = []
    for low, high in zip(BANDS, BANDS[1:]):
        chosen = [moved[(low < far) & (far <= high)] for moved, far in columns]
        rows.append(["%g to %g radii" % (low, high) if high < np.inf else "more",
                     *("%.3f, %.3f" % (moved.mean(), np.quantile(moved, 0.95)) if len(moved)
                       else "-" for moved in chosen)])
    figures.table("A disc of radius %.0f moves %.1f pixels a frame over a still: how far dots\n"
                  "move, mean and 95 %% below, by their distance from the disc"
                  % (radius, middles[1, 0] - middles[0, 0]),
                  ["distance", "the same seeds", "others each frame, with the nearest"], rows)
    return same


def picture_of_motion(before, after, size, radius, pixels):
    """The dots, from grey where they stay to red where they move LONGEST or more."""
    moved = np.minimum(video.length(after - before) / LONGEST, 1)[:, None]
    colours = (moved * [220, 0, 0] + (1 - moved) * 190).round().astype(np.uint8)
    discs = pages.Discs(size, before, np.full(len(before), radius), colours)
    return pages.pictures(discs, pixels)[0]


def picture_of_paths(paths, size, pixels):
    """The paths of points, rows of frames, in the middle of a picture."""
    frames, number = paths.shape[:2]
    lines = figures.shape(paths.transpose(1, 0, 2).reshape(-1, 2), [frames] * number)
    view = example.picture_view([pixels, round(pixels * size[1] / size[0])], [1, 1, 1])
    shown = simple.Show(example.producer(lines), view, "GeometryRepresentation")
    example.paint(shown, [0, 0, 0])
    example.look_down(view, [side / 2 for side in size], size[1] / DETAIL, max(size))
    return figures.drawn(example.save_picture, view)


def main():
    parser = example.parser(
        __doc__, small="--size 160 --frames 8 --particles 1000 --panel 160",
        photographs=dict(nargs="*", default=[example.PHOTOGRAPH],
                         help="one, or two between which the film fades"),
        frames=example.number(32, "of the film", 4),
        size=example.number(400, "width of a frame in pixels; the height is 3 to 4", 32),
        particles=example.number(6000, "number of dots", 100),
        pictures=example.number(4, "how many frames the picture shows", 2),
        seconds=dict(type=float, default=3, help="of the film (default: %(default)s)"), panel=400)
    arguments = parser.parse_args()
    if not 1 <= len(arguments.photographs) <= 2:
        parser.error("%d photographs are given; it must be one or two" % len(arguments.photographs))
    if not arguments.seconds > 0:
        parser.error("--seconds is %g; it must be more than 0" % arguments.seconds)

    example.load_plugin()
    size = arguments.size, 3 * arguments.size // 4
    camera = Camera(size, arguments.frames)
    photographs = [grey(path, *(round(ROOM * side) for side in size))
                   for path in arguments.photographs]
    frames = film(photographs, camera)
    edits, middles = discs(frames[0], 9)
    path = example.output(arguments, "video-stippling")

    stippling = Stippling(path, "frame", frames, arguments.particles, arguments.panel)
    pictures, paths = compare(stippling, camera)
    stippling.close()
    video.write_film(path + ".gif", [np.concatenate(both, axis=1) for both in zip(*pictures)],
                     arguments.seconds / arguments.frames)

    stippling = Stippling(path, "disc", edits, arguments.particles, arguments.panel)
    dots = local_edit(stippling, middles)
    radius, half = stippling.radius(), len(dots) // 2
    stippling.close()

    chosen = [i * arguments.frames // arguments.pictures for i in range(arguments.pictures)]
    lines = [("paths: " + words, picture_of_paths(path_, size, arguments.panel))
             for words, path_ in paths.items()]
    figures.montage(path + ".png", [
        [("frame %d" % (i + 1), figures.grey(frames[i])) for i in chosen],
        [("same seeds" * (i == 0), pictures[0][i]) for i in chosen],
        [("seeds moved along" * (i == 0), pictures[1][i]) for i in chosen],
        [*lines, ("dots moved by a disc", picture_of_motion(dots[half], dots[half + 1], size, radius,
                                                            arguments.panel))]],
        arguments.panel)
    print("\n%d frames: %s.gif\n%d of them: %s.png\nthe series: %s%sframe-*.png"
          % (arguments.frames, path, len(chosen), path, path, os.sep))


if __name__ == "__main__":
    main()
