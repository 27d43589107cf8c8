// SPDX-License-Identifier: BSD-3-Clause
// One row of cells added to the summed-area tables (paper, Algorithm 2): the one kernel source,
// compiled once per instruction set (TableKernels*.cxx), by the same rules as FlowKernels.txx:
// internal linkage, and nothing of the standard library.
#include "Core/Tables/Kernels/TableKernels.h"

#include <cstring>

#define RT_INLINE inline __attribute__((always_inline))

namespace RectifiedTransport
{

namespace
{

// Eight lanes, the widest register's, for every instruction set: the order of additions is then the
// same.
constexpr int sumLanes = 8;

// Adds the lanes in a fixed order.
RT_INLINE double addLanes(const double (&lanes)[sumLanes])
{
  return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) +
    ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
}

// Cells 8 k + lane of a row are summed in lane `lane`. The moment is about the low face of the
// first cell, whose centre is at 1/2: place[lane] is the centre of the next cell of a lane.
RowInspection inspectRow(const double* values, std::int64_t count)
{
  constexpr double limit = 1.7976931348623157e308;
  alignas(64) double sum[sumLanes] = {};
  alignas(64) double moment[sumLanes] = {};
  alignas(64) double largest[sumLanes] = {};
  alignas(64) double smallest[sumLanes];
  alignas(64) double wrong[sumLanes] = {};
  alignas(64) double place[sumLanes];
  for (int lane = 0; lane < sumLanes; ++lane)
  {
    place[lane] = lane + 0.5;
    smallest[lane] = limit;
  }
  const std::int64_t whole = count / sumLanes * sumLanes;
  for (std::int64_t i = 0; i < whole; i += sumLanes)
  {
#pragma omp simd
    for (int lane = 0; lane < sumLanes; ++lane)
    {
      const double value = values[i + lane];
      sum[lane] += value;
      moment[lane] += value * place[lane];
      place[lane] += sumLanes;
      largest[lane] = value > largest[lane] ? value : largest[lane];
      smallest[lane] = value < smallest[lane] ? value : smallest[lane];
      // The negated comparison is true of NaN, too.
      wrong[lane] += (!(value >= 0.0) | !(value <= limit)) ? 1.0 : 0.0;
    }
  }
  // The rest of the row continues the first lanes.
  for (std::int64_t i = whole; i < count; ++i)
  {
    const double value = values[i];
    const std::int64_t lane = i - whole;
    sum[lane] += value;
    moment[lane] += value * (static_cast<double>(i) + 0.5);
    largest[lane] = value > largest[lane] ? value : largest[lane];
    smallest[lane] = value < smallest[lane] ? value : smallest[lane];
    wrong[lane] += (!(value >= 0.0) | !(value <= limit)) ? 1.0 : 0.0;
  }
  RowInspection found = { addLanes(sum), addLanes(moment), largest[0], smallest[0], 0 };
  for (int lane = 0; lane < sumLanes; ++lane)
  {
    found.Largest = found.Largest > largest[lane] ? found.Largest : largest[lane];
    found.Smallest = found.Smallest < smallest[lane] ? found.Smallest : smallest[lane];
    found.Wrong += static_cast<std::int64_t>(wrong[lane]);
  }
  return found;
}

// Counts are sums of ones in doubles, exact below 2^53, which vectorize with the comparisons.
RowMaximum countLargest(const double* values, std::int64_t count, double largest)
{
  alignas(64) double equal[sumLanes] = {};
  alignas(64) double below[sumLanes] = {};
  const std::int64_t whole = count / sumLanes * sumLanes;
  for (std::int64_t i = 0; i < whole; i += sumLanes)
  {
#pragma omp simd
    for (int lane = 0; lane < sumLanes; ++lane)
    {
      const double value = values[i + lane];
      equal[lane] += value == largest ? 1.0 : 0.0;
      const double other = value < largest ? value : 0.0;
      below[lane] = other > below[lane] ? other : below[lane];
    }
  }
  RowMaximum found = { 0, 0.0 };
  for (std::int64_t i = whole; i < count; ++i)
  {
    found.Count += values[i] == largest ? 1 : 0;
    found.Below = values[i] < largest && values[i] > found.Below ? values[i] : found.Below;
  }
  for (int lane = 0; lane < sumLanes; ++lane)
  {
    found.Count += static_cast<std::int64_t>(equal[lane]);
    found.Below = below[lane] > found.Below ? below[lane] : found.Below;
  }
  return found;
}

// Adds one row of a strip, in 3D, to the sums {f, f x_1} of every column; all cells of the row have
// the same x_1.
void addToColumns(
  const double* values, std::int64_t count, double centre, double* columns, double* moments)
{
#pragma omp simd
  for (std::int64_t i = 0; i < count; ++i)
  {
    columns[i] += values[i];
    moments[i] += values[i] * centre;
  }
}

// A record of a table, in the layout of TableView.h.
using NodeRecord = double __attribute__((vector_size(32)));

RT_INLINE NodeRecord loadNode(const double* node)
{
  NodeRecord value;
  std::memcpy(&value, node, sizeof(value));
  return value;
}

RT_INLINE void storeNode(double* node, NodeRecord value)
{
  std::memcpy(node, &value, sizeof(value));
}

// The node above cell (i, j) has the sums of all cells up to i and j. Algorithm 2 takes them from
// three neighbours, E_i+1,j+1 = E_i+1,j + E_i,j+1 - E_i,j + f_i,j. With running sums of f and f x_0
// along the row it is one addition to the node below, where nothing cancels. All cells of the row
// have the same x_1.
void addTableRow2D(const TableRow2D& row)
{
  double sum = row.Prefix[0];
  double moment = row.Prefix[1];
  double centre = static_cast<double>(row.First) + 0.5;
  for (std::int64_t i = 0; i < row.Count; ++i)
  {
    const double value = row.Values[i];
    sum += value;
    moment += value * centre;
    centre += 1.0;
    storeNode(row.Nodes + 4 * i,
      loadNode(row.Below + 4 * i) + NodeRecord{ sum, moment, sum * row.Centre, sum });
  }
}

// The same a dimension up: the row's running sums are added to those of the columns of the slice,
// and these to the nodes of the slice before. A column holds {f, f x_0, f x_1, f}. Its last entry
// becomes f x_2 by the slice's centre (`lift`).
void addTableRow3D(const TableRow3D& row)
{
  double sum = 0.0;
  double moment = 0.0;
  double centre = static_cast<double>(row.First) + 0.5;
  const NodeRecord lift = { 1.0, 1.0, 1.0, row.Centre[1] };
  for (std::int64_t i = 0; i < row.Count; ++i)
  {
    const double value = row.Values[i];
    sum += value;
    moment += value * centre;
    centre += 1.0;
    const NodeRecord column =
      loadNode(row.Columns + 4 * i) + NodeRecord{ sum, moment, sum * row.Centre[0], sum };
    storeNode(row.Columns + 4 * i, column);
    storeNode(row.Nodes + 4 * i, loadNode(row.Below + 4 * i) + column * lift);
  }
}

} // namespace

template <>
const TableKernels& tableKernelsOf<RECTIFIEDTRANSPORT_SET>()
{
  static const TableKernels kernels = { &inspectRow, &countLargest, &addToColumns, &addTableRow2D,
    &addTableRow3D };
  return kernels;
}

} // namespace RectifiedTransport
