// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Seams/SurfaceParts.h"

#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/DisjointSets.h"
#include "Surfaces/Mesh/SurfaceEdges.h"
#include "Surfaces/Mesh/SurfaceOrientation.h"
#include "Surfaces/Seams/SeamMesh.h"

#include <algorithm>
#include <numeric>

namespace RectifiedTransport
{

SurfaceParts::SurfaceParts(const TriangleSurface& surface, const Context& context)
  : Points(3 * surface.NumberOfTriangles)
{
  const std::int64_t sides = this->Points.size();
  Progress progress(context);
  Stages stages(
    progress, { { "edges", 3 }, { "points", 2 }, { "edges of parts", 3 }, { "components", 2 } });
  {
    const SurfaceEdges edges(surface, stages["edges"]);
    this->Parted = edges.NonManifold();
    LargeBuffer<std::int64_t> trees(sides);
    std::iota(trees.data(), trees.data() + sides, std::int64_t{ 0 });
    // Corners are joined across edges of two triangles only (Other() is -1 at others). Each tree of
    // corners is one fan, and becomes a point: the surface parts where fans meet.
    Progress& points = stages["points"].Expect(2 * sides);
    for (std::int64_t side = 0; side < sides; ++side)
    {
      if (edges.Other(side) > side)
      {
        joinCorners(surface.Triangles, side, edges.Other(side),
          [&](std::int64_t a, std::int64_t b) { uniteSets(trees.data(), a, b); });
      }
      points.Add(1);
    }
    for (std::int64_t side = 0; side < sides; ++side)
    {
      const std::int64_t root = rootOf(trees.data(), side); // the lowest corner
      this->Points.data()[side] = root == side ? this->Count++ : this->Points.data()[root];
      points.Add(1);
    }
  }
  // The points of parts are other ones than before, so that some triangles at an edge that was
  // parted may still share both of its points. Pairs of these are found by the edges of the parted
  // surface.
  LargeBuffer<double> places(3 * this->Count);
  progress.Check();
  for (std::int64_t side = 0; side < sides; ++side)
  {
    std::copy_n(
      surface.Points[surface.Triangles[side]], 3, places.data() + 3 * this->Points.data()[side]);
  }
  progress.Check();
  const TriangleSurface parted{ { places.data(), this->Count }, this->Points.data(),
    surface.NumberOfTriangles };
  const SurfaceEdges edges(parted, stages["edges of parts"]);
  LargeBuffer<signed char> signs(surface.NumberOfTriangles);
  Progress& components = stages["components"].Expect(surface.NumberOfTriangles);
  visitPatches(parted, edges, signs.data(), components, [this](const SurfacePatch& patch) {
    this->Triangles.emplace_back(patch.Triangles, patch.Triangles + patch.Count);
    std::sort(this->Triangles.back().begin(), this->Triangles.back().end());
  });
}

} // namespace RectifiedTransport
