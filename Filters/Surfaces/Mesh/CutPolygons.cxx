// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Mesh/CutPolygons.h"

#include "Core/Messages/Failure.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <vector>

namespace RectifiedTransport
{

PolygonTriangles cutPolygons(
  const PolygonSource& source, ConstPointSpan<3> points, double rounding, Progress& progress)
{
  PolygonTriangles cut{ LargeBuffer<std::int64_t>(3 * source.NumberOfTriangles),
    LargeBuffer<std::int64_t>(source.NumberOfTriangles) };
  PolygonCutter cutter(points, rounding, source.CutRing);
  std::int64_t* corners = cut.Corners.data();
  std::int64_t* cells = cut.Cells.data();
  const auto append = [&](std::int64_t cell) {
    const std::vector<std::int64_t>& made = cutter.Triangles();
    corners = std::copy(made.begin(), made.end(), corners);
    cells = std::fill_n(cells, made.size() / 3, cell);
  };
  std::int64_t missing = 0;
  std::int64_t firstMissing = 0;
  Stages stages(progress,
    { { "polygons", static_cast<double>(source.NumberOfPolygons) },
      { "strips", static_cast<double>(source.NumberOfStrips) } });
  source.Polygons(
    stages["polygons"], [&](std::int64_t cell, const PolygonCutter::Corners& polygon) {
      if (cutter.Cut(polygon))
      {
        append(cell);
        return;
      }
      // A polygon that cannot be cut lacks all its triangles.
      firstMissing = missing == 0 ? cell : firstMissing;
      missing += static_cast<std::int64_t>(polygon.size()) - 2;
    });
  source.Strips(stages["strips"], [&](std::int64_t number, const PolygonCutter::Corners& strip) {
    cutter.CutStrip(strip);
    append(source.NumberOfPolygons + number);
  });
  if (missing != 0)
  {
    fail("The input surface has polygons that cannot be cut into triangles: ", missing,
      " triangles are missing (the first of polygon ", firstMissing,
      ", counted from 0); polygons must be simple: edges must not cross, and no corner be there "
      "twice");
  }
  return cut;
}

} // namespace RectifiedTransport
