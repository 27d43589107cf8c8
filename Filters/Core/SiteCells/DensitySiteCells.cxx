// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/DensitySiteCells.h"

#include "Core/Flow/RectifiedFlow.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Stages.h"
#include "Core/SiteCells/EqualMasses/EqualizeSiteMasses.h"
#include "Core/SiteCells/EqualMasses/MergeComponents.h"
#include "Core/SiteCells/EqualMasses/SplitSharedPixels.h"
#include "Core/SiteCells/SiteDensity.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <string>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// A range has so many pixels or sites.
constexpr std::int64_t densityGrain = std::int64_t{ 1 } << 14;

// Scales points from the index space of one grid to that of another one on the same domain.
template <int Dimension>
void rescale(PointSpan<Dimension> points, const GridSize<Dimension>& from,
  const GridSize<Dimension>& to, Progress& progress)
{
  const Point<Dimension> step = latticeStep<Dimension>(from, to);
  progress.ForEach(points.size(), densityGrain, [&](std::int64_t i) {
    double* x = points[i];
    for (int axis = 0; axis < Dimension; ++axis)
    {
      x[axis] = std::min(x[axis] * step[axis], static_cast<double>(to[axis]));
    }
  });
}

// Returns the options with at least as many steps as site cells need. Doubling keeps a user's
// number of steps in proportion.
FlowOptions refined(FlowOptions options)
{
  constexpr int enough = leastStepsOfSiteCells;
  constexpr int mostDoublings = 5;
  options.LeastSteps = std::max(options.LeastSteps, enough);
  for (int i = 0; i < mostDoublings && options.NumberOfSteps > 0 && options.NumberOfSteps < enough;
       ++i)
  {
    options.NumberOfSteps *= 2;
  }
  return options;
}

// Returns the mean of the points of each group.
template <int Dimension>
std::vector<Point<Dimension>> meansOf(
  const SiteGroups& groups, const std::vector<Point<Dimension>>& points)
{
  std::vector<Point<Dimension>> means(static_cast<std::size_t>(groups.NumberOfGroups()));
  for (std::int64_t group = 0; group < groups.NumberOfGroups(); ++group)
  {
    const std::int64_t count = groups.SitesIn(group);
    Point<Dimension>& mean = means[static_cast<std::size_t>(group)];
    mean = {};
    for (std::int64_t i = 0; i < count; ++i)
    {
      for (int axis = 0; axis < Dimension; ++axis)
      {
        mean[axis] += points[static_cast<std::size_t>(groups.Site(group, i))][axis];
      }
    }
    for (double& coordinate : mean)
    {
      coordinate /= static_cast<double>(count);
    }
  }
  return means;
}

// Alternates between equalizing masses and joining specks: moving pixels over borders may cut off
// others.
template <int Dimension>
void equalize(const SiteGroups& groups, const PixelMasses<Dimension>& masses,
  const std::vector<Point<Dimension>>& places, const Point<Dimension>& spacing,
  std::int64_t* labels, Progress& progress)
{
  constexpr int mostRounds = 8;
  Stages stages(progress, { { "specks", 5 }, { "rounds", 30 } });
  // The labels of the flow have isolated pixels, which no border could move.
  mergeComponents<Dimension>(groups, masses, labels, stages["specks"]);
  Rounds rounds(stages["rounds"], 1);
  for (int round = 0; round < mostRounds; ++round)
  {
    Stages steps(rounds.Next(), { { "masses", 9 }, { "specks", 1 } });
    equalizeSiteMasses<Dimension>(groups, masses, places, spacing, labels, steps["masses"]);
    if (round + 1 == mostRounds ||
      mergeComponents<Dimension>(groups, masses, labels, steps["specks"]) == 0)
    {
      return;
    }
  }
}

} // namespace

TooFewPixels::TooFewPixels(std::int64_t sites, std::int64_t pixels)
  : std::invalid_argument("There are " + std::to_string(sites) + " sites and " +
      std::to_string(pixels) + " pixels with mass; there must be one for each")
  , Pixels(pixels)
{
}

template <int Dimension>
DensitySiteCells<Dimension>::DensitySiteCells(ConstPointSpan<3> sites, const ImageGrid& grid,
  const DensitySource<Dimension>& density, double total, const Context& context)
  : Place(grid)
  , Given(static_cast<std::size_t>(sites.size()))
  , Inside(static_cast<std::size_t>(sites.size()))
{
  std::atomic<std::int64_t> outside{ 0 };
  const PointSpan<Dimension> inside(this->Inside);
  Progress progress(context);
  Stages stages(progress, { { "sites", 3 }, { "pixels", 7 } });
  // Sites outside the domain count as the nearest points of its border.
  stages["sites"].ForEach(sites.size(), densityGrain, [&](std::int64_t i) {
    std::copy_n(sites[i], 3, this->Given[static_cast<std::size_t>(i)].begin());
    outside += grid.NearestIndex<Dimension>(sites[i], inside[i]) ? 0 : 1;
  });
  this->Outside = outside;
  // The masses of the pixels, which need not be cells of the density.
  this->Pixels.emplace(density, total, grid.Size<Dimension>(), stages["pixels"]);
  if (sites.size() > this->Pixels->PixelsWithMass())
  {
    throw TooFewPixels(sites.size(), this->Pixels->PixelsWithMass());
  }
}

// Groups are equalized before they are split, because sites of one pixel have no borders between
// them. Empty pixels lose their labels at the end: until then they connect what belongs together.
template <int Dimension>
FlowReport DensitySiteCells<Dimension>::Label(const RectifiedFlow<Dimension>& flow,
  std::int64_t* labels, const FlowOptions& options, const Context& context) const
{
  Progress progress(context);
  FlowReport report;
  if constexpr (Dimension == 1)
  {
    this->LabelIntervals(labels);
    this->Masses().RemoveEmptyPixels(labels, progress);
  }
  else
  {
    Stages stages(
      progress, { { "groups", 950 }, { "masses", 35 }, { "sites", 5 }, { "empty pixels", 10 } });
    const SiteGroups groups = this->LabelGroups(flow, labels, options, stages["groups"], report);
    // The sides of a pixel in physical space: distances are physical, not in pixels.
    Point<Dimension> spacing = this->Place.template Lengths<Dimension>();
    for (int axis = 0; axis < Dimension; ++axis)
    {
      spacing[axis] /= static_cast<double>(this->Masses().Size()[axis]);
    }
    equalize<Dimension>(groups, this->Masses(), meansOf<Dimension>(groups, this->Inside), spacing,
      labels, stages["masses"]);
    splitGroupsByMass<Dimension>(
      groups, this->Masses(), this->Inside, spacing, labels, stages["sites"]);
    this->Masses().RemoveEmptyPixels(labels, stages["empty pixels"]);
  }
  return report;
}

// In 1D, the optimal cells are intervals in the order of the sites. A pixel belongs to the interval
// that contains the middle of its mass.
template <int Dimension>
void DensitySiteCells<Dimension>::LabelIntervals(std::int64_t* labels) const
{
  std::vector<std::int64_t> order(this->Inside.size());
  std::iota(order.begin(), order.end(), std::int64_t{ 0 });
  std::stable_sort(order.begin(), order.end(), [this](std::int64_t a, std::int64_t b) {
    return this->Inside[static_cast<std::size_t>(a)] < this->Inside[static_cast<std::size_t>(b)];
  });
  const PixelMasses<Dimension>& masses = this->Masses();
  const auto sites = static_cast<double>(order.size());
  const auto total = static_cast<double>(masses.Total());
  std::int64_t before = 0;
  for (std::int64_t pixel = 0; pixel < masses.NumberOfPixels(); ++pixel)
  {
    // The middle of the pixel's mass in the cumulative distribution; site k has the interval [k, k
    // + 1) / sites of it.
    const double middle = static_cast<double>(before) + 0.5 * static_cast<double>(masses[pixel]);
    const auto place = static_cast<std::size_t>(std::min(middle / total * sites, sites - 1.0));
    labels[pixel] = order[place];
    before += masses[pixel];
  }
}

// Labels the pixels by groups of sites. The backward flow T^-1 of the density takes pixels and
// sites to the uniform measure; there, a second flow, from the uniform measure to the sites'
// images, takes pixels to sites. Sites that T^-1 takes into the same pixel form a group.
template <int Dimension>
SiteGroups DensitySiteCells<Dimension>::LabelGroups(const RectifiedFlow<Dimension>& flow,
  std::int64_t* labels, const FlowOptions& options, const Context& context,
  FlowReport& report) const
{
  const GridSize<Dimension> size = this->Masses().Size();
  const std::int64_t pixels = this->Masses().NumberOfPixels();
  Progress progress(context);
  Stages stages(progress,
    { { "scales", 2 }, { "sites", 3 }, { "pixels", 15 }, { "positions", 1 }, { "flow", 2 },
      { "labels", 74 }, { "groups", 1 }, { "merge", 2 } });
  std::vector<Point<Dimension>> even(this->Inside); // images of the sites under the backward flow
  rescale<Dimension>(even, size, flow.Size(), stages["scales"]);
  // Both grids have the same domain, so only a scaling is between their index spaces.
  report = flow.Backward(even, even, refined(options), stages["sites"]);
  rescale<Dimension>(even, flow.Size(), size, stages["sites"]);
  // A density with the mass 1 in each image of a site is the target of the second flow.
  // A pixel of the uniform measure holds the images of one group of sites.
  const SiteDensity<Dimension> sites(size, even);
  SiteGroups groups = sites.Groups();
  if (groups.NumberOfGroups() == 1)
  {
    // A single group gets all pixels.
    std::fill_n(labels, pixels, std::int64_t{ 0 });
    return groups;
  }
  {
    // The images of all pixels' centres at the uniform measure, interleaved.
    LargeBuffer<double> memory(pixels * Dimension);
    const PointSpan<Dimension> positions(memory.data(), pixels);
    flow.Backward(
      FlowSeeds<Dimension>::Lattice(size), positions, refined(options), stages["pixels"]);
    rescale<Dimension>(positions, flow.Size(), size, stages["positions"]);
    const RectifiedFlow<Dimension> toSites(sites, stages["flow"]);
    toSites.ForwardToCells(positions, labels, options, stages["labels"]);
  }
  stages["groups"].ForEach(
    pixels, densityGrain, [&](std::int64_t pixel) { labels[pixel] = sites.Find(labels[pixel]); });
  this->MergeGroups(flow, even, groups, labels, options, stages["merge"]);
  return groups;
}

// If the mass of several groups lies in one pixel, only one of them has it. The others join that
// group, and divide its pixels with it.
template <int Dimension>
void DensitySiteCells<Dimension>::MergeGroups(const RectifiedFlow<Dimension>& flow,
  const std::vector<Point<Dimension>>& even, SiteGroups& groups, std::int64_t* labels,
  const FlowOptions& options, const Context& context) const
{
  const PixelMasses<Dimension>& masses = this->Masses();
  const GridSize<Dimension> size = masses.Size();
  Progress progress(context);
  Stages stages(progress, { { "masses", 3 }, { "points", 3 }, { "labels", 4 } });
  // The mass of each group's pixels, in integer units.
  std::vector<std::int64_t> mass(static_cast<std::size_t>(groups.NumberOfGroups()), 0);
  std::int64_t heaviest = 0;
  stages["masses"].ForEachInOrder(masses.NumberOfPixels(), densityGrain, [&](std::int64_t pixel) {
    mass[labels[pixel]] += masses[pixel];
    heaviest = masses[pixel] > masses[heaviest] ? pixel : heaviest;
  });
  // For each group without mass: the point of the density that the flow takes to its sites. The
  // group joins the owner of that point's pixel or, if the owner has no mass either, that of the
  // heaviest pixel.
  std::vector<std::int64_t> without;
  std::vector<Point<Dimension>> points;
  for (std::int64_t group = 0; group < groups.NumberOfGroups(); ++group)
  {
    if (mass[group] == 0)
    {
      without.push_back(group);
      // All sites of a group are in one pixel, so the first one stands for them.
      points.push_back(even[static_cast<std::size_t>(groups.Site(group, 0))]);
    }
  }
  if (without.empty())
  {
    return;
  }
  rescale<Dimension>(points, size, flow.Size(), stages["points"]);
  flow.Forward(points, points, refined(options), stages["points"]);
  rescale<Dimension>(points, flow.Size(), size, stages["points"]);
  std::vector<std::int64_t> joined(mass.size());
  std::iota(joined.begin(), joined.end(), std::int64_t{ 0 });
  for (std::size_t i = 0; i < without.size(); ++i)
  {
    const std::int64_t owner = labels[numberOfCellAt<Dimension>(points[i].data(), size)];
    // The group that each group joins; itself, if it stays.
    joined[without[i]] = mass[owner] > 0 ? owner : labels[heaviest];
  }
  SiteGroups merged;
  std::vector<std::int64_t> number(mass.size(), -1); // new numbers of the groups that stay
  std::int64_t stay = 0;
  for (std::int64_t group = 0; group < groups.NumberOfGroups(); ++group)
  {
    number[group] = joined[group] == group ? stay++ : -1;
  }
  merged.First.assign(static_cast<std::size_t>(stay) + 1, 0);
  for (std::int64_t group = 0; group < groups.NumberOfGroups(); ++group)
  {
    merged.First[number[joined[group]] + 1] += groups.SitesIn(group);
  }
  // Counting sort of the sites by their new groups.
  std::partial_sum(merged.First.begin(), merged.First.end(), merged.First.begin());
  merged.Sites.resize(groups.Sites.size());
  std::vector<std::int64_t> next(merged.First);
  for (std::int64_t group = 0; group < groups.NumberOfGroups(); ++group)
  {
    for (std::int64_t i = 0; i < groups.SitesIn(group); ++i)
    {
      merged.Sites[next[number[joined[group]]]++] = groups.Site(group, i);
    }
  }
  groups = std::move(merged);
  stages["labels"].ForEach(masses.NumberOfPixels(), densityGrain,
    [&](std::int64_t pixel) { labels[pixel] = number[joined[labels[pixel]]]; });
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(DensitySiteCells);

} // namespace RectifiedTransport
