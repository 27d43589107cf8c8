// SPDX-License-Identifier: BSD-3-Clause
// Lines along axis 0 through a layer of cells: where the winding number is not what a sum of signed
// volumes takes it for.
#ifndef RectifiedTransport_SolidLines_h
#define RectifiedTransport_SolidLines_h

#include "Core/Geometry/GridSize.h"
#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/Progress.h"
#include "Core/Solid/SurfaceCuts.h"
#include "Core/Solid/TriangleLayers.h"

#include <cstdint>
#include <memory>

namespace RectifiedTransport
{

// Uninitialised memory that is kept from layer to layer.
template <class T>
class Scratch
{
public:
  void Reserve(std::int64_t count)
  {
    if (count > this->Count)
    {
      this->Memory.reset(new T[static_cast<std::size_t>(count)]);
      this->Count = count;
    }
  }
  T* data() { return this->Memory.get(); }
  const T* data() const { return this->Memory.get(); }

private:
  std::unique_ptr<T[]> Memory;
  std::int64_t Count = 0;
};

// Each cell is crossed by squares^2 lines, through the centres of as many equal squares.
//
// A surface that passes exactly through lines and rows of lines is no special case: the plane of a
// row intersects the surface in closed polygons, whose corners are on the triangles' edges, at
// places that both triangles of an edge compute from the same numbers in the same order. Such a
// polygon crosses every line of the row equally often in both directions, if a corner on the line
// counts as below it, whatever the rounding of the corners.
class SolidLines
{
public:
  // `weights` has one number a triangle, 1, 0 or -1. The layers, weights and points must outlive
  // this object.
  SolidLines(const TriangleSurface& surface, const TriangleLayers& layers,
    const signed char* weights, const GridSize<3>& cells, const LatticePart<3>& part,
    int supersampling);

  // Finds the crossings of all lines of a layer. Does so in part where the run is cancelled.
  void FindCrossings(std::int64_t layer, Progress& progress);
  // Whether lines of a row, counted from the part's first, cross the surface.
  bool HasRow(std::int64_t row) const;
  // Adds to the values of all cells of a row what the lines cover of them where the winding number
  // is not 0, less what the sum of the weighted windings covers: nothing where that is 1 within the
  // solid and 0 without. Returns how many lines leave the solid another number of times than they
  // enter it.
  std::int64_t CorrectRow(std::int64_t row, double* values);

private:
  struct Crossing
  {
    double X;
    std::int32_t Side;     // the change of the winding number, 1 or -1
    std::int32_t Weighted; // that times the triangle's weight
  };

  template <class Visit>
  void ForSegments(std::int64_t layer, Progress& progress, const Visit& visit) const;
  std::int64_t LineOf(std::int64_t j, std::int64_t row) const;
  std::int64_t LineFrom(double coordinate) const;
  bool CorrectLine(Crossing* crossings, std::int64_t count, bool& isCorrected);
  void AddInterval(double begin, double end, int times);
  void WriteCorrection(double* values);

  TriangleSurface Surface;
  const TriangleLayers& Layers;
  const signed char* Weights;
  std::int64_t Columns;
  std::int64_t Squares;
  std::int64_t LinesPerCell;
  std::int64_t FirstLine; // of the part, and past its last
  std::int64_t EndLine;
  std::int64_t Lines; // of a row of the grid
  // Lines of a layer are numbered so that those of a row of cells are contiguous.
  Scratch<std::int64_t> First; // of each line's crossings
  Scratch<Crossing> Crossings;
  Scratch<double> Parts; // sums of the lengths by which cells are corrected in part
  Scratch<int> Whole;    // how often whole cells are, as differences along the row
};

} // namespace RectifiedTransport

#endif
