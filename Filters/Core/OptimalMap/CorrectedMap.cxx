// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/CorrectedMap.h"

#include "Core/Geometry/LatticePart.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// MassError compares the masses of blocks of 8 cells a side.
constexpr std::int64_t blockSide = 8;

// The images of the parts of a source's cells between nodes: coordinates, interleaved, and a mass
// for each.
template <int Dimension>
struct ImageCloud
{
  LargeBuffer<double> Images; // in the index space of the target
  LargeBuffer<double> Masses; // sum to 1

  PointSpan<Dimension> Points() { return { this->Images.data(), this->Masses.size() }; }
};

// Moves each part of each cell by the map. A first pass counts the parts of rows, so that the
// second one knows where each row begins and rows are independent.
template <int Dimension>
ImageCloud<Dimension> sampleImages(const PointMap<Dimension>& map,
  const SolverSide<Dimension>& source, const SampleFineness& fineness, Progress& progress)
{
  const NodeMap<Dimension>& nodes = map.AtNodes();
  const std::int64_t rows = ImageSamples<Dimension>::NumberOfRows(nodes.Grid);
  std::vector<std::int64_t> begins(static_cast<std::size_t>(rows + 1), 0);
  const std::int64_t grain = std::max<std::int64_t>(1, 256 / nodes.Grid.Cells[0]);
  const std::int64_t firstRows = std::max<std::int64_t>(1, (1 << 15) / nodes.Grid.Cells[0]);
  // Calls visit(row, i, sample, image) for part i of each row; `image` is in cells of the nodes.
  const auto forSamples = [&](std::int64_t units, const auto& visit) {
    progress.For(
      rows, grain,
      [&](std::int64_t first, std::int64_t last) {
        ImageSamples<Dimension> samples(nodes, fineness);
        for (std::int64_t row = first; row < last; ++row)
        {
          std::int64_t i = 0;
          samples.ForRow(row, source.CellsOrNull(),
            [&](const auto& sample, const auto& image) { visit(row, i++, sample, image); });
        }
      },
      units);
  };
  forSamples(firstRows, [&](std::int64_t row, std::int64_t i, const auto&, const auto&) {
    begins[static_cast<std::size_t>(row + 1)] = i + 1;
  });
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  ImageCloud<Dimension> cloud{ LargeBuffer<double>(begins.back() * Dimension),
    LargeBuffer<double>(begins.back()) };
  // Masses of mean 1 a cell become shares of the whole.
  const double share = 1.0 / static_cast<double>(nodes.Grid.NumberOfCells());
  forSamples(firstRows / 16 + 1,
    [&](std::int64_t row, std::int64_t i, const CellSample<Dimension>& sample,
      const Point<Dimension>& atNodes) {
      const std::int64_t place = begins[static_cast<std::size_t>(row)] + i;
      const Point<Dimension> image = map.AtSample(sample, atNodes);
      std::copy(image.begin(), image.end(), cloud.Images.data() + place * Dimension);
      cloud.Masses.data()[place] = share * sample.Mass;
    });
  return cloud;
}

} // namespace

// Corrects the masses of the map at points by MassCorrection: the same moves then apply to any
// image.
template <int Dimension>
CorrectedMap<Dimension>::CorrectedMap(const PotentialSolver<Dimension>& solver, int from,
  const CellDensity<Dimension>& target, const Point<Dimension>& sides, PointImages images,
  Progress& progress)
  : Map(solver, from, target, sides, images, progress)
{
  // Nodes farther apart are content with fewer samples; in the plane, MassError is not.
  const bool areFew = images == PointImages::Interpolated;
  const int cellsANode = areFew ? 2 : 1;
  SampleFineness fineness;
  fineness.Each = fineness.OfLightCells = areFew && Dimension == 3 ? 0.75 : 1.0;
  const SolverSide<Dimension>& source = solver.Side(from);
  fineness = limitFineness(this->Map.AtNodes(), source.CellsOrNull(), fineness, progress);
  ImageCloud<Dimension> cloud = sampleImages(this->Map, source, fineness, progress);
  this->Correction.emplace(
    target, sides, cellsANode, cloud.Points(), cloud.Masses.data(), progress);
  this->MeasureBlocks(target, cloud.Points(), cloud.Masses.data(), progress);
}

// The relative L2 error over blocks: sqrt(sum_b (m_b - w_b)^2 / sum_b w_b^2), with m_b the images'
// mass in block b and w_b the target's. Cells alone would measure the sampling noise.
template <int Dimension>
void CorrectedMap<Dimension>::MeasureBlocks(const CellDensity<Dimension>& target,
  ConstPointSpan<Dimension> images, const double* masses, Progress& progress)
{
  const GridSize<Dimension>& cells = target.Size();
  // The lattice of blocks of blockSide cells; the last ones along an axis may be narrower.
  const auto lattice = LatticePart<Dimension>::WholeOf(cells);
  auto blocks = lattice;
  for (std::int64_t& count : blocks.Cells)
  {
    count = (count + blockSide - 1) / blockSide;
  }
  const auto blockOf = [&](std::int64_t cell) {
    GridSize<Dimension> block = lattice.CellOf(cell);
    for (std::int64_t& place : block)
    {
      place /= blockSide;
    }
    return static_cast<std::size_t>(blocks.NumberOf(block));
  };
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  std::vector<double> wanted(static_cast<std::size_t>(blocks.Count()), 0.0);
  std::vector<double> excess(static_cast<std::size_t>(blocks.Count()), 0.0);
  // In order, so that the sums' bits do not depend on threads.
  progress.ForEachInOrder(target.NumberOfCells(), grain,
    [&](std::int64_t cell) { wanted[blockOf(cell)] += target.Share(cell); });
  progress.ForEachInOrder(images.size(), grain,
    [&](std::int64_t i) { excess[blockOf(target.CellOf(images[i]))] += masses[i]; });
  double squares = 0.0;
  double errors = 0.0;
  for (std::size_t block = 0; block < wanted.size(); ++block)
  {
    const double error = excess[block] - wanted[block];
    squares += wanted[block] * wanted[block];
    errors += error * error;
  }
  this->Error = std::sqrt(errors / squares);
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(CorrectedMap);

} // namespace RectifiedTransport
