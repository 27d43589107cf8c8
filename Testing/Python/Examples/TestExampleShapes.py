# SPDX-License-Identifier: BSD-3-Clause
"""The examples that morph and average shapes: see rt_examples.py."""
import os

import numpy as np
from PIL import Image
from rt_examples import ExampleTest, examples, need_meshes, read, tables
from rt_testing import OUTPUT, SOURCE, main, need_display
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkIOGeometry import vtkSTLWriter


class ExampleShapes(ExampleTest):
    def stages(self, times):
        """What was timed; how long it took is the machine's, but the clock's seconds are there."""
        for row in times:
            self.assertRegex(row[1], r"^\d+\.\d\d$")
        return [row[0] for row in times]

    @need_meshes
    def test_morph_2d(self):
        printed = self.ran("Morph2D")
        times = tables(printed)[0]
        self.assertEqual([row[0] for row in times],
                         ["bunny to camel+dinosaur", "knot to coupling", "bull to rings"])
        self.check_picture("morph-2d.png")

    def test_morph_of_a_shape_into_itself(self):
        """Its ends are alike but for the colour; between them its particles are where it is."""
        self.ran("Morph2D", "spot", "spot")
        drawn = 255 - read(os.path.join(OUTPUT, "morph-2d.png"))[0].mean(axis=2)
        frames = [drawn[10:106, left:left + 96] for left in (10, 116, 222)]
        self.assertTrue(0.1 < (frames[0] > 0.5 * frames[0].max()).mean() < 0.4)
        np.testing.assert_allclose(frames[2] / frames[2].max(), frames[0] / frames[0].max(), atol=0.02)
        self.assertGreater(np.corrcoef(frames[1].ravel(), frames[0].ravel())[0, 1], 0.9)

    @need_meshes
    def test_morph_3d(self):
        printed = self.ran("Morph3D")
        steps = ["the maps, step t = 0", "its surface", "step t = 0.50", "its surface",
                 "step t = 1.00", "its surface"]
        self.assertEqual(
            [self.stages(times) for times in tables(printed)],
            [["solid of spot", "solid of " + other, *steps] for other in ("bunny", "eight")])
        self.check_picture("morph-3d.png")

    def test_morph_of_an_own_surface(self):
        """A cube of separate triangles to itself stays a cube."""
        source = vtkCubeSource()
        triangles = vtkTriangleFilter()
        triangles.SetInputConnection(source.GetOutputPort())
        writer = vtkSTLWriter()
        writer.SetInputConnection(triangles.GetOutputPort())
        writer.SetFileName(os.path.join(OUTPUT, "own.stl"))
        writer.Write()
        self.ran("Morph3D", *[os.path.join(OUTPUT, "own.stl")] * 2)
        drawn = read(os.path.join(OUTPUT, "morph-3d.png"))[0]
        inked = [(drawn[10:130, left:left + 120] < 250).any(axis=2).mean() for left in
                 (10, 140, 270)]
        self.assertGreater(inked[0], 0.3)
        np.testing.assert_allclose(inked, inked[0], rtol=0.02)

    def test_morph_3d_by_both_methods(self):
        """A row for each; by the optimal map a shape stays itself."""
        printed = self.ran("Morph3D", "spot", "spot", "--method", "RectifiedFlow", "Optimal")
        self.assertEqual(len(tables(printed)), 2)
        drawn = read(os.path.join(OUTPUT, "morph-3d.png"))[0]
        self.assertEqual(drawn.shape[0], 2 * (120 + 10 + 26))
        inked = [(drawn[10:130, left:left + 120] < 250).any(axis=2) for left in (10, 140, 270)]
        self.assertTrue(0.1 < inked[0].mean() < 0.9)
        for frame, most in zip(inked[1:], (0.04, 0.01)):  # the ends are the shape, the middle is splatted
            self.assertLess((frame != inked[0]).mean(), most)

    def test_not_a_surface(self):
        for name, text in (("broken.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
                           ("binary.off", "OFF BINARY\n3 1 0\n"), ("broken.stl", "solid\n")):
            path = os.path.join(OUTPUT, name)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            printed = self.refused("Morph3D", path, "spot")
            self.assertIn(path + " holds no ", printed)
        printed = self.refused("Barycenters3D", "spot", "brain", "knot")
        self.assertIn("the shapes with names are armadillo, bear", printed)

    @need_meshes
    def test_an_open_surface(self):
        """The filter's error is printed, and no picture is left."""
        drawn = os.path.join(OUTPUT, "morph-3d.png")
        if os.path.exists(drawn):
            os.remove(drawn)
        mesh = os.path.join(SOURCE, "build-meshes", "lion-head.off")
        printed = self.refused("Morph3D", mesh, "spot")
        self.assertIn("The input surface is not closed: it has ", printed)
        self.assertIn("every edge must be one of two triangles, or of another even number", printed)
        self.assertFalse(os.path.exists(drawn))

    def test_number_of_shapes(self):
        found = examples("shapes.names(")
        self.assertGreaterEqual(len(found), 5)
        for example in found:
            printed = self.refused(example, "spot")
            self.assertIn("1 shapes are given; it must be", printed)

    @need_meshes
    def test_morph_animation(self):
        """The cross-fade's middle is the mean of its ends; the morph's is not, for mass moves."""
        self.ran("MorphAnimation")
        with Image.open(os.path.join(OUTPUT, "morph-animation.gif")) as film:
            self.assertEqual((film.n_frames, film.info["duration"], film.info["loop"]), (8, 250, 0))
        drawn = read(os.path.join(OUTPUT, "morph-animation.png"))[0]
        for low, fades in (10, True), (166, False):
            start, middle, end = (drawn[low:low + 120, left:left + 120]
                                  for left in (10, 140, 270))
            difference = np.abs(middle - (start + end) / 2)
            self.assertEqual((difference > 12).mean() < 0.01, fades)
        self.check_picture("morph-animation.png")

    @need_meshes
    def test_barycenters_2d(self):
        self.ran("Barycenters2D")
        self.check_picture("barycenters-2d.png")

    @need_meshes
    def test_barycenters_3d(self):
        printed = self.ran("Barycenters3D")
        self.assertEqual(self.stages(tables(printed)[0]),
                         ["three solids", "three maps, the first barycenter and surface",
                          "another barycenter and surface"])
        self.check_picture("barycenters-3d.png")


if __name__ == "__main__":
    need_display()
    main()
