// SPDX-License-Identifier: BSD-3-Clause
// A piecewise-constant density on a grid of unit cells (paper, Section 3.2): the interface to its
// values, and the error for a density without transport.
#ifndef RectifiedTransport_Density_h
#define RectifiedTransport_Density_h

#include "../Geometry/GridSize.h"
#include "DistributedDensity.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>

namespace RectifiedTransport
{

// Cells of at most this part of the mean density are thin: errors of areas and masses leave them
// out.
constexpr double leastOfMean = 0.05;

// The values of the grid cells, which are numbered with axis 0 fastest.
class DensityValues
{
public:
  virtual ~DensityValues() = default;
  // Writes the values of cells [first, first + count). Called from several threads.
  virtual void Read(std::int64_t first, std::int64_t count, double* values) const = 0;
};

// A grid and its values, which are in this process or distributed over ranks; it owns neither. Cell
// (i0, i1, i2) covers [i0, i0+1] x ... of index space.
template <int Dimension>
class DensitySource
{
public:
  DensitySource(const GridSize<Dimension>& size, const DensityValues& values)
    : Size(size)
    , Here(&values)
  {
  }
  DensitySource(const GridSize<Dimension>& size, const DistributedDensity<Dimension>& values)
    : Size(size)
    , OnRanks(&values)
  {
  }

  bool IsDistributed() const { return this->OnRanks != nullptr; }
  // The values of the cells from `low` up to `high`, each under its number in the whole grid, and
  // perhaps more. Collective, if the density is distributed. Throws std::bad_alloc.
  std::shared_ptr<const DensityValues> Part(
    const GridSize<Dimension>& low, const GridSize<Dimension>& high) const
  {
    // Without an owner if the values are in this process.
    return this->OnRanks
      ? this->OnRanks->Gather(low, high)
      : std::shared_ptr<const DensityValues>(std::shared_ptr<void>(), this->Here);
  }
  std::shared_ptr<const DensityValues> Whole() const { return this->Part({}, this->Size); }

  GridSize<Dimension> Size;

private:
  const DensityValues* Here = nullptr;
  const DistributedDensity<Dimension>* OnRanks = nullptr;
};

// A contiguous array of any arithmetic type, not owned.
template <int Dimension, class T>
class DensityArray final : public DensityValues
{
public:
  DensityArray(const T* values, const GridSize<Dimension>& size)
    : Values(values)
    , Size(size)
  {
  }
  operator DensitySource<Dimension>() const { return { this->Size, *this }; }
  void Read(std::int64_t first, std::int64_t count, double* values) const override
  {
    const T* source = this->Values + first;
    for (std::int64_t i = 0; i < count; ++i)
    {
      values[i] = static_cast<double>(source[i]);
    }
  }

private:
  const T* Values;
  GridSize<Dimension> Size;
};

// The result of one pass over a density. Indices are of grid cells, axis 0 fastest; -1 if there are
// none.
struct DensitySummary
{
  std::int64_t NotFinite = 0;
  std::int64_t FirstNotFinite = -1;
  std::int64_t Negative = 0;
  std::int64_t FirstNegative = -1;
  double Maximum = 0.0;
  // Among positive values: the number of cells with the largest one, the first of them, and the
  // largest value below it, 0 if there is none.
  std::int64_t Maxima = 0;
  std::int64_t FirstMaximum = -1;
  double BelowMaximum = 0.0;
  double Minimum = std::numeric_limits<double>::max();
  double Total = 0.0; // sum of the cells' values; infinite if it is beyond the largest double
};

// A density without transport: values that are negative or not finite, or a total that is zero or
// infinite.
class InvalidDensity : public std::runtime_error
{
public:
  explicit InvalidDensity(const DensitySummary& summary);
  const DensitySummary& Summary() const { return this->Found; }

private:
  DensitySummary Found;
};

} // namespace RectifiedTransport

#endif
