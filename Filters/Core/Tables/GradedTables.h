// SPDX-License-Identifier: BSD-3-Clause
// Summed-area tables of a whole density (paper, Section 3.3) at few nodes, for wide boxes.
#ifndef RectifiedTransport_GradedTables_h
#define RectifiedTransport_GradedTables_h

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Tables/Density.h"
#include "Core/Tables/TableView.h"

#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

class Progress;
class Ranks;

// The nodes along one axis of `size` grid cells. They are `stride` cells apart, a power of two, but
// denser towards both faces, because boxes that are cut there are narrow: a cell between nodes is
// one grid cell wide, or at most 1/ratio of its distance from the nearer face.
std::vector<std::int64_t> gradedNodes(std::int64_t size, std::int64_t stride, double ratio);

// In 2D and 3D. One record of doubles a node; see TableView.h for its entries. The sums at the
// nodes are those of whole tables. Boxes at least `ratio` strides wide, or cut at a face, are
// interpolated between them. Built in O(cells), in one pass over the density that also inspects it;
// the same bits for every executor.
template <int Dimension>
class GradedTables
{
public:
  // For a distributed density, every rank sums some layers of the grid and gets the tables of all;
  // collective. Throws InvalidDensity, Cancelled and std::bad_alloc.
  GradedTables(const DensitySource<Dimension>& density, const GridSize<Dimension>& strides,
    double ratio, Progress& progress);

  const TableView<Dimension>& View() const { return this->Tables; }
  const DensitySummary& Summary() const { return this->Found; }
  // The exponent of the power of two that scales the values in the tables.
  int Scaling() const { return this->Exponent; }
  std::int64_t MemorySize() const;

private:
  // Layers of the grid between nodes of the last axis.
  struct Layers
  {
    std::int64_t First;
    std::int64_t End;
  };

  void Allocate(const GridSize<Dimension>& size, const GridSize<Dimension>& strides, double ratio);
  void Add(const DensitySource<Dimension>& density, int scaling, Progress& progress);
  std::int64_t NumberOfLayers() const;
  Layers LayersOf(const Ranks& ranks, int rank) const;
  void AddLayers(const DensityValues& density, const Layers& layers, Progress& progress,
    std::vector<DensitySummary>& found);
  void GatherLayers(const Ranks& ranks, std::vector<DensitySummary>& found);
  void AddLayer(const DensityValues& density, std::int64_t layer, double* row,
    std::vector<std::uint64_t>& words, DensitySummary& found);
  void AddRow(const double* cells, double* record, const double* centres) const;
  void SumNodes(Progress& progress);

  std::vector<std::int64_t> Nodes[Dimension];
  std::vector<std::int32_t> NodeBelow[Dimension];
  std::vector<double> Places[Dimension];
  LargeBuffer<double> Records;
  LargeBuffer<std::uint64_t> Occupied; // one bit a grid cell
  TableView<Dimension> Tables;
  DensitySummary Found;
  int Exponent = 0;
};

} // namespace RectifiedTransport

#endif
