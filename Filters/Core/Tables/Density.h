// SPDX-License-Identifier: BSD-3-Clause
// A piecewise-constant density on a grid of unit cells: how the tables read it, and what is wrong
// with one that cannot be transported.
#ifndef RectifiedTransport_Density_h
#define RectifiedTransport_Density_h

#include <array>
#include <cstdint>
#include <stdexcept>

namespace RectifiedTransport
{

template <int Dimension>
using GridSize = std::array<std::int64_t, Dimension>;

template <int Dimension>
using Point = std::array<double, Dimension>;

// The place of a point in its cell, of unit sides.
template <int Dimension>
Point<Dimension> cellCentre()
{
  Point<Dimension> centre;
  centre.fill(0.5);
  return centre;
}

// Not an integer: what a user asks for may be more than fits into one.
template <int Dimension>
double numberOfCells(const GridSize<Dimension>& size)
{
  double count = 1.0;
  for (const std::int64_t cells : size)
  {
    count *= static_cast<double>(cells);
  }
  return count;
}

// Cell (i0, i1, i2) covers [i0, i0+1] x ... of index space; axis 0 runs fastest. A row is a line
// of cells along axis 0; row numbers run over the other axes, axis 1 fastest.
template <int Dimension>
class DensitySource
{
public:
  virtual ~DensitySource() = default;
  virtual GridSize<Dimension> Size() const = 0;
  // Writes the values of cells [first, first + count) of a row. Called from several threads.
  virtual void ReadRow(
    std::int64_t row, std::int64_t first, std::int64_t count, double* values) const = 0;
};

// A contiguous array of any arithmetic type, not owned.
template <int Dimension, class T>
class DensityArray final : public DensitySource<Dimension>
{
public:
  DensityArray(const T* values, const GridSize<Dimension>& size)
    : Values(values)
    , Dims(size)
  {
  }
  GridSize<Dimension> Size() const override { return this->Dims; }
  void ReadRow(
    std::int64_t row, std::int64_t first, std::int64_t count, double* values) const override
  {
    const T* source = this->Values + row * this->Dims[0] + first;
    for (std::int64_t i = 0; i < count; ++i)
    {
      values[i] = static_cast<double>(source[i]);
    }
  }

private:
  const T* Values;
  GridSize<Dimension> Dims;
};

// What one pass over a density finds. Indices count cells, axis 0 fastest; -1 if there are none.
struct DensitySummary
{
  std::int64_t NotFinite = 0;
  std::int64_t FirstNotFinite = -1;
  std::int64_t Negative = 0;
  std::int64_t FirstNegative = -1;
  double Maximum = 0.0;
  double Total = 0.0; // sum of the cells' values; infinite if it passes the largest double
};

// A density that has no transport: values that are not finite or negative, or a total that is zero
// or infinite.
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
