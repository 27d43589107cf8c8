// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Grid/NodePoisson.h"

#include "Core/Geometry/ReproducibleMath.h"
#include "Core/Grid/FourierTransform.h"
#include "Core/Grid/NodeRows.h"
#include "Core/Grid/WeightedPoisson.h"
#include "Core/Parallel/LargeBuffer.h"
#include "Core/Parallel/Progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// The discrete cosine transform of the first kind of lines of nodes, eight at a time. X(k) = f(0) +
// (-1)^k f(M) + 2 sum over 0 < j < M of f(j) cos(pi j k / M), for lines of M + 1 nodes and an even
// M. Twice it is 2 M times the identity. The same bits on every machine. For one thread at a time.
class CosineLines
{
public:
  static constexpr int Count = sizeof(ComplexLines) / sizeof(double);

  // M is the length of the Fourier transform, which has to outlive this object.
  explicit CosineLines(const FourierTransform& fourier)
    : Fourier(fourier)
    , Line(fourier.Length() + 1)
    , Spectrum(fourier.Length())
  {
  }

  // [node][line]. Real parts are lines 0 to 3, imaginary parts 4 to 7.
  double* Values() { return reinterpret_cast<double*>(this->Line.data()); }

  // Transforms the lines in place. Two real lines take one complex Fourier transform of length M
  // (Press et al., "Numerical Recipes", cosft1). With y_j = (f_j + f_{M-j}) / 2 - sin(pi j / M)
  // (f_j - f_{M-j}), the Fourier transform of y holds the even X in its real part and the
  // differences of odd X in its imaginary part. Two real lines, a and b, are transformed as a + i
  // b; the sums and differences of z_k and z_{M-k} separate them.
  void Transform()
  {
    const std::int64_t cells = this->Fourier.Length();
    const std::int64_t middle = cells / 2;
    ComplexLines* f = this->Line.data();
    ComplexLanes odd[2]; // half of X(1), which the recursion of the odd terms starts from
    for (int half = 0; half < 2; ++half)
    {
      odd[half] = 0.5 * (f[0][half] - f[cells][half]);
      f[0].Set(half, 0.5 * (f[0][half] + f[cells][half]));
    }
    for (std::int64_t j = 1; j < middle; ++j)
    {
      const ComplexLanes& root = this->Fourier.Roots()[j]; // cos(pi j / M) - i sin(pi j / M)
      for (int half = 0; half < 2; ++half)
      {
        const ComplexLanes sum = 0.5 * (f[j][half] + f[cells - j][half]);
        const ComplexLanes difference = f[j][half] - f[cells - j][half];
        const ComplexLanes turned = root.Imaginary * difference;
        odd[half] = odd[half] + root.Real * difference;
        f[j].Set(half, sum + turned);
        f[cells - j].Set(half, sum - turned);
      }
    }
    this->Fourier.Transform(f, this->Spectrum.data());
    const ComplexLines* z = this->Spectrum.data();
    for (int half = 0; half < 2; ++half)
    {
      // X(2 k + 1) = X(2 k - 1) + twice the sine sum at k.
      ComplexLanes last = 2.0 * odd[half];
      f[0].Set(half, 2.0 * z[0][half]);
      f[1].Set(half, last);
      for (std::int64_t k = 1; k < middle; ++k)
      {
        const ComplexLanes a = z[k][half];
        const ComplexLanes b = z[cells - k][half];
        f[2 * k].Set(half, a + b);
        last = last + ComplexLanes{ b.Imaginary - a.Imaginary, a.Real - b.Real };
        f[2 * k + 1].Set(half, last);
      }
      f[cells].Set(half, 2.0 * z[middle][half]);
    }
  }

  // Bytes for lines of so many cells.
  static double MemoryFor(std::int64_t cells)
  {
    constexpr double arrays = 3.0; // the line, its spectrum and the roots of unity
    return arrays * sizeof(ComplexLines) * static_cast<double>(cells + 1);
  }

private:
  const FourierTransform& Fourier;
  LargeBuffer<ComplexLines> Line;
  LargeBuffer<ComplexLines> Spectrum;
};

constexpr int lanes = CosineLines::Count;
// Units of the first piece of work, after which its pace sizes the others.
constexpr std::int64_t firstSlice = std::int64_t{ 1 } << 19;

// The eight lines that are transformed together, as their first nodes. In the last block the last
// line stands for those that lack.
struct PoissonBlock
{
  PoissonBlock(const NodeLines& lines, std::int64_t first)
    : Nodes(lines.Nodes)
    , Stride(lines.Stride)
    , Count(static_cast<int>(std::min<std::int64_t>(lanes, lines.Count - first)))
  {
    for (int i = 0; i < lanes; ++i)
    {
      this->Begin[i] = lines.Begin(first + std::min(i, this->Count - 1));
    }
    // Neighbours in memory are copied as one cache line a node, which axes from 1 on have.
    this->Together = this->Begin[lanes - 1] == this->Begin[0] + lanes - 1 && this->Count == lanes;
  }

  // Copies the nodes of the lines to values[j][line].
  void Load(const double* grid, double* values) const
  {
    for (std::int64_t j = 0; j < this->Nodes; ++j, values += lanes)
    {
      const double* node = grid + j * this->Stride;
      if (this->Together)
      {
        std::memcpy(values, node + this->Begin[0], lanes * sizeof(double));
      }
      else
      {
        for (int i = 0; i < lanes; ++i)
        {
          values[i] = node[this->Begin[i]];
        }
      }
    }
  }
  // Copies values[j][line] back to the nodes.
  void Store(const double* values, double* grid) const
  {
    for (std::int64_t j = 0; j < this->Nodes; ++j, values += lanes)
    {
      double* node = grid + j * this->Stride;
      if (this->Together)
      {
        std::memcpy(node + this->Begin[0], values, lanes * sizeof(double));
      }
      else
      {
        for (int i = 0; i < this->Count; ++i)
        {
          node[this->Begin[i]] = values[i];
        }
      }
    }
  }

  std::int64_t Nodes;
  std::int64_t Stride;
  int Count;
  bool Together; // whether the lines are neighbours in memory
  std::int64_t Begin[lanes];
};

} // namespace

// The cosine transform of the first kind diagonalizes -Laplace with natural boundaries: along an
// axis of M cells of width h the eigenvalues are (2 sin(pi k / 2M) / h)^2.
template <int Dimension>
struct NodePoisson<Dimension>::Implementation
{
  static constexpr int Last = Dimension - 1;
  static constexpr int TransformedAxes = Dimension > 1 ? Dimension : 0; // see SolveLine

  explicit Implementation(const NodeGrid<Dimension>& grid)
    : Grid(grid)
    , Nodes(grid.NumberOfNodes())
    , Chunk(chunkOfRows(grid))
    , Weighted(grid)
  {
    for (int axis = 0; axis < TransformedAxes; ++axis)
    {
      const std::int64_t cells = grid.Cells[axis];
      this->Fourier.emplace_back(cells);
      this->Eigenvalues[axis].resize(static_cast<std::size_t>(cells + 1));
      // sin(pi k / 2M) comes from a table with the same bits on every machine.
      for (std::int64_t k = 0; k <= cells; ++k)
      {
        const double root = 2.0 * cosineAndSine(k, 4 * cells).Sine / grid.Spacing[axis];
        this->Eigenvalues[axis][static_cast<std::size_t>(k)] = root * root;
      }
    }
  }

  // Solves -Laplace p = masses with natural boundaries; masses and p have one value a node.
  void Solve(const double* masses, double* p, Progress& progress)
  {
    if constexpr (Dimension == 1)
    {
      this->SolveLine(masses, p, progress);
    }
    else
    {
      this->SolveByTransforms(masses, p, progress);
    }
  }

  // In one dimension the masses up to an edge are what flows through it: -p' = F by integration.
  // That takes fewer operations, and gives less rounding, than transforms.
  void SolveLine(const double* masses, double* p, Progress& progress)
  {
    const std::int64_t cells = this->Grid.Cells[0];
    const double number = static_cast<double>(cells);
    const double spacing = this->Grid.Spacing[0];
    // The flux between two nodes per difference of p: 1 / (M h^2), as the whole box has volume 1.
    const double conductance = 1.0 / (number * spacing * spacing);
    // The sum of the masses is taken as 0: its mean is subtracted.
    const double all =
      sumOverNodes(this->Grid, progress, [=](std::int64_t i) { return masses[i]; });
    double flux = 0.0;
    double value = 0.0;
    progress.ForEachInOrder(this->Nodes, this->Chunk, [&](std::int64_t i) {
      p[i] = value;
      flux += masses[i] - all * (shareOf(i, cells) / number);
      value -= flux / conductance;
    });
    // p is determined up to a constant; the solution has mean 0.
    const double mean = sumOverNodes(
      this->Grid, progress, [=](std::int64_t i) { return p[i] * (shareOf(i, cells) / number); });
    progress.ForEach(this->Nodes, this->Chunk, [=](std::int64_t i) { p[i] -= mean; });
  }

  // p = C^-1 (1 / lambda) C r: transforms along all axes, a division, and the same transforms back.
  // The arrays of all stages are p itself, and a block of lines that a thread holds.
  void SolveByTransforms(const double* masses, double* p, Progress& progress)
  {
    this->Along(
      0, 1, progress, [&](std::int64_t first, const PoissonBlock& block, CosineLines& lines) {
        this->LoadDensity(masses, first, block, lines.Values());
        lines.Transform();
        block.Store(lines.Values(), p);
      });
    const auto inPlace = [p](std::int64_t, const PoissonBlock& block, CosineLines& lines) {
      block.Load(p, lines.Values());
      lines.Transform();
      block.Store(lines.Values(), p);
    };
    for (int axis = 1; axis < Last; ++axis)
    {
      this->Along(axis, 1, progress, inPlace);
    }
    // Forwards and back along the last axis while the lines are in the cache.
    this->Along(
      Last, 2, progress, [&](std::int64_t first, const PoissonBlock& block, CosineLines& lines) {
        block.Load(p, lines.Values());
        this->TransformAndDivide(first, block, lines);
        block.Store(lines.Values(), p);
      });
    for (int axis = Last; axis-- > 0;)
    {
      this->Along(axis, 1, progress, inPlace);
    }
  }

  // Calls kernel(first, block, lines) for all blocks of eight lines along an axis. Adds
  // `transforms` units a node.
  template <class Kernel>
  void Along(int axis, int transforms, Progress& progress, const Kernel& kernel)
  {
    const NodeLines all(this->Grid, axis);
    // Units count nodes of lines, so that chunks of whole blocks have about 8192 of them.
    const std::int64_t line = all.Nodes * transforms;
    const std::int64_t block = lanes * line;
    progress.For(
      all.Count * line, std::max<std::int64_t>(1, 8192 / block) * block,
      [&](std::int64_t first, std::int64_t last) {
        CosineLines lines(this->Fourier[static_cast<std::size_t>(axis)]);
        for (; first < last; first += block)
        {
          kernel(first / line, PoissonBlock(all, first / line), lines);
        }
      },
      firstSlice);
  }

  // Loads lines along axis 0 of the density at nodes: masses over the nodes' shares of a cell.
  void LoadDensity(
    const double* masses, std::int64_t first, const PoissonBlock& block, double* values) const
  {
    double factors[lanes];
    for (int i = 0; i < lanes; ++i)
    {
      factors[i] = 1.0 / shareOfRow<Dimension>(this->Grid, first + std::min(i, block.Count - 1));
    }
    for (std::int64_t j = 0; j < block.Nodes; ++j)
    {
      const double ends = j == 0 || j == block.Nodes - 1 ? 2.0 : 1.0; // they stand for half a cell
      for (int i = 0; i < lanes; ++i)
      {
        values[j * lanes + i] = ends * factors[i] * masses[block.Begin[i] + j];
      }
    }
  }

  // The transform along the last axis, the division by the eigenvalues of the Laplacian, and the
  // transform back. All transforms of a density together with their inverses have the factor
  // 2^Dimension times the number of cells; a density is masses times this number.
  void TransformAndDivide(std::int64_t first, const PoissonBlock& block, CosineLines& lines) const
  {
    lines.Transform();
    constexpr double scale = 1.0 / (1 << Dimension);
    double* values = lines.Values();
    double others[lanes];
    for (int i = 0; i < lanes; ++i)
    {
      std::int64_t line = first + std::min(i, block.Count - 1);
      double sum = 0.0;
      for (int axis = 0; axis < Last; ++axis)
      {
        const std::int64_t nodes = this->Grid.Cells[axis] + 1;
        // A line's frequencies along the other axes add up to its part of the eigenvalue.
        sum += this->Eigenvalues[axis][static_cast<std::size_t>(line % nodes)];
        line /= nodes;
      }
      others[i] = sum;
      // Infinity divides the mean away: it is 0.
      values[i] *= scale / (sum > 0.0 ? sum : std::numeric_limits<double>::infinity());
    }
    for (std::size_t k = 1; k < this->Eigenvalues[Last].size(); ++k)
    {
      values += lanes;
      for (int i = 0; i < lanes; ++i)
      {
        values[i] *= scale / (others[i] + this->Eigenvalues[Last][k]);
      }
    }
    lines.Transform();
  }

  const NodeGrid<Dimension> Grid;
  const std::int64_t Nodes;
  const std::int64_t Chunk;                               // nodes: whole rows along axis 0
  std::vector<FourierTransform> Fourier;                  // along each axis
  std::array<std::vector<double>, Dimension> Eigenvalues; // eigenvalues of -Laplace along each axis
  WeightedPoisson<Dimension> Weighted;
};

template <int Dimension>
NodePoisson<Dimension>::NodePoisson(const NodeGrid<Dimension>& grid)
  : Self(std::make_unique<Implementation>(grid))
{
}

template <int Dimension>
NodePoisson<Dimension>::~NodePoisson() = default;

template <int Dimension>
void NodePoisson<Dimension>::Solve(const double* masses, double* p, Progress& progress)
{
  this->Self->Solve(masses, p, progress);
}

// The preconditioner divides by the Laplacian in O(n log n), so that a step of conjugate gradients
// costs two transforms along each axis.
template <int Dimension>
void NodePoisson<Dimension>::SolveWeighted(const double* masses, const double* density,
  double floor, int iterations, double* p, Progress& progress)
{
  // Solve is the exact inverse for the weight 1.
  const auto precondition = [&](const double* rest, double* solution) {
    this->Self->Solve(rest, solution, progress);
  };
  this->Self->Weighted.Solve(masses, density, floor, iterations, precondition, p, progress);
}

// An estimate, for one thread a processor.
template <int Dimension>
double NodePoisson<Dimension>::MemoryFor(const NodeGrid<Dimension>& grid, bool weighted)
{
  const double nodes = numberOfCorners<Dimension>(grid.Cells);
  double bytes = weighted ? WeightedPoisson<Dimension>::MemoryFor(grid) : 0.0;
  // Transforms of each length for every thread that has lines.
  const double threads = std::max(1u, std::thread::hardware_concurrency());
  for (int axis = 0; axis < Implementation::TransformedAxes; ++axis)
  {
    const std::int64_t cells = grid.Cells[axis];
    const double blocks = std::ceil(nodes / static_cast<double>(cells + 1) / lanes);
    bytes += std::min(blocks, threads) * CosineLines::MemoryFor(cells);
    bytes += sizeof(double) * static_cast<double>(cells + 1);
  }
  return bytes;
}

RECTIFIEDTRANSPORT_INSTANTIATE_CLASS(NodePoisson);

} // namespace RectifiedTransport
