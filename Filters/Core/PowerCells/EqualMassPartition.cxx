// SPDX-License-Identifier: BSD-3-Clause
#include "Core/PowerCells/EqualMassPartition.h"

#include "Core/Geometry/Vectors.h"
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

constexpr std::int64_t partitionSlice = 1 << 10; // cells integrated before the first poll
constexpr std::int64_t firstAdded = 1 << 15;     // cells whose few side masses are added before it
// The tolerance of Newton's method. Nearly all solutions are better by an order of magnitude or
// more, since the last step converges quadratically. It is below massTolerance.
constexpr double solvedTo = 4e-7;
constexpr int mostSteps = 2000;      // in one solution
constexpr double nearlySolved = 0.1; // the tolerance for densities that are partly even
// The least damping, relative to the mean of the diagonal: it only fixes the additive constant of
// the weights, and hardly changes the step.
constexpr double smallestDamping = 1e-13;

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

// Sets the weights for new sites so that the potential |x - site|^2 - weight is unchanged at the
// centroids of the previous cells: weight += |c - new|^2 - |c - old|^2.
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

// Finds weights with which each cell has a part of the domain. If all sites are in the domain,
// these are zeros (the Voronoi diagram). Otherwise the cells become the Voronoi cells of the points
// c = centre + scale * (site - middle), which are in the domain: |x - c|^2 / scale and |x - site|^2
// - weight differ by the same function of x for all sites.
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
  constexpr double tooLittle = 1e-3; // masses below it end the warm start
  if (this->Evaluate(this->Weights, progress).Least < tooLittle)
  {
    this->FindFirstWeights();
    this->Evaluate(this->Weights, progress);
  }
  constexpr double none = 1e-9;      // Newton's method needs more in each cell
  constexpr int mostShortSteps = 20; // the way from an even density is not as long as more of them
  return this->Found.Least > none && this->Ascend(solvedTo, mostShortSteps, progress);
}

// Continuation from the even density. Its cells have mass with the first weights. If the even share
// falls from s to s', the mass of each cell is at least s' / s of what it was, so that Newton's
// method can begin there.
bool EqualMassPartition::SolveFromEvenDensity(Progress& progress)
{
  constexpr double smallestRatio = 1.001; // least s / s' of a step; below it the method fails
  constexpr double largestRatio = 64.0;
  constexpr int mostShortSteps = 500;
  // An even share this small changes no cell's mass by more than a fifth of the tolerance.
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
      ratio = std::sqrt(ratio); // halves the step of log(share)
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

// Computes the diagram for the weights and the masses of its cells: the sides' parts by the
// divergence theorem, then their sums around each cell.
EqualMassPartition::Deviation EqualMassPartition::Evaluate(
  const Vector& weights, Progress& progress)
{
  this->Cells.Update(weights.data(), progress);
  this->Sides.resize(static_cast<std::size_t>(this->Cells.NumberOfChunks()));
  this->VisitCells(
    progress, partitionSlice, [this](std::int64_t place) { this->IntegrateSides(place); });
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

// Cells are small parts of a table that is larger than the caches, so the next one is prefetched.
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

// Two cells share each side; the cell of the larger site integrates along it, for both.
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
  // Sides are stored by chunks of cells in the diagram's order, which is the order in which they
  // are computed.
  this->Places[static_cast<std::size_t>(site)] = { chunk, static_cast<std::int64_t>(sides.size()) };
  const PowerDiagram::Cell cell = this->Cells[site];
  for (std::int64_t k = 0; k < cell.Count; ++k)
  {
    sides.push_back(cell[k].Neighbour < site ? this->Integrate(site, k) : Side());
  }
}

// The derivative of cell i's mass by the weight of j is -(integral of the density along their
// common side) / (2 |x_i - x_j|): the bisector moves by 1 / (2 |x_i - x_j|) a unit of the weight.
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

// Adds up the mass of a cell. A side's part has the opposite sign for the other cell.
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
    // Rounding may leave a side without length to only one of the cells.
    mass += same < other.Count ? -this->SidesOf(j)[same].Mass : this->Integrate(site, k).Mass;
  }
  this->Masses[static_cast<std::size_t>(site)] = mass;
}

const EqualMassPartition::Side* EqualMassPartition::SidesOf(std::int64_t site) const
{
  const Place& place = this->Places[static_cast<std::size_t>(site)];
  return this->Sides[static_cast<std::size_t>(place.Chunk)].data() + place.First;
}

// Evaluates the weights. If at most a tenth of the cells have too little mass, raises their
// weights, which also raises the concave function, and evaluates again.
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

// Returns a weight with which a cell that had less mass than `least` has `least` to 1; others stay.
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
  double step = 1e-3; // about a thirtieth of the mean spacing, as a length
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
  const double aim = std::sqrt(least); // the geometric mean of the bounds `least` and 1
  double found = high;
  for (int tries = 0; tries < mostTries && !(mass >= least && mass <= 1.0); ++tries)
  {
    (mass > 1.0 ? high : low) = found;
    // In an even density, the mass grows at first like the square of the added weight.
    const double part = mass > 1.0 ? std::clamp(std::sqrt(aim / mass), 0.1, 0.9) : 0.5;
    found = low + part * (high - low);
    mass = massWith(found);
  }
  return found;
}

// Newton's method, from weights that were evaluated, for the concave dual function F(w) = sum over
// cells of (integral of (|x - site_i|^2 - w_i) over cell i) + sum of w_i, with the gradient 1 -
// mass_i. A step is accepted if it reduces the residual |1 - mass|, or if F still rises along it at
// its end. The second kind is the only one if parts of the density do not touch, since their
// potentials may differ by a lot.
bool EqualMassPartition::Ascend(double tolerance, int mostShort, Progress& progress)
{
  constexpr double shortest = 1e-4; // the least part of a Newton step that is tried
  constexpr double isShort = 0.25;
  constexpr double leastGain = 1e-3; // the residual's least relative reduction by a step
  constexpr double firstDamping = 1e-7;
  // Kitagawa, Merigot and Thibert keep every cell's mass above half of the least initial mass: then
  // the Hessian has no zero mode except constants, and the damped method converges.
  const double floor = 0.5 * std::min(1.0, this->Found.Least);
  Vector trial(this->Weights.size());
  double damping = smallestDamping;
  double firstPart = 1.0;
  double reduction = std::numeric_limits<double>::infinity(); // the residual's, by the last step
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
    // With the last step's factor, another step reduces the residual to about 2 `reduction` of it.
    const bool isLast = 2.0 * reduction * this->Found.Largest < tolerance;
    if (!(isLast || this->FactorizeHere(damping, progress)) || !this->FindDirection())
    {
      dampMore();
      continue;
    }
    const Deviation before = this->Found;
    double part = firstPart;
    bool isAccepted = false;
    // Backtracking: Armijo's condition with 1/2 for the norm of the residual.
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
    firstPart = std::min(1.0, 4.0 * part); // the next search starts shorter after a short step
    reduction = this->Found.Norm / before.Norm;
    // A good step reduces the damping quickly; after a retry the damping stays for one step.
    const bool isGood = reduction < 0.25;
    damping = std::max(smallestDamping, damping * (isGood ? 0.01 : isRetry ? 1.0 : 0.1));
    isRetry = false;
  }
  return true;
}

// The dual's derivative at evaluated weights along the step to them: (1 - mass) . step.
double EqualMassPartition::Slope(const Vector& weights) const
{
  double slope = 0.0;
  for (std::size_t i = 0; i < this->Masses.size(); ++i)
  {
    slope += (1.0 - this->Masses[i]) * (weights[i] - this->Weights[i]);
  }
  return slope;
}

// Minus the Hessian of the dual is the Laplacian of the graph of neighbouring cells, with the
// strengths of their sides. The weights are determined up to a constant, which the damping fixes.
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

// Newton's direction d solves (minus Hessian + damping) d = 1 - mass.
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
  this->VisitCells(progress, partitionSlice, [this](std::int64_t place) {
    this->PrefetchCell(place + 1);
    const std::int64_t site = this->Cells.SiteAt(place);
    this->Integrated[static_cast<std::size_t>(site)] = this->IntegrateCell(site);
  });
}

EqualMassPartition::CellIntegrals EqualMassPartition::IntegrateCell(std::int64_t site) const
{
  const PowerDiagram::Cell cell = this->Cells[site];
  Point<2> middle{}; // the mean of the corners, which is in the cell
  for (std::int64_t k = 0; k < cell.Count; ++k)
  {
    middle[0] += cell[k].X[0] / static_cast<double>(cell.Count);
    middle[1] += cell[k].X[1] / static_cast<double>(cell.Count);
  }
  // Moments are taken about the corner of a grid cell near the polygon, so that they keep their
  // digits on large grids. Then they are moved to the centroid (parallel axis theorem).
  const GridSize<2> near = this->Rows.CellAt(middle);
  const Point<2> origin = this->Rows.CornerOf(near);
  PolygonMoments moments;
  for (std::int64_t k = 0; k < cell.Count; ++k)
  {
    this->Rows.AddSide(cell[k].X, cell.After(k).X, near, moments);
  }
  const Point<2> offset = { moments.First[0] / moments.Mass, moments.First[1] / moments.Mass };
  return { moments.Mass, { origin[0] + offset[0], origin[1] + offset[1] },
    moments.Translated({ -offset[0], -offset[1] }).Second };
}

// The integral of |x - site|^2 = integral of |x - centroid|^2 + mass |centroid - site|^2.
double EqualMassPartition::Cost(std::int64_t site) const
{
  const CellIntegrals& cell = this->Integrals(site);
  const Point<2>& x = this->Cells.Sites()[static_cast<std::size_t>(site)];
  return cell.Spread + squaredDistance(cell.Centroid, x) * cell.Mass;
}

} // namespace RectifiedTransport
