// SPDX-License-Identifier: BSD-3-Clause
#include "Core/OptimalMap/PotentialSolver.h"

#include "Core/Grid/NodeLevels.h"
#include "Core/Grid/Prolongation.h"
#include "Core/OptimalMap/Nodes/CostTransform.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Parallel/SmallWork.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace RectifiedTransport
{

namespace
{

// Chunks of loops: 8192 nodes, which are 64 KiB of doubles and fit a core's cache.
constexpr std::int64_t potentialGrain = std::int64_t{ 1 } << 13;
// A coarse level only serves as the start of the next finer one, so few iterations suffice there.
constexpr int coarseIterations = 3;
// The weighted equation is solved by so many steps of preconditioned conjugate gradients. Its
// weight is max(weightFloor, density), with densities of mean 1: smaller floors give a lower bound.
constexpr int weightedIterations = 4;
constexpr double weightFloor = 1.0;

// |sides|^2, the largest cost 2 c(x, y) = |x - y|^2 in the box.
template <int Dimension>
double squaredDiagonal(const Point<Dimension>& sides)
{
  double sum = 0.0;
  for (const double side : sides)
  {
    sum += side * side;
  }
  return sum;
}

// Throws if a side of the domain is more than 1e120 times as long as another one: squared sides of
// cells would vanish beside others.
template <int Dimension>
void checkSides(const Point<Dimension>& sides)
{
  constexpr double most = 1e120;
  const auto [shortest, longest] = std::minmax_element(sides.begin(), sides.end());
  if (!(*longest <= most * *shortest))
  {
    std::ostringstream text;
    text << "The longest side of the domain is " << *longest / *shortest
         << " times the shortest one; an optimal map needs one that is at most " << most
         << " times as long";
    throw std::invalid_argument(text.str());
  }
}

// sum_i a_i b_i, by a fixed number of partial sums, which the compiler may keep in any width of
// registers. So the bits do not depend on the instruction set.
double sumOfProducts(const double* a, const double* b, std::int64_t count)
{
  constexpr std::int64_t lanes = 8;
  std::array<double, lanes> sums{};
  std::int64_t i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    for (std::int64_t lane = 0; lane < lanes; ++lane)
    {
      sums[static_cast<std::size_t>(lane)] += a[i + lane] * b[i + lane];
    }
  }
  const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
  return std::inner_product(a + i, a + count, b + i, sum);
}

// The same by chunks, whose sums are added in their order: the bits do not depend on the number of
// threads.
double sumOfProducts(const double* a, const double* b, std::int64_t count, Progress& progress)
{
  return reduceChunks(
    progress, count, potentialGrain / 4, 0.0,
    [=](std::int64_t first, std::int64_t last) {
      return sumOfProducts(a + first, b + first, last - first);
    },
    [](double all, double part) { return all + part; });
}

// An estimate of an iteration's work for the progress, in values of nodes. Both half-steps map,
// push forward and solve; a solution transforms each axis forwards and back; a conjugation is a
// cost transform along each axis.
template <int Dimension>
std::int64_t unitsOfIteration(std::int64_t nodes, bool isWeighted)
{
  const int solutions = isWeighted ? weightedIterations : 1;
  return 2 * nodes * (Dimension * (1 + 2 + 2 * solutions) + 6 * solutions + 4);
}

} // namespace

// What an iteration needs on nodes: the map and the push-forward, the residual, the ascent
// direction P, and both potentials after a trial step.
template <int Dimension>
struct PotentialSolver<Dimension>::Scratch
{
  explicit Scratch(const NodeGrid<Dimension>& grid, const Progress& progress)
    : Poisson(grid)
    , Sums(grid, static_cast<double>(grid.NumberOfCells()), grid.NumberOfCells(), progress)
    , Map(NodeMap<Dimension>::On(grid))
    , Defect(grid.NumberOfNodes())
    , P(grid.NumberOfNodes())
    , New(grid.NumberOfNodes())
    , NewOther(grid.NumberOfNodes())
  {
  }

  NodePoisson<Dimension> Poisson;
  NodeSums<Dimension> Sums;
  NodeMap<Dimension> Map;
  NodeValues Defect;
  NodeValues P;
  NodeValues New;
  NodeValues NewOther;
};

// Rounding is what the sums of the dual may be wrong by: squared lengths in the box are at most the
// squared diagonal, and 1e-13 of it is more than the errors of summing them.
template <int Dimension>
PotentialSolver<Dimension>::PotentialSolver(const BoxedDensity<Dimension>& source,
  const BoxedDensity<Dimension>& target, const Point<Dimension>& sides,
  const OptimalMapOptions& options)
  : Given{ source, target }
  , Lengths(sides)
  , Options(options)
  , Rounding(1e-13 * squaredDiagonal<Dimension>(sides))
  , IsWeighted(!source.IsUniformInBox() && !target.IsUniformInBox() && source.HasMassEverywhere() &&
      target.HasMassEverywhere())
  , Nodes{}
{
  checkSides<Dimension>(sides);
}

template <int Dimension>
double PotentialSolver<Dimension>::BytesANode(int threads)
{
  // Doubles a node: 6 for potentials, hats and cells of both sides; Dimension for the map and 4 for
  // residual, direction and trial potentials; the sums' arrays; 6 for the weighted equation.
  constexpr double real = sizeof(double);
  const int arrays = std::min(threads, mostArraysOfSums);
  return real * (6.0 + Dimension + 4.0 + arrays + 6.0);
}

template <int Dimension>
double PotentialSolver<Dimension>::MemoryForRefined(
  const GridSize<Dimension>& cells, double mostNodes)
{
  constexpr double arrays = 1.5; // a potential, and what it is made from
  GridSize<Dimension> finer = cells;
  for (std::int64_t& count : finer)
  {
    count *= 2;
  }
  // No refined bound is made on more nodes than the most.
  return numberOfCells<Dimension>(finer) > mostNodes
    ? 0.0
    : arrays * sizeof(double) * numberOfCorners<Dimension>(finer);
}

// Nested iteration: the finest nodes resolve the finer of both densities' cells, up to MostNodes,
// and each coarser level has about half the cells along each axis. A cold start on fine nodes
// stalls where much of the box is empty.
template <int Dimension>
void PotentialSolver<Dimension>::Solve(Progress& progress)
{
  std::vector<Point<Dimension>> cellSides;
  for (const BoxedDensity<Dimension>& given : this->Given)
  {
    if (!given.IsUniformInBox())
    {
      Point<Dimension> sides;
      for (int axis = 0; axis < Dimension; ++axis)
      {
        sides[axis] =
          (given.High[axis] - given.Low[axis]) / static_cast<double>(given.Density.Size()[axis]);
      }
      cellSides.push_back(sides);
    }
  }
  const auto levels =
    nodeLevels<Dimension>(finestNodeCells<Dimension>(cellSides, this->Options.MostNodes));
  std::vector<double> costs;
  // A level costs its cells times its iterations, and about one more iteration to begin.
  for (std::size_t level = 0; level < levels.size(); ++level)
  {
    const int iterations =
      level + 1 == levels.size() ? std::max(1, this->Options.LeastIterations) : coarseIterations;
    costs.push_back(numberOfCells<Dimension>(levels[level]) * (iterations + 1));
  }
  // Measured shares of the time, in percent.
  Stages stages(progress, { { "cells", 3 }, { "potentials", 97 } });
  this->MakeCells(levels, stages["cells"]);
  NodeValues potential;
  Parts parts(stages["potentials"], costs);
  for (std::size_t level = 0; level < levels.size(); ++level)
  {
    Progress work(contextForSize(
      parts[static_cast<std::int64_t>(level)], numberOfCells<Dimension>(levels[level])));
    Stages steps(work, { { "begin", 1 }, { "iterations", 9 } });
    this->Begin(levels, level, std::move(potential), steps["begin"]);
    const bool isFinest = level + 1 == levels.size();
    if (!isFinest || this->Options.MostIterations > 0)
    {
      Scratch scratch(this->Nodes, work);
      this->Iterate(scratch, isFinest, steps["iterations"]);
    }
    if (level + 1 < levels.size())
    {
      potential = std::move(this->Sides[0].Potential);
    }
  }
}

// Fills LevelCells: the mass of each cell between nodes, on all levels. The finest ones overlap the
// density's own cells, the others sum those of the next finer level.
template <int Dimension>
void PotentialSolver<Dimension>::MakeCells(
  const std::vector<GridSize<Dimension>>& levels, Progress& progress)
{
  for (std::size_t i = 0; i < this->Given.size(); ++i)
  {
    const BoxedDensity<Dimension>& given = this->Given[i];
    std::vector<NodeValues>& cells = this->LevelCells[i];
    cells.clear();
    if (given.IsUniformInBox())
    {
      continue;
    }
    cells.resize(levels.size());
    cells.back() = cellMasses(given.Density, given.PlacementOn(levels.back()),
      NodeGrid<Dimension>::In(levels.back(), this->Lengths), progress);
    for (std::size_t level = levels.size() - 1; level-- > 0;)
    {
      const NodeGrid<Dimension> grid = NodeGrid<Dimension>::In(levels[level], this->Lengths);
      cells[level] =
        coarserCells<Dimension>(cells[level + 1].data(), levels[level + 1], grid, progress);
    }
  }
}

// Goes to finer nodes: prolongs the potential of the level before, multilinearly, and makes it the
// start here. Coarse nodes have hat masses from the cells of the next finer level. Only on the
// finest nodes, whose bound counts, they are integrals of the density itself.
template <int Dimension>
void PotentialSolver<Dimension>::Begin(const std::vector<GridSize<Dimension>>& levels,
  std::size_t level, NodeValues potential, Progress& progress)
{
  const GridSize<Dimension> before = this->Nodes.Cells;
  const GridSize<Dimension>& cells = levels[level];
  const bool isFinest = level + 1 == levels.size();
  this->Nodes = NodeGrid<Dimension>::In(cells, this->Lengths);
  const std::int64_t nodes = this->Nodes.NumberOfNodes();
  this->Excess = 0.0;
  for (std::size_t i = 0; i < this->Given.size(); ++i)
  {
    const BoxedDensity<Dimension>& given = this->Given[i];
    SolverSide<Dimension>& side = this->Sides[i];
    side = SolverSide<Dimension>();
    side.Placement = given.PlacementOn(cells);
    if (!this->LevelCells[i].empty())
    {
      side.Cells = std::move(this->LevelCells[i][level]);
    }
    // mu_i = integral of the hat function Lambda_i over the density: the weights of the dual.
    if (isFinest)
    {
      side.Hats = hatMasses(given.Density, side.Placement, this->Nodes, progress);
    }
    else
    {
      const bool isUniform = this->LevelCells[i].empty();
      const double* finer = isUniform ? nullptr : this->LevelCells[i][level + 1].data();
      side.Hats = hatMasses<Dimension>(finer, levels[level + 1], this->Nodes, progress);
    }
    // Excess = sum_i mu_i |x_i|^2 - M2(mu), summed over both sides, with M2 the second moment about
    // the origin. It is what lumping the mass at nodes adds to the cost, and what the bound must
    // give up.
    if (isFinest)
    {
      this->Excess += lumpingExcess(given.Density, side.Placement, this->Nodes, progress);
    }
    // Lumping a density that is constant in cells between nodes adds h^2 / 6 along each axis. On
    // coarse levels this estimate only shifts the bound by a constant.
    for (int axis = 0; axis < Dimension && !isFinest; ++axis)
    {
      this->Excess += this->Nodes.Spacing[axis] * this->Nodes.Spacing[axis] / 6.0;
    }
    side.Potential = NodeValues(nodes);
  }
  if (potential.size() > 0)
  {
    this->Sides[0].Potential = prolong<Dimension>(potential, before, cells, progress);
  }
  // The first level starts from 0: the identity is the map.
  else
  {
    std::fill_n(this->Sides[0].Potential.data(), nodes, 0.0);
  }
  // Makes the potentials conjugate: psi = phi^c, phi = psi^c, with the c-transform phi^c(y) = min_x
  // |x - y|^2 / 2 - phi(x).
  double* source = this->Sides[0].Potential.data();
  double* target = this->Sides[1].Potential.data();
  costTransform<Dimension>(this->Nodes, source, target, progress);
  costTransform<Dimension>(this->Nodes, target, source, progress);
  this->BoundNow = this->Dual(source, target, progress);
}

// The bound that conjugate potentials give by Kantorovich's duality, D = 2 (sum_i mu_i phi_i +
// sum_j nu_j psi_j) - Excess <= W2^2. It holds whatever the nodal potential was before the
// c-transforms: |y|^2 / 2 - psi is convex and so lies below its multilinear interpolant.
template <int Dimension>
double PotentialSolver<Dimension>::Dual(
  const double* source, const double* target, Progress& progress) const
{
  const std::int64_t nodes = this->Nodes.NumberOfNodes();
  const double sum = sumOfProducts(this->Sides[0].Hats.data(), source, nodes, progress) +
    sumOfProducts(this->Sides[1].Hats.data(), target, nodes, progress);
  return 2.0 * sum - this->Excess;
}

// The back-and-forth method of Jacobs and Leger: each iteration ascends the dual in the source's
// potential, then in the target's.
template <int Dimension>
void PotentialSolver<Dimension>::Iterate(Scratch& scratch, bool isFinest, Progress& progress)
{
  // Densities of mean 1 make the Laplacian the Hessian of the dual at the identity, so 1 is
  // Newton's step there. Every level starts from it anew: steps of coarse levels do not suit finer
  // ones.
  this->Steps = { 1.0, 1.0 };
  const int most = isFinest ? this->Options.MostIterations : coarseIterations;
  const int least = isFinest ? this->Options.LeastIterations : 0;
  const std::int64_t units =
    unitsOfIteration<Dimension>(this->Nodes.NumberOfNodes(), this->IsWeighted);
  Rounds rounds(progress, std::max(1, isFinest ? least : most));
  int iteration = 0;
  for (bool goesOn = true; goesOn && iteration < most; ++iteration)
  {
    Progress& round = rounds.Next().Expect(units);
    const double before = this->BoundNow;
    this->HalfStep(scratch, 0, round);
    this->HalfStep(scratch, 1, round);
    // Gains fall about geometrically. An iteration that gains less than a quarter of the tolerance
    // is taken to leave less than the tolerance to all later ones.
    const double gain = this->BoundNow - before;
    goesOn =
      gain >= 0.25 * this->Options.Tolerance * std::abs(this->BoundNow) || iteration + 1 < least;
  }
  if (isFinest)
  {
    this->FineIterations = iteration;
  }
}

// The residual of a side, which is the gradient of the dual in its potential: r = mu - (T_psi)_#
// nu, hat masses at the nodes less the push-forward of the other density by T_psi(y) = y - grad
// psi(y). `scratch.Defect` holds it, a value a node, in shares of a whole mass of 1.
template <int Dimension>
void PotentialSolver<Dimension>::FindDefect(Scratch& scratch, int side, Progress& progress) const
{
  const SolverSide<Dimension>& own = this->Sides[Index(side)];
  const SolverSide<Dimension>& other = this->Sides[Index(1 - side)];
  writeGradientMap<Dimension>(other.Potential.data(), scratch.Map, progress);
  // A cell is pushed forward by samples, as many along an axis as it is stretched to cells. If only
  // bounds are wanted and there are no voids, cells below the mean mass have half as many.
  SampleFineness fineness;
  if (this->Options.ForBounds && this->Given[Index(1 - side)].HasMassEverywhere())
  {
    fineness.OfLightCells = 0.5;
    fineness.LightMass = 1.0; // the mean
  }
  fineness = limitFineness(scratch.Map, other.CellsOrNull(), fineness, progress);
  pushForward<Dimension>(scratch.Map, other.CellsOrNull(), fineness, scratch.Sums, progress);
  // Sums are in masses of mean 1 a cell, the hats in shares of the whole.
  const double share = 1.0 / static_cast<double>(this->Nodes.NumberOfCells());
  const double* hats = own.Hats.data();
  scratch.Sums.Write(scratch.Defect.data(), progress,
    [=](std::int64_t node, double mass) { return hats[node] - share * mass; });
}

// An ascent step of the dual in the potential of a side: phi <- phi + s p, where -Laplace p = r or,
// weighted, -div(max(1, mu) grad p) = r, with natural boundaries. So p is the gradient of the dual
// in the homogeneous Sobolev space H^1 (Jacobs and Leger 2020), not in L^2, whose gradient r would
// allow short steps alone on fine nodes. Then phi and psi are made conjugate, which can only raise
// the dual. The step s is halved until the bound is above the one before.
template <int Dimension>
void PotentialSolver<Dimension>::HalfStep(Scratch& scratch, int side, Progress& progress)
{
  // 2^-8 reaches the steps of pairs whose mass is concentrated: these need s of about 1 / density.
  constexpr int halvings = 8;
  // The ratio of the bound's gain to s <gradient, p>, what the slope promises, adapts the next
  // step: a ratio above `good` says that the dual is nearly linear so far and makes it longer, one
  // below `poor` says that it curves and makes it shorter. 1.4 and .75 are about inverse, so that
  // steps settle.
  constexpr double good = 0.6;
  constexpr double poor = 0.35;
  constexpr double longer = 1.4;
  constexpr double shorter = 0.75;

  SolverSide<Dimension>& own = this->Sides[Index(side)];
  SolverSide<Dimension>& other = this->Sides[Index(1 - side)];
  this->FindDefect(scratch, side, progress);
  double* p = scratch.P.data();
  if (this->IsWeighted)
  {
    scratch.Poisson.SolveWeighted(
      scratch.Defect.data(), own.Hats.data(), weightFloor, weightedIterations, p, progress);
  }
  else
  {
    scratch.Poisson.Solve(scratch.Defect.data(), p, progress);
  }
  // The slope of the bound along p: dD/ds = 2 <p, r> at s = 0, at least 0 up to rounding.
  const double product =
    sumOfProducts(p, scratch.Defect.data(), this->Nodes.NumberOfNodes(), progress);
  const double slope = 2.0 * std::max(0.0, product);
  double& step = this->Steps[Index(side)];
  // If no attempt raises the bound, the potentials stay: it has reached the accuracy of the nodes.
  for (int attempt = 0; attempt <= halvings; ++attempt)
  {
    double* moved = scratch.New.data();
    double* movedOther = scratch.NewOther.data();
    const double* potential = own.Potential.data();
    const double length = step;
    progress.ForEach(this->Nodes.NumberOfNodes(), potentialGrain,
      [=](std::int64_t i) { moved[i] = potential[i] + length * p[i]; });
    // For the moved potential phi: psi = phi^c, then phi = psi^c, which is at least the moved one.
    costTransform<Dimension>(this->Nodes, moved, movedOther, progress);
    costTransform<Dimension>(this->Nodes, movedOther, moved, progress);
    const double bound =
      side == 0 ? this->Dual(moved, movedOther, progress) : this->Dual(movedOther, moved, progress);
    const double gain = bound - this->BoundNow;
    if (gain > 0.0)
    {
      std::swap(own.Potential, scratch.New);
      std::swap(other.Potential, scratch.NewOther);
      this->BoundNow = bound;
      step *= gain > good * length * slope ? longer : gain < poor * length * slope ? shorter : 1.0;
      return;
    }
    step *= 0.5;
  }
}

// The bound with each cell between nodes halved: the error of lumping falls by 4. The prolonged
// potential of the source needs two c-transforms and no iteration.
template <int Dimension>
double PotentialSolver<Dimension>::RefinedBound(Progress& progress) const
{
  NodeGrid<Dimension> grid = this->Nodes;
  for (std::int64_t& cells : grid.Cells)
  {
    cells *= 2;
  }
  if (numberOfCells<Dimension>(grid.Cells) > this->Options.MostNodes)
  {
    return this->Bound();
  }
  grid = NodeGrid<Dimension>::In(grid.Cells, this->Lengths);
  NodeValues potential =
    prolong<Dimension>(this->Sides[0].Potential, this->Nodes.Cells, grid.Cells, progress);
  // D = 2 (sum_i mu_i phi_i + sum_j nu_j psi_j) - Excess, a side at a time: psi = phi^c replaces
  // phi in the same array before the target is integrated, and phi = psi^c follows.
  double bound = -this->Rounding;
  for (const int side : { 1, 0 })
  {
    costTransform<Dimension>(grid, potential.data(), potential.data(), progress);
    const BoxedDensity<Dimension>& given = this->Given[Index(side)];
    const auto placement = given.PlacementOn(grid.Cells);
    bound +=
      // integral of the potential's interpolant over the density, without hats at finer nodes in
      // memory.
      2.0 * integrateOver<Dimension>(given.Density, placement, grid, potential.data(), progress);
    bound -= lumpingExcess(given.Density, placement, grid, progress);
  }
  // Both bounds are certified, so the better one is as well.
  return std::max(bound, this->Bound());
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(PotentialSolver);

} // namespace RectifiedTransport
