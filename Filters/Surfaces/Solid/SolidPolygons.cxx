// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Solid/SolidPolygons.h"

#include "Core/Parallel/Stages.h"
#include "Surfaces/Mesh/CutPolygons.h"
#include "Surfaces/Mesh/Repair/TJunctions.h"
#include "Surfaces/Solid/ClosedMesh.h"

#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// A polygon's corners after merging, without repeated neighbours.
PolygonCutter::Corners mergedIn(const ClosedMesh& mesh, const PolygonCutter::Corners& corners)
{
  PolygonCutter::Corners merged;
  for (const std::int64_t given : corners)
  {
    const std::int64_t corner = mesh.FirstOf(given);
    if (merged.empty() || corner != merged.back())
    {
      merged.push_back(corner);
    }
  }
  while (merged.size() > 1 && merged.front() == merged.back())
  {
    merged.pop_back();
  }
  return merged;
}

} // namespace

void addPolygons(const PolygonSource& source, ClosedMesh& mesh, Progress& progress)
{
  mesh.Reserve(source.NumberOfTriangles);
  PolygonCutter cutter(mesh.Points(), roundingOfPoints(mesh.Points()), source.CutRing);
  const auto addMade = [&]() {
    const std::vector<std::int64_t>& made = cutter.Triangles();
    for (std::size_t i = 0; i < made.size(); i += 3)
    {
      mesh.Add({ made[i], made[i + 1], made[i + 2] });
    }
  };
  // Polygons of more than four corners come in a second pass: the cut of a large one may add
  // points.
  bool hasLarge = false;
  const auto addOfSize = [&](bool areLarge, Progress& part) {
    source.Polygons(part, [&, areLarge](std::int64_t, const PolygonCutter::Corners& given) {
      const PolygonCutter::Corners corners = mergedIn(mesh, given);
      const bool isLarge = corners.size() > 4;
      hasLarge = hasLarge || isLarge;
      if (corners.size() > 2 && isLarge == areLarge)
      {
        cutter.CutThin(corners);
        addMade();
      }
    });
  };
  Stages stages(progress, { { "polygons", 1 }, { "large polygons", 1 }, { "strips", 1 } });
  addOfSize(false, stages["polygons"]);
  if (hasLarge)
  {
    addOfSize(true, stages["large polygons"]);
  }
  source.Strips(stages["strips"], [&](std::int64_t, const PolygonCutter::Corners& corners) {
    cutter.CutStrip(corners);
    addMade();
  });
}

} // namespace RectifiedTransport
