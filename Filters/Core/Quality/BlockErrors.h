// SPDX-License-Identifier: BSD-3-Clause
// The largest relative errors of the areas or masses of blocks.
#ifndef RectifiedTransport_BlockErrors_h
#define RectifiedTransport_BlockErrors_h

#include <cstdint>
#include <limits>
#include <vector>

namespace RectifiedTransport
{

class Ranks;

// In place of the mass or error of a block that does not count.
constexpr double Uncounted = -1.0;

// Returns the errors that count, in their order.
std::vector<double> countedOf(std::vector<double> errors);

// The largest values of all ranks, `count` of them, or all if there are fewer; in no order.
// Collective.
std::vector<double> largestOf(std::vector<double> own, std::int64_t count, const Ranks& ranks);

// NaN if there are no blocks.
struct BlockErrors
{
  // The quantile that 99.9 % of the blocks do not exceed.
  double Quantile = std::numeric_limits<double>::quiet_NaN();
  double Largest = std::numeric_limits<double>::quiet_NaN();
};

// Finds the largest error and the quantile over the blocks of all ranks. With n errors numbered
// from 0 in ascending order, the quantile is number floor(0.999 n). Each rank sends at most a
// thousandth of n values. Collective.
BlockErrors largestErrors(std::vector<double> own, const Ranks& ranks);

} // namespace RectifiedTransport

#endif
