// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Grid/FaceSystem.h"

#include "Core/Grid/ConjugateGradients.h"
#include "Core/Parallel/Reduction.h"
#include "Core/Parallel/Stages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace RectifiedTransport
{

namespace
{

constexpr std::int64_t grain = 1 << 13;      // cells
constexpr std::int64_t firstSlice = 1 << 18; // a few milliseconds

// Damping factors of Jacobi's iteration: the inverses of the roots of Chebyshev's polynomial of
// fourth degree on [1/6, 2], T_4((x - 13/12) / (11/12)), which is the smallest one there that is 1
// at 0. 2 is Gershgorin's bound on eigenvalues of D^-1 A. The modes that a coarser level does not
// see have eigenvalues above 1/2, less where weights differ from axis to axis. Long and short steps
// take turns, so that intermediate errors stay small.
constexpr double centre = 13.0 / 12.0;
constexpr double radius = 11.0 / 12.0;
constexpr double cosine1 = 0.92387953251128674; // cos(pi / 8)
constexpr double cosine3 = 0.38268343236508977; // cos(3 pi / 8)
constexpr std::array<double, 4> factors = { 1.0 / (centre - radius * cosine1),
  1.0 / (centre + radius * cosine1), 1.0 / (centre - radius * cosine3),
  1.0 / (centre + radius * cosine3) };
constexpr std::int64_t coarsest = 8; // cells
constexpr int coarsestSweeps = 4;

// Progress expects as many iterations; the V-cycle's convergence does not depend on the size.
constexpr int usualIterations = 8;
constexpr std::int64_t workOfIteration = 15; // loops over all cells
// A solution hardly changes if so many iterations gained no more than this part of the energy that
// all did.
constexpr int lastIterations = 4;
constexpr double leastGain = 0.01;

// The zeros to be read before and after a grid's values: the largest distance of neighbours, which
// is that along the last axis, plus that along each axis before.
template <int Dimension>
std::int64_t marginOf(const GridSize<Dimension>& size)
{
  std::int64_t margin = 1;
  std::int64_t stride = 1;
  for (int axis = 0; axis + 1 < Dimension; ++axis)
  {
    stride *= size[axis];
    margin += stride;
  }
  return margin;
}

// The size of the next coarser level: two cells along each axis become one, an odd last one stays
// alone.
template <int Dimension>
GridSize<Dimension> halfOf(const GridSize<Dimension>& size)
{
  GridSize<Dimension> half = size;
  for (std::int64_t& cells : half)
  {
    cells = (cells + 1) / 2;
  }
  return half;
}

// Calls work(row of the fine grid, its place along axes 1 and 2) for the rows of a fine grid that
// are in a row of the coarse one.
template <int Dimension, class Work>
void forFineRows(const GridSize<Dimension>& fine, const GridSize<Dimension>& coarse,
  std::int64_t coarseRow, const Work& work)
{
  const std::int64_t low = 2 * (coarseRow % coarse[1]);
  const std::int64_t slice = 2 * (coarseRow / coarse[1]);
  const std::int64_t slices = Dimension == 3 ? fine[Dimension - 1] : 1;
  for (std::int64_t k = slice; k < std::min(slice + 2, slices); ++k)
  {
    for (std::int64_t j = low; j < std::min(low + 2, fine[1]); ++j)
    {
      work(k * fine[1] + j, std::array<std::int64_t, 3>{ 0, j, k });
    }
  }
}

} // namespace

// Both margins are zeros, so that kernels read neighbours beyond the border without a branch; their
// weights are 0.
template <int Dimension, class Value>
CellArray<Dimension, Value>::CellArray(const GridSize<Dimension>& size)
  : Margin(marginOf<Dimension>(size))
  , Values(static_cast<std::int64_t>(numberOfCells<Dimension>(size)) + 2 * this->Margin)
{
  std::fill_n(this->Values.data(), this->Margin, Value{ 0 });
  std::fill_n(this->Values.data() + this->Values.size() - this->Margin, this->Margin, Value{ 0 });
}

template <int Dimension>
FaceSystem<Dimension>::Level::Level(const GridSize<Dimension>& size)
  : Size(size)
  , Cells(static_cast<std::int64_t>(numberOfCells<Dimension>(size)))
  , Inverse(size)
  , Right(size)
  , X(size)
  , Other(size)
{
  std::int64_t stride = 1;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    this->Weights[axis] = CellArray<Dimension>(size);
    this->Stride[axis] = stride;
    stride *= size[axis];
  }
}

// Pointers for the kernels, which see no classes.
template <int Dimension>
FaceWeights<Dimension> FaceSystem<Dimension>::Level::View() const
{
  FaceWeights<Dimension> view;
  for (int axis = 0; axis < Dimension; ++axis)
  {
    view.Weights[axis] = this->Weights[axis].data();
    view.Stride[axis] = this->Stride[axis];
  }
  view.Inverse = this->Inverse.data();
  return view;
}

// Levels are halved down to at most `coarsest` cells.
template <int Dimension>
FaceSystem<Dimension>::FaceSystem(const GridSize<Dimension>& size)
  : Kernels(faceKernels<Dimension>())
  , Given(size)
  , Found(size)
  , Search(size)
{
  this->Levels.emplace_back(size);
  while (this->Levels.back().Cells > coarsest)
  {
    this->Levels.emplace_back(halfOf<Dimension>(this->Levels.back().Size));
  }
}

// Bytes of floats a cell: a right-hand side, a solution in double precision (2 floats) and a search
// direction on the finest level; Dimension weights, the inverse diagonal, right-hand side, x and a
// copy on each.
template <int Dimension>
double FaceSystem<Dimension>::Memory(const GridSize<Dimension>& size)
{
  double cells = 4.0 * numberOfCells<Dimension>(size);
  for (GridSize<Dimension> level = size;; level = halfOf<Dimension>(level))
  {
    cells += (Dimension + 4.0) * numberOfCells<Dimension>(level);
    if (numberOfCells<Dimension>(level) <= coarsest)
    {
      return cells * sizeof(float);
    }
  }
}

// Levels of one chunk stay on the calling thread, as waking others would take longer.
template <int Dimension>
void FaceSystem<Dimension>::For(std::int64_t cells, RangeKernel kernel, Progress& progress) const
{
  if (cells <= grain)
  {
    kernel(0, cells);
    return;
  }
  progress.For(cells, grain, kernel, firstSlice);
}

template <int Dimension>
void FaceSystem<Dimension>::ForRows(
  const Level& coarse, RangeKernel kernel, Progress& progress) const
{
  const std::int64_t rows = coarse.Cells / coarse.Size[0];
  if (coarse.Cells <= grain)
  {
    kernel(0, rows);
    return;
  }
  progress.For(rows, std::max<std::int64_t>(grain / coarse.Size[0], 1), kernel,
    std::max<std::int64_t>(firstSlice / coarse.Size[0], 1));
}

// Inverse = 1 / diagonal of A, with A_qq = the sum of a cell's weights; 0 for a cell without
// neighbours.
template <int Dimension>
void FaceSystem<Dimension>::Invert(Level& level, Progress& progress)
{
  float* inverse = level.Inverse.data();
  this->For(
    level.Cells,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t q = first; q < last; ++q)
      {
        float sum = 0.0F;
        for (int axis = 0; axis < Dimension; ++axis)
        {
          const float* w = level.Weights[axis].data();
          sum += w[q] + w[q - level.Stride[axis]];
        }
        inverse[q] = sum > 0.0F ? 1.0F / sum : 0.0F;
      }
    },
    progress);
}

// The weight of a coarse face is half the sum of the fine weights in it, as w = area / distance:
// the face has the fine faces' areas, and centres are twice as far apart. This is half of the
// Galerkin operator of piecewise constant prolongation, which would make corrections too small.
template <int Dimension>
void FaceSystem<Dimension>::Coarsen(const Level& fine, Level& coarse, Progress& progress)
{
  this->ForRows(
    coarse,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t row = first; row < last; ++row)
      {
        const std::int64_t to = row * coarse.Size[0];
        for (int axis = 0; axis < Dimension; ++axis)
        {
          float* sum = coarse.Weights[axis].data() + to;
          std::fill_n(sum, coarse.Size[0], 0.0F);
          forFineRows<Dimension>(fine.Size, coarse.Size, row,
            [&](std::int64_t fineRow, const std::array<std::int64_t, 3>& place) {
              const float* w = fine.Weights[axis].data() + fineRow * fine.Size[0];
              if (axis == 0)
              {
                for (std::int64_t i = 1; i < fine.Size[0]; i += 2)
                {
                  sum[i / 2] += 0.5F * w[i];
                }
              }
              else if (place[axis] % 2 == 1)
              {
                const std::int64_t pairs = fine.Size[0] / 2;
                for (std::int64_t i = 0; i < pairs; ++i)
                {
                  sum[i] += 0.5F * (w[2 * i] + w[2 * i + 1]);
                }
                if (fine.Size[0] % 2 == 1)
                {
                  sum[pairs] += 0.5F * w[2 * pairs];
                }
              }
            });
        }
      }
    },
    progress);
}

template <int Dimension>
void FaceSystem<Dimension>::Prepare(Progress& progress)
{
  this->Invert(this->Levels.front(), progress);
  for (std::size_t at = 1; at < this->Levels.size(); ++at)
  {
    this->Coarsen(this->Levels[at - 1], this->Levels[at], progress);
    this->Invert(this->Levels[at], progress);
  }
}

// The right-hand side of the coarse level sums the residual b - A x over the fine cells in each
// coarse cell, which is the transpose of Prolong.
template <int Dimension>
void FaceSystem<Dimension>::Restrict(const Level& fine, Level& coarse, Progress& progress)
{
  const FaceWeights<Dimension> system = fine.View();
  const std::int64_t cells = fine.Size[0];
  const std::int64_t pairs = cells / 2;
  this->ForRows(
    coarse,
    [&](std::int64_t first, std::int64_t last) {
      // A row of residuals at a time stays in the cache; the fine level needs no array for them.
      std::vector<float> values(static_cast<std::size_t>(cells));
      for (std::int64_t row = first; row < last; ++row)
      {
        float* sum = coarse.Right.data() + row * coarse.Size[0];
        std::fill_n(sum, coarse.Size[0], 0.0F);
        forFineRows<Dimension>(fine.Size, coarse.Size, row,
          [&](std::int64_t fineRow, const std::array<std::int64_t, 3>&) {
            const float* r = values.data();
            this->Kernels.Residual(system, fine.X.data(), fine.Right.data(), fineRow * cells,
              (fineRow + 1) * cells, values.data());
            for (std::int64_t i = 0; i < pairs; ++i)
            {
              sum[i] += r[2 * i] + r[2 * i + 1];
            }
            if (cells % 2 == 1)
            {
              sum[pairs] += r[cells - 1];
            }
          });
      }
    },
    progress);
}

template <int Dimension>
void FaceSystem<Dimension>::Prolong(const Level& coarse, Level& fine, Progress& progress)
{
  const std::int64_t cells = fine.Size[0];
  const std::int64_t pairs = cells / 2;
  this->ForRows(
    coarse,
    [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t row = first; row < last; ++row)
      {
        const float* from = coarse.X.data() + row * coarse.Size[0];
        forFineRows<Dimension>(fine.Size, coarse.Size, row,
          [&](std::int64_t fineRow, const std::array<std::int64_t, 3>&) {
            float* to = fine.X.data() + fineRow * cells;
            for (std::int64_t i = 0; i < pairs; ++i)
            {
              to[2 * i] += from[i];
              to[2 * i + 1] += from[i];
            }
            if (cells % 2 == 1)
            {
              to[cells - 1] += from[pairs];
            }
          });
      }
    },
    progress);
}

// One damped Jacobi step x += factor D^-1 (b - A x).
template <int Dimension>
void FaceSystem<Dimension>::RelaxOnce(
  Level& level, bool fromZero, double factor, Progress& progress)
{
  // Jacobi's step reads x and writes Other; the arrays are swapped.
  const FaceWeights<Dimension> system = level.View();
  const float* x = fromZero ? nullptr : level.X.data();
  this->For(
    level.Cells,
    [&](std::int64_t first, std::int64_t last) {
      this->Kernels.Relax(
        system, x, level.Right.data(), static_cast<float>(factor), first, last, level.Other.data());
    },
    progress);
  std::swap(level.X, level.Other);
}

template <int Dimension>
void FaceSystem<Dimension>::Relax(Level& level, bool fromZero, Progress& progress)
{
  for (std::size_t step = 0; step < factors.size(); ++step)
  {
    this->RelaxOnce(level, fromZero && step == 0, factors[step], progress);
  }
}

// Smooths by the four Chebyshev steps in the opposite order.
template <int Dimension>
void FaceSystem<Dimension>::RelaxBack(Level& level, Progress& progress)
{
  for (std::size_t step = factors.size(); step-- > 0;)
  {
    this->RelaxOnce(level, false, factors[step], progress);
  }
}

// The V-cycle x = M b from x = 0. M is symmetric, as conjugate gradients need of a preconditioner:
// the way up takes the factors in the opposite order of the way down. The coarsest level is
// smoothed several times in place of a direct solution.
template <int Dimension>
void FaceSystem<Dimension>::Cycle(std::size_t at, Progress& progress)
{
  Level& level = this->Levels[at];
  this->Relax(level, true, progress);
  if (at + 1 < this->Levels.size())
  {
    Level& coarse = this->Levels[at + 1];
    this->Restrict(level, coarse, progress);
    this->Cycle(at + 1, progress);
    this->Prolong(coarse, level, progress);
  }
  else
  {
    for (int sweep = 0; sweep < coarsestSweeps; ++sweep)
    {
      this->RelaxBack(level, progress);
      this->Relax(level, false, progress);
    }
  }
  this->RelaxBack(level, progress);
}

// Preconditioned conjugate gradients for A x = b, in floats except for x and the sums. b is in
// Right of the finest level, which then holds the residual r as the right-hand side of the V-cycle.
// Returns |b - A x| / |b|.
template <int Dimension>
FaceSolution FaceSystem<Dimension>::Solve(double tolerance, int maximum, Progress& progress)
{
  Level& finest = this->Levels.front();
  const FaceWeights<Dimension> system = finest.View();
  const auto sum = [&](Progress& round, const auto& part) {
    return reduceChunks(
      round, finest.Cells, grain, 0.0, part, [](double a, double b) { return a + b; }, firstSlice);
  };
  float* b = this->Given.data();
  float* r = finest.Right.data();
  double* x = this->Found.data();
  float* p = this->Search.data();
  Rounds rounds(progress, usualIterations);
  const auto nextRound = [&]() -> Progress& {
    return rounds.Next().Expect(workOfIteration * finest.Cells);
  };
  const double begin = sum(nextRound(), [&](std::int64_t first, std::int64_t last) {
    std::copy(r + first, r + last, b + first);
    std::fill(x + first, x + last, 0.0);
    std::fill(p + first, p + last, 0.0F);
    return this->Kernels.Dot(r, r, first, last);
  });
  FaceSolution found;
  ConjugateGradients method;
  // |r|^2 <= tolerance^2 |b|^2.
  const double enough = tolerance * tolerance * begin;
  // |r|^2 as the updates have it; gains of the last iterations, in a ring.
  double now = begin;
  std::array<double, lastIterations> gains{};
  double allGains = 0.0;
  while (now > enough && found.Iterations < maximum)
  {
    Progress& round = nextRound();
    const auto precondition = [&]() {
      this->Cycle(0, round);
      return sum(round, [&, z = finest.X.data()](std::int64_t first, std::int64_t last) {
        return this->Kernels.Dot(r, z, first, last);
      });
    };
    const auto newDirection = [&](double beta) {
      this->For(
        finest.Cells,
        [&, z = finest.X.data()](std::int64_t first, std::int64_t last) {
          this->Kernels.NewDirection(static_cast<float>(beta), z, first, last, p);
        },
        round);
    };
    const auto apply = [&]() {
      return sum(round, [&, q = finest.Other.data()](std::int64_t first, std::int64_t last) {
        return this->Kernels.Apply(system, p, first, last, q);
      });
    };
    const auto advance = [&](double alpha) {
      now = sum(round, [&, q = finest.Other.data()](std::int64_t first, std::int64_t last) {
        return this->Kernels.Advance(static_cast<float>(alpha), p, q, first, last, x, r);
      });
    };
    if (!method.Iterate(precondition, newDirection, apply, advance))
    {
      break;
    }
    gains[static_cast<std::size_t>(found.Iterations % lastIterations)] = method.Gain();
    allGains += method.Gain();
    ++found.Iterations;
    // An iteration's gain is what it takes from the energy x A x / 2 - b x, which falls
    // monotonically, unlike the residual.
    const bool isIdle = found.Iterations >= lastIterations &&
      std::accumulate(gains.begin(), gains.end(), 0.0) <= leastGain * allGains;
    if (now <= enough || isIdle || found.Iterations == maximum)
    {
      // Computes the residual b - A x anew: updates do not know what rounding lost. If it is above
      // the tolerance, the iteration restarts from it with beta = 0.
      now = sum(round, [&](std::int64_t first, std::int64_t last) {
        return this->Kernels.TrueResidual(system, x, b, first, last, r);
      });
      method.Restart();
    }
    if (isIdle)
    {
      break;
    }
  }
  found.Residual = begin > 0.0 ? std::sqrt(now / begin) : 0.0;
  return found;
}

template class CellArray<2>;
template class CellArray<3>;
template class CellArray<2, double>;
template class CellArray<3, double>;
template class FaceSystem<2>;
template class FaceSystem<3>;

} // namespace RectifiedTransport
