// SPDX-License-Identifier: BSD-3-Clause
// The positions in one density of the particles of the pivot, a unit box with equally many
// particles in each cell of a grid (Section 3.4). They are kept until the density, the grid or the
// integration changes. Each rank has its share of the particles.
#ifndef RectifiedTransport_LinearizedMap_h
#define RectifiedTransport_LinearizedMap_h

#include "Bridge/Density/ContentHash.h"
#include "Bridge/Settings/TableSettings.h"
#include "Core/Flow/FlowOptions.h"
#include "Core/Parallel/RankShare.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>

namespace RectifiedTransport::Bridge
{

class FlowCache;

// What maps to several densities must have in common for their particles to correspond.
struct LinearizedMapSettings
{
  std::array<std::int64_t, 3> Grid; // cells along the axes of index space, 1 beyond its dimension
  std::int64_t PerCell;
  FlowOptions Options;
  TableSetting Tables;
  RankShare Share; // of the numbers of the particles

  bool operator==(const LinearizedMapSettings& other) const
  {
    return this->Grid == other.Grid && this->PerCell == other.PerCell &&
      this->Options == other.Options && this->Tables == other.Tables &&
      this->Share.First == other.Share.First && this->Share.Count == other.Share.Count;
  }
};

class LinearizedMap
{
public:
  // Whether it is the map of a density: only by modification times, or by the density's content.
  bool IsOf(const InputDensity& density, const LinearizedMapSettings& settings) const;
  bool IsOf(
    const ContentHash& content, const ImageGrid& grid, const LinearizedMapSettings& settings) const;

  // Advects the particles to a density. Builds the tables in `tables`. Collective on the ranks of
  // the progress. Throws Failure and Cancelled.
  void Make(InputDensity& density, const LinearizedMapSettings& settings, FlowCache& tables,
    Progress& progress);
  // Takes the times of another image that holds the same density.
  void SetTimes(const InputDensity& density) { this->Content.SetTimes(density); }

  // The share's positions, physical, 3 components, in the order of PivotLattice. Read-only.
  vtkDoubleArray* Positions() const { return this->Kept; }
  // Density times cell measure, summed.
  double TotalMass() const { return this->Mass; }
  // How many of the share's particles ended in an empty cell of the density and were moved to the
  // nearest mass.
  std::int64_t Moved() const { return this->Report.MovedToMass; }
  const FlowReport& Flow() const { return this->Report; } // of this rank

private:
  template <int D>
  void Move(InputDensity& density, FlowCache& tables, Progress& progress);

  ContentHash Content;
  ImageGrid Geometry; // not part of the content, but of the physical positions
  LinearizedMapSettings Settings{ {}, 0, {}, {}, { 0, 1, 0 } };
  vtkSmartPointer<vtkDoubleArray> Kept;
  double Mass = 0.0;
  FlowReport Report;
};

} // namespace RectifiedTransport::Bridge

#endif
