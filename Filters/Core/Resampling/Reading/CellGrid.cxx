// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Resampling/Reading/CellGrid.h"

#include "Core/Geometry/Boxes/SizedGrids.h"
#include "Core/Messages/Failure.h"
#include "Core/Resampling/CellFrame.h"

#include <cstdint>
#include <sstream>

namespace RectifiedTransport
{

namespace
{

std::string describe(const Eigen::Vector3d& x)
{
  std::ostringstream text;
  text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ")";
  return text.str();
}

[[noreturn]] void failNotFinite(const CellSet& set, std::int64_t point)
{
  Eigen::Vector3d x;
  set.Read()->GetPosition(point, x.data());
  fail("Point ", point, " of the ", set.Name, " is at ", describe(x),
    "; the coordinates of all points of cells must be finite");
}

[[noreturn]] void failFlat(const MassCells& mass, const Eigen::Vector3d& sides)
{
  const int dimension = mass.Dimension;
  fail("The input's cells are ",
    dimension == 1          ? "lines that are not on one straight line"
      : mass.AreClosedLines ? "closed lines that lie in no plane"
                            : "faces that lie in no plane",
    ": points are ", sides[2 - dimension], " off, with a longest side of ", sides[2], "; ",
    mass.AreClosedLines ? "they must lie in one plane"
      : dimension == 2
      ? "they must lie in one plane, as a slice does (Sample Surface takes curved "
        "surfaces that are disks)"
      : "they must lie on one, or closed ones in a plane, around regions (Triangle "
        "Strips joins the segments of a slice)");
}

void requireFrame(const CellFrame& frame, const CellSets& sets, const MassCells& mass)
{
  switch (frame.Wrong)
  {
    case CellFrame::Flaw::NotFinite:
      failNotFinite(*sets[frame.Set], frame.Point);
    case CellFrame::Flaw::OnePlace:
      fail("The cells of the input are all at one place; they must have a length, area or volume");
    case CellFrame::Flaw::TooLong:
      fail("The cells of the input reach from ", describe(frame.Box.min()), " to ",
        describe(frame.Box.max()), "; a side must not be past the largest double");
    case CellFrame::Flaw::NotFlat:
      failFlat(mass, frame.Sides);
    case CellFrame::Flaw::None:
      break;
  }
}

} // namespace

ImageGrid gridOfCells(
  const CellSets& sets, const MassCells& mass, int resolution, Progress& progress)
{
  const CellFrame frame = CellFrame::Of(sets, mass, progress);
  requireFrame(frame, sets, mass);
  double box[6];
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    box[2 * a] = frame.Box.min()[a];
    box[2 * a + 1] = frame.Box.max()[a];
  }
  const ImageGrid straight = gridWithResolution(gridOfBox(box), resolution, "DensityResolution");
  return { straight.Extent(), frame.Axes * straight.Origin(), straight.Spacing(), frame.Axes,
    straight.IsOnPoints() };
}

} // namespace RectifiedTransport
