// SPDX-License-Identifier: BSD-3-Clause
// Lines along axis 0 through a layer of cells. They find where the winding number differs from what
// a sum of signed volumes assumes.
#ifndef RectifiedTransport_SolidLines_h
#define RectifiedTransport_SolidLines_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Geometry/Points.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"
#include "Surfaces/Solid/SurfaceCuts.h"
#include "Surfaces/Solid/TriangleLayers.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace RectifiedTransport
{

// The lengths that lines count and cover in the cells of a row.
class RowLengths
{
public:
  explicit RowLengths(std::int64_t columns);

  std::int64_t Columns() const { return static_cast<std::int64_t>(this->Parts.size()); }
  void Clear();
  // Adds an interval of a line that is counted `counted` times, and covered or not.
  void Add(double begin, double end, std::int64_t counted, bool isCovered);
  // As SolidLines::CorrectRow.
  void Correct(std::int64_t lines, double* values) const;

private:
  struct Lengths
  {
    double Counted;
    double Covered;
  };
  struct Counts
  {
    std::int64_t Counted;
    std::int64_t Covered;
  };

  std::vector<Lengths> Parts; // lengths in cells that an interval has a part of
  std::vector<Counts> Whole;  // counts of whole cells, as differences along the row
};

// Each cell is crossed by squares^2 lines, through the centres of as many equal squares.
//
// A surface that passes exactly through lines and rows of lines is no special case. The plane of a
// row intersects the surface in closed polygons. Their corners are on the triangles' edges; both
// triangles of an edge compute them from the same numbers in the same order. If a corner on a line
// counts as below it, such a polygon crosses every line of the row equally often in both
// directions, whatever the rounding of the corners.
class SolidLines
{
public:
  // `weights` has one number a triangle, 1, 0 or -1. The layers, weights and points must outlive
  // this object.
  SolidLines(const TriangleSurface& surface, const TriangleLayers& layers,
    const signed char* weights, const GridSize<3>& cells, const LatticePart<3>& part,
    int supersampling);

  // Finds the crossings of all lines of a layer; incomplete if the run is cancelled.
  void FindCrossings(std::int64_t layer, Progress& progress);
  // Whether lines of a row, counted from the part's first row, cross the surface.
  bool HasRow(std::int64_t row) const;
  // Corrects the values of all cells of a row, which count each place as often as the weighted
  // windings. Nothing changes if these are 1 within the solid and 0 outside. If lines count too
  // much, a value is multiplied by the share of it that they cover, so that no part of a solid is
  // lost between lines. What they cover beyond what they count is added. Returns how many lines do
  // not leave the solid as often as they enter it.
  std::int64_t CorrectRow(std::int64_t row, double* values);

  // For surfaces with holes: writes the share of each cell of a row that is inside along its lines.
  // `winding` is that of a place, in cells. It jumps at the crossings; between them it
  // is asked every few cells, and where it passes a half, in between.
  void CoverRow(std::int64_t layer, std::int64_t row,
    const std::function<double(const Point<3>&)>& winding, double* values);

private:
  struct Crossing
  {
    double X;              // place along axis 0, in cells
    std::int32_t Side;     // the change of the winding number, 1 or -1
    std::int32_t Weighted; // that times the triangle's weight
  };

  template <class Visit>
  void ForSegments(std::int64_t layer, Progress& progress, const Visit& visit) const;
  std::int64_t LineOf(std::int64_t j, std::int64_t row) const;
  std::int64_t LineFrom(double coordinate) const;
  void SortCrossings(std::int64_t line);
  void CoverInterval(double from, double to, const std::function<bool(double)>& isInside);
  template <class Visit>
  std::int64_t ForIntervals(std::int64_t line, const Visit& visit) const;

  TriangleSurface Surface;
  const TriangleLayers& Layers;
  const signed char* Weights; // by triangles: 1, 0 or -1
  std::int64_t Squares;       // squares along an axis of a cell
  std::int64_t LinesPerCell;
  std::int64_t FirstLine; // the part's lines along axis 1: the first, and past its last
  std::int64_t EndLine;
  std::int64_t Lines; // lines along axis 1 of the grid
  // Lines of a layer are numbered so that those of a row of cells are contiguous.
  LargeBuffer<std::int64_t> First; // where each line's crossings begin
  LargeBuffer<Crossing> Crossings; // memory that is kept from layer to layer
  RowLengths OfRow;
};

} // namespace RectifiedTransport

#endif
