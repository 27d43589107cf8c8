// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/SiteCells.h"

#include "Core/Flow/RectifiedFlow.h"
#include "Core/Parallel/Stages.h"
#include "Core/SiteCells/EqualMasses/EqualizeSiteCells.h"
#include "Core/SiteCells/EqualMasses/SplitSharedPixels.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{

template <int Dimension>
SiteCells<Dimension>::SiteCells(
  ConstPointSpan<3> sites, const ImageGrid& grid, const Context& context)
  : Place(grid)
  , Given(static_cast<std::size_t>(sites.size()))
  , Inside(static_cast<std::size_t>(sites.size()))
{
  const GridSize<Dimension> size = grid.Size<Dimension>();
  // Every site needs at least one pixel.
  if (static_cast<double>(sites.size()) > numberOfCells<Dimension>(size))
  {
    throw std::invalid_argument(
      "There are " + std::to_string(sites.size()) + " sites; there must be a pixel for each");
  }
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  const PointSpan<Dimension> inside(this->Inside);
  std::atomic<std::int64_t> outside{ 0 };
  Progress progress(context);
  progress.ForEach(sites.size(), grain, [&](std::int64_t i) {
    std::copy_n(sites[i], 3, this->Given[static_cast<std::size_t>(i)].begin());
    if (!grid.NearestIndex<Dimension>(sites[i], inside[i]))
    {
      ++outside;
    }
  });
  this->Outside = outside;
  this->Density.emplace(size, inside);
}

template <int Dimension>
FlowReport SiteCells<Dimension>::Label(
  std::int64_t* labels, const FlowOptions& options, const Context& context) const
{
  constexpr std::int64_t grain = std::int64_t{ 1 } << 14;
  const SiteDensity<Dimension>& sites = this->Pixels();
  const GridSize<Dimension> size = sites.Size();
  const auto pixels = this->Place.NumberOfCells();
  Progress progress(context);
  Stages stages(
    progress, { { "flow", 3 }, { "map", 90 }, { "labels", 2 }, { "areas", 4 }, { "sites", 1 } });
  FlowReport report;
  if (sites.NumberOfPixels() == 1)
  {
    // One pixel with sites gets all pixels: there is nothing to transport.
    std::fill_n(labels, pixels, std::int64_t{ 0 });
  }
  else
  {
    // The flow from the uniform measure to the density of the sites takes the centre of each pixel
    // to a pixel with sites, its label (paper, Section 4.2).
    const RectifiedFlow<Dimension> flow(sites, stages["flow"]);
    report =
      flow.ForwardToCells(FlowSeeds<Dimension>::Lattice(size), labels, options, stages["map"]);
    stages["labels"].ForEach(
      pixels, grain, [&](std::int64_t pixel) { labels[pixel] = sites.Find(labels[pixel]); });
  }
  // The sides of a pixel in physical space: distances are physical.
  Point<Dimension> spacing = this->Place.template Lengths<Dimension>();
  for (int axis = 0; axis < Dimension; ++axis)
  {
    spacing[axis] /= static_cast<double>(size[axis]);
  }
  // The flow's cells differ from equal ones by the error of its integration; the borders are
  // corrected to one pixel.
  equalizeSiteCells<Dimension>(sites, spacing, labels, stages["areas"]);
  splitSharedPixels<Dimension>(sites, this->Inside, spacing, labels, stages["sites"]);
  return report;
}

template <int Dimension>
std::vector<std::int64_t> labelSiteCells(ConstPointSpan<3> sites, const ImageGrid& grid,
  const FlowOptions& options, const Context& context)
{
  Progress progress(context);
  Stages stages(progress, { { "sites", 2 }, { "labels", 98 } });
  const SiteCells<Dimension> cells(sites, grid, stages["sites"]);
  std::vector<std::int64_t> labels(static_cast<std::size_t>(grid.NumberOfCells()));
  cells.Label(labels.data(), options, stages["labels"]);
  return labels;
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(SiteCells);
RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(labelSiteCells);

} // namespace RectifiedTransport
