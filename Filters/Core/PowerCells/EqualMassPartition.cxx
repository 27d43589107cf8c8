// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PowerCells/EqualMassPartition.h"

#include "Core/Parallel/Progress.h"
#include "Core/PowerCells/RectangleFit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t firstSlice = 1 << 10; // of integrals
constexpr std::int64_t firstAdded = 1 << 15; // of sums of few values
// Of Newton's method; nearly all solutions are better by an order of magnitude or more.
constexpr double solvedTo = 4e-7;
constexpr int mostSteps = 2000; // in one solution
// A density that is partly even, on the way to the given one.
constexpr double nearlySolved = 0.1;
constexpr double smallestDamping = 1e-13;

double squaredDistance(const Point<2>& a, const Point<2>& b)
{
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

} // namespace

EqualMassPartition::EqualMassPartition(RowMoments density, std::int64_t sites)
  : Rows(std::move(density))
  , Cells(Rows.Lengths())
  , Weights(static_cast<std::size_t>(sites), 0.0)
  , SolvedWeights(Weights)
  , Masses(Weights)
  , Places(static_cast<std::size_t>(sites))
  , System(sites)
{
}

bool EqualMassPartition::Solve(ConstPointSpan<2> sites, Progress& progress)
{
  this->Steps = 0;
  this->SetSites(sites, progress);
  this->Rows.SetEvenShare(0.0);
  if (!this->SolveFromHere(progress) && !this->SolveFromEvenDensity(progress))
  {
    return false;
  }
  this->SolvedSites = this->Cells.Sites();
  this->SolvedWeights = this->Weights;
  this->Rows.SetEvenShare(0.0); // what is left of it belongs to the way, not to the moments
  this->IntegrateCells(progress);
  return true;
}

// The weights for new sites at which the potential |x - site|^2 - weight stays as it was at the
// centroids of the cells.
void EqualMassPartition::SetSites(ConstPointSpan<2> sites, Progress& progress)
{
  this->Cells.SetSites(sites, progress);
  this->Weights = this->SolvedWeights;
  for (std::size_t i = 0; i < this->SolvedSites.size(); ++i)
  {
    const Point<2>& centroid = this->Centroid(static_cast<std::int64_t>(i));
    this->Weights[i] += squaredDistance(centroid, this->Cells.Sites()[i]) -
      squaredDistance(centroid, this->SolvedSites[i]);
  }
}

// Weights with which each cell has a part of the domain: none where the domain has all sites. Else
// those with which the cells are the Voronoi cells of c = centre + scale * (site - middle), points
// of the domain: |x - c|^2 / scale and |x - site|^2 - weight differ by the same for all sites.
void EqualMassPartition::FindFirstWeights()
{
  const Point<2> lengths = this->Rows.Lengths();
  const RectangleFit fit(this->Cells.Sites(), lengths);
  std::fill(this->Weights.begin(), this->Weights.end(), 0.0);
  for (std::size_t i = 0;
       i < this->Cells.Sites().size() && !fit.IsInside && std::isfinite(fit.Scale); ++i)
  {
    for (std::size_t a = 0; a < 2; ++a)
    {
      const double from = this->Cells.Sites()[i][a] - fit.Middle[a];
      this->Weights[i] +=
        from * ((1.0 - fit.Scale) * from + 2.0 * (fit.Middle[a] - lengths[a] / 2.0));
    }
  }
}

bool EqualMassPartition::SolveFromHere(Progress& progress)
{
  constexpr double tooLittle = 1e-3;
  if (this->Evaluate(this->Weights, progress).Least < tooLittle)
  {
    this->FindFirstWeights();
    this->Evaluate(this->Weights, progress);
  }
  constexpr double none = 1e-9;
  constexpr int mostShortSteps = 20; // the way from an even density is not as long as more of them
  return this->Found.Least > none && this->Ascend(solvedTo, mostShortSteps, progress);
}

// The cells of an even density have mass with the first weights, and where the even part of a
// density is reduced to a part of it, no mass is reduced to less than that part. So the way from
// the even density to the given one may be gone in steps, which are as long as they succeed.
bool EqualMassPartition::SolveFromEvenDensity(Progress& progress)
{
  constexpr double smallestRatio = 1.001;
  constexpr double largestRatio = 64.0;
  constexpr int mostShortSteps = 500;
  // So little changes no cell's mass by more than a part of the tolerance.
  const double smallest = 0.2 * massTolerance / static_cast<double>(this->Cells.Sites().size());
  this->FindFirstWeights();
  Vector solved;
  double share = 1.0;
  double ratio = 1.0;
  double next = 1.0;
  while (ratio == 1.0 || share > smallest)
  {
    solved = this->Weights;
    this->Rows.SetEvenShare(next);
    const bool isLast = next == smallest;
    if (this->Evaluate(this->Weights, progress).Least > 0.0 &&
      this->Ascend(isLast ? solvedTo : nearlySolved, mostShortSteps, progress))
    {
      share = next;
      ratio = std::clamp(2.0 * ratio, 4.0, largestRatio);
    }
    else
    {
      this->Weights = solved;
      ratio = std::sqrt(ratio);
      if (ratio < smallestRatio || this->Steps >= mostSteps)
      {
        return false;
      }
    }
    next = std::max(share / ratio, smallest);
  }
  return true;
}

template <class Visit>
void EqualMassPartition::VisitCells(Progress& progress, std::int64_t units, const Visit& visit)
{
  progress.ForEach(this->Cells.NumberOfCells(), PowerDiagram::cellsOfChunk, visit, units);
}

EqualMassPartition::Deviation EqualMassPartition::Evaluate(
  const Vector& weights, Progress& progress)
{
  this->Cells.Update(weights.data(), progress);
  this->Sides.resize(static_cast<std::size_t>(this->Cells.NumberOfChunks()));
  this->VisitCells(
    progress, firstSlice, [this](std::int64_t place) { this->IntegrateSides(place); });
  this->VisitCells(progress, firstAdded,
    [this](std::int64_t place) { this->AddSides(this->Cells.SiteAt(place)); });
  double squares = 0.0;
  this->Found = { 0.0, 0.0, std::numeric_limits<double>::infinity() };
  for (const double mass : this->Masses)
  {
    squares += (mass - 1.0) * (mass - 1.0);
    this->Found.Largest = std::max(this->Found.Largest, std::abs(mass - 1.0));
    this->Found.Least = std::min(this->Found.Least, mass);
  }
  this->Found.Norm = std::sqrt(squares);
  return this->Found;
}

// The cells of the diagram are small parts of a table that is larger than the caches.
void EqualMassPartition::PrefetchCell(std::int64_t place) const
{
  const bool isCell = place < this->Cells.NumberOfCells();
  const auto cell = isCell ? this->Cells[this->Cells.SiteAt(place)] : PowerDiagram::Cell();
  if (cell.Count == 0)
  {
    return;
  }
  Point<2> low;
  Point<2> high;
  for (std::size_t a = 0; a < 2; ++a)
  {
    const auto [least, most] = std::minmax_element(cell.First, cell.First + cell.Count,
      [a](const auto& p, const auto& q) { return p.X[a] < q.X[a]; });
    low[a] = least->X[a];
    high[a] = most->X[a];
  }
  this->Rows.Prefetch(low, high);
}

// Of the two cells at a side, the one of the larger site integrates along it.
void EqualMassPartition::IntegrateSides(std::int64_t place)
{
  this->PrefetchCell(place + 1);
  const std::int64_t chunk = place / PowerDiagram::cellsOfChunk;
  std::vector<Side>& sides = this->Sides[static_cast<std::size_t>(chunk)];
  if (place % PowerDiagram::cellsOfChunk == 0)
  {
    sides.clear();
  }
  const std::int64_t site = this->Cells.SiteAt(place);
  this->Places[static_cast<std::size_t>(site)] = { chunk, static_cast<std::int64_t>(sides.size()) };
  const PowerDiagram::Cell cell = this->Cells[site];
  for (std::int64_t k = 0; k < cell.Count; ++k)
  {
    sides.push_back(cell[k].Neighbour < site ? this->Integrate(site, k) : Side());
  }
}

// The derivatives of the mass are the density along the sides over twice the distance of the sites.
EqualMassPartition::Side EqualMassPartition::Integrate(std::int64_t site, std::int64_t k) const
{
  const PowerDiagram::Cell cell = this->Cells[site];
  Side side{};
  const double along = this->Rows.AddSideMass(cell[k].X, cell.After(k).X, side.Mass);
  const std::int64_t j = cell[k].Neighbour;
  if (j >= 0)
  {
    const Point<2>& x = this->Cells.Sites()[static_cast<std::size_t>(site)];
    side.Strength = along /
      (2.0 * std::sqrt(squaredDistance(x, this->Cells.Sites()[static_cast<std::size_t>(j)])));
  }
  return side;
}

void EqualMassPartition::AddSides(std::int64_t site)
{
  const PowerDiagram::Cell cell = this->Cells[site];
  const Side* sides = this->SidesOf(site);
  double mass = 0.0;
  for (std::int64_t k = 0; k < cell.Count; ++k)
  {
    const std::int64_t j = cell[k].Neighbour;
    if (j < site)
    {
      mass += sides[k].Mass;
      continue;
    }
    const PowerDiagram::Cell other = this->Cells[j];
    std::int64_t same = 0;
    while (same < other.Count && other[same].Neighbour != site)
    {
      ++same;
    }
    // Rounding may leave a side of no length to one of the cells only.
    mass += same < other.Count ? -this->SidesOf(j)[same].Mass : this->Integrate(site, k).Mass;
  }
  this->Masses[static_cast<std::size_t>(site)] = mass;
}

const EqualMassPartition::Side* EqualMassPartition::SidesOf(std::int64_t site) const
{
  const Place& place = this->Places[static_cast<std::size_t>(site)];
  return this->Sides[static_cast<std::size_t>(place.Chunk)].data() + place.First;
}

EqualMassPartition::Deviation EqualMassPartition::EvaluateRevived(
  Vector& weights, double least, Progress& progress)
{
  constexpr int mostRounds = 4;          // one cell's gain is another's loss
  constexpr std::int64_t firstPiece = 1; // weights that vary much make some cells slow
  const std::size_t few = weights.size() / 10;
  Deviation found = this->Evaluate(weights, progress);
  for (int round = 0; round < mostRounds && !(found.Least >= least); ++round)
  {
    std::vector<std::size_t> sites;
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      if (!(this->Masses[i] >= least))
      {
        sites.push_back(i);
      }
    }
    if (sites.size() > few)
    {
      break;
    }
    progress.ForEach(
      static_cast<std::int64_t>(sites.size()), 1,
      [&](std::int64_t i) {
        const std::size_t site = sites[static_cast<std::size_t>(i)];
        weights[site] = this->RevivingWeight(static_cast<std::int64_t>(site), weights[site], least);
      },
      firstPiece);
    found = this->Evaluate(weights, progress);
  }
  return found;
}

// A weight with which the cell has at least that mass and at most 1, in the diagram of the last
// evaluation, where it had less.
double EqualMassPartition::RevivingWeight(std::int64_t site, double weight, double least) const
{
  std::vector<PowerDiagram::Corner> corners;
  const auto massWith = [&](double trial) {
    this->Cells.CutCell(site, trial, corners);
    double mass = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k)
    {
      const std::size_t next = k + 1 < corners.size() ? k + 1 : 0;
      this->Rows.AddSideMass(corners[k].X, corners[next].X, mass);
    }
    return mass;
  };
  double low = weight;
  double step = 1e-3; // a length of a thirtieth of the mean spacing
  double high = low + step;
  double mass = massWith(high);
  while (mass < least && std::isfinite(step))
  {
    low = high;
    step *= 8.0;
    high += step;
    mass = massWith(high);
  }
  constexpr int mostTries = 40;
  const double aim = std::sqrt(least);
  double found = high;
  for (int tries = 0; tries < mostTries && !(mass >= least && mass <= 1.0); ++tries)
  {
    (mass > 1.0 ? high : low) = found;
    // In an even density a cell's mass begins like the square of the weight that is added.
    const double part = mass > 1.0 ? std::clamp(std::sqrt(aim / mass), 0.1, 0.9) : 0.5;
    found = low + part * (high - low);
    mass = massWith(found);
  }
  return found;
}

// From weights that were evaluated. A step that ends where the function still rises along it is as
// good as one that brings the masses nearer to 1, and the only kind where parts of the density do
// not touch: their potentials may then be far from each other's. Damping shortens such steps.
bool EqualMassPartition::Ascend(double tolerance, int mostShort, Progress& progress)
{
  constexpr double shortest = 1e-4;
  constexpr double isShort = 0.25;
  constexpr double leastGain = 1e-3;
  constexpr double firstDamping = 1e-7;
  const double floor = 0.5 * std::min(1.0, this->Found.Least);
  Vector trial(this->Weights.size());
  double damping = smallestDamping;
  double firstPart = 1.0;
  double reduction = std::numeric_limits<double>::infinity(); // of the deviation, by the last step
  bool isRetry = false;
  for (int shortSteps = 0; this->Found.Largest > tolerance;)
  {
    if (shortSteps > mostShort || this->Steps >= mostSteps)
    {
      return false;
    }
    ++this->Steps;
    const auto dampMore = [&]() {
      damping = std::max(damping, firstDamping) * 10.0;
      isRetry = true;
      reduction = std::numeric_limits<double>::infinity();
      ++shortSteps;
    };
    // With the matrix of a step that reduced the deviation to a part, another one reduces it to
    // about twice that part: enough for the last step.
    const bool isLast = 2.0 * reduction * this->Found.Largest < tolerance;
    if (!(isLast || this->FactorizeHere(damping, progress)) || !this->FindDirection())
    {
      dampMore();
      continue;
    }
    const Deviation before = this->Found;
    double part = firstPart;
    bool isAccepted = false;
    while (part >= shortest && !isAccepted)
    {
      for (std::size_t i = 0; i < trial.size(); ++i)
      {
        trial[i] = this->Weights[i] + part * this->Direction[i];
      }
      const Deviation now = this->EvaluateRevived(trial, floor, progress);
      isAccepted = now.Least >= floor &&
        (now.Norm < (1.0 - std::max(0.5 * part, leastGain)) * before.Norm ||
          this->Slope(trial) >= 0.0);
      part *= isAccepted ? 1.0 : 0.5;
    }
    if (!isAccepted)
    {
      firstPart = isShort;
      dampMore();
      this->Evaluate(this->Weights, progress);
      continue;
    }
    this->Weights.swap(trial);
    shortSteps += part < isShort ? 1 : 0;
    firstPart = std::min(1.0, 4.0 * part);
    reduction = this->Found.Norm / before.Norm;
    const bool isGood = reduction < 0.25;
    damping = std::max(smallestDamping, damping * (isGood ? 0.01 : isRetry ? 1.0 : 0.1));
    isRetry = false;
  }
  return true;
}

// The derivative of the function in the direction of weights that were evaluated, there.
double EqualMassPartition::Slope(const Vector& weights) const
{
  double slope = 0.0;
  for (std::size_t i = 0; i < this->Masses.size(); ++i)
  {
    slope += (1.0 - this->Masses[i]) * (weights[i] - this->Weights[i]);
  }
  return slope;
}

// Minus the second derivatives are a graph's Laplacian: the sides of the cells with their
// strengths. Weights are determined up to a constant; damping determines it.
bool EqualMassPartition::FactorizeHere(double damping, Progress& progress)
{
  this->System.RemoveEdges();
  for (std::int64_t place = 0; place < this->Cells.NumberOfCells(); ++place)
  {
    const std::int64_t i = this->Cells.SiteAt(place);
    const PowerDiagram::Cell cell = this->Cells[i];
    const Side* sides = this->SidesOf(i);
    for (std::int64_t k = 0; k < cell.Count; ++k)
    {
      const std::int64_t j = cell[k].Neighbour;
      if (j >= 0 && j < i)
      {
        this->System.AddEdge(j, i, sides[k].Strength);
      }
    }
  }
  progress.Check();
  return this->System.Factorize(damping, progress);
}

bool EqualMassPartition::FindDirection()
{
  this->Direction.resize(this->Masses.size());
  std::transform(this->Masses.begin(), this->Masses.end(), this->Direction.begin(),
    [](double mass) { return 1.0 - mass; });
  return this->System.Solve(this->Direction);
}

void EqualMassPartition::IntegrateCells(Progress& progress)
{
  this->Integrated.resize(this->Cells.Sites().size());
  this->VisitCells(progress, firstSlice, [this](std::int64_t place) {
    this->PrefetchCell(place + 1);
    const std::int64_t site = this->Cells.SiteAt(place);
    this->Integrated[static_cast<std::size_t>(site)] = this->IntegrateCell(site);
  });
}

EqualMassPartition::CellIntegrals EqualMassPartition::IntegrateCell(std::int64_t site) const
{
  const PowerDiagram::Cell cell = this->Cells[site];
  Point<2> middle{};
  for (std::int64_t k = 0; k < cell.Count; ++k)
  {
    middle[0] += cell[k].X[0] / static_cast<double>(cell.Count);
    middle[1] += cell[k].X[1] / static_cast<double>(cell.Count);
  }
  const GridSize<2> near = this->Rows.CellAt(middle);
  const Point<2> origin = this->Rows.CornerOf(near);
  PolygonMoments moments;
  for (std::int64_t k = 0; k < cell.Count; ++k)
  {
    this->Rows.AddSide(cell[k].X, cell.After(k).X, near, moments);
  }
  const Point<2> offset = { moments.First[0] / moments.Mass, moments.First[1] / moments.Mass };
  return { moments.Mass, { origin[0] + offset[0], origin[1] + offset[1] },
    moments.MovedBy({ -offset[0], -offset[1] }).Second };
}

double EqualMassPartition::Cost(std::int64_t site) const
{
  const CellIntegrals& cell = this->Integrals(site);
  const Point<2>& x = this->Cells.Sites()[static_cast<std::size_t>(site)];
  return cell.Spread + squaredDistance(cell.Centroid, x) * cell.Mass;
}

} // namespace RectifiedTransport
