// SPDX-License-Identifier: BSD-3-Clause
// Where the particles of the pivot, a unit box that holds equally many in each cell of a grid, come
// to in one density (Section 3.4): kept until the density, the grid or the integration changes.
#ifndef RectifiedTransport_LinearizedMap_h
#define RectifiedTransport_LinearizedMap_h

#include "Bridge/Density/ContentHash.h"
#include "Core/Flow/FlowOptions.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>

namespace RectifiedTransport
{

class FlowCache;
class SharedFlow;

// What maps must share to be one particle's ways to several densities.
struct LinearizedMapSettings
{
  std::array<std::int64_t, 3> Grid; // cells along the axes of index space, 1 where there is none
  std::int64_t PerCell;
  FlowOptions Options;

  bool operator==(const LinearizedMapSettings& other) const
  {
    return this->Grid == other.Grid && this->PerCell == other.PerCell &&
      this->Options == other.Options;
  }
};

class LinearizedMap
{
public:
  // Whether it is plainly that of a density. Else the density's content tells.
  bool IsOf(const DensityImage& density, const LinearizedMapSettings& settings) const;
  bool IsOf(
    const ContentHash& content, const ImageGrid& grid, const LinearizedMapSettings& settings) const;

  // Moves the particles to a density of this content; progress then reaches `end`. The tables are
  // built in `tables`. Throws Failure and Cancelled. Returns how many particles ended in an empty
  // cell and were put on the nearest mass.
  std::int64_t Make(DensityImage& density, const LinearizedMapSettings& settings, FlowCache& tables,
    Progress& progress, double end);
  // Of the same density, which may come in another image.
  void Renew(const DensityImage& density) { this->Content.SetTimes(density); }

  // Physical, 3 components; tuples are in the order of PivotLattice. Not to be written to.
  vtkDoubleArray* Positions() const { return this->Kept; }
  // Density times cell measure, summed.
  double TotalMass() const { return this->Mass; }

private:
  template <int D>
  std::int64_t Move(const SharedFlow& flow, Progress& progress, double end);

  ContentHash Content;
  ImageGrid Place; // the content is that of the values alone, the positions are physical
  LinearizedMapSettings Settings{};
  vtkSmartPointer<vtkDoubleArray> Kept;
  double Mass = 0.0;
};

} // namespace RectifiedTransport

#endif
