// SPDX-License-Identifier: BSD-3-Clause
// How the cells along one axis overlap bins: the cells between nodes, or the nodes' hats.
#ifndef RectifiedTransport_AxisShares_h
#define RectifiedTransport_AxisShares_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace RectifiedTransport
{

// Each cell has its share in a few consecutive bins. Shares of a cell sum to 1.
class AxisShares
{
public:
  AxisShares(std::int64_t cells, double low, double side, std::int64_t nodeCells, bool hats)
  {
    for (std::int64_t cell = 0; cell < cells; ++cell)
    {
      this->Begin.push_back(this->Shares.size());
      const double whole = static_cast<double>(nodeCells);
      const double from = std::clamp(low + side * static_cast<double>(cell), 0.0, whole);
      const double to = std::clamp(low + side * static_cast<double>(cell + 1), from, whole);
      const auto first = std::min(static_cast<std::int64_t>(from), nodeCells - 1);
      const auto end = std::clamp(static_cast<std::int64_t>(std::ceil(to)), first + 1, nodeCells);
      this->First.push_back(first);
      this->Shares.resize(
        this->Shares.size() + static_cast<std::size_t>(end - first) + (hats ? 1 : 0));
      double* shares = this->Shares.data() + this->Begin.back();
      for (std::int64_t bin = first; bin < end; ++bin)
      {
        const double a = std::max(from, static_cast<double>(bin));
        const double b = std::min(to, static_cast<double>(bin + 1));
        // The overlap of the cell with the interval between two nodes, relative to the cell.
        const double share = to > from ? std::max(0.0, b - a) / (to - from) : 1.0;
        if (hats)
        {
          // The integral of both hats over an interval is that at its middle, as they are linear
          // there.
          const double middle = 0.5 * (a + b) - static_cast<double>(bin);
          shares[bin - first] += share * (1.0 - middle);
          shares[bin - first + 1] += share * middle;
        }
        else
        {
          shares[bin - first] += share;
        }
      }
    }
    this->Begin.push_back(this->Shares.size());
  }

  // Calls visit(bin, share) for the bins that a cell overlaps.
  template <class Visit>
  void ForBins(std::int64_t cell, const Visit& visit) const
  {
    const auto c = static_cast<std::size_t>(cell);
    for (std::size_t i = this->Begin[c]; i < this->Begin[c + 1]; ++i)
    {
      if (this->Shares[i] != 0.0)
      {
        visit(this->First[c] + static_cast<std::int64_t>(i - this->Begin[c]), this->Shares[i]);
      }
    }
  }

private:
  std::vector<std::int64_t> First;
  std::vector<std::size_t> Begin;
  std::vector<double> Shares;
};

} // namespace RectifiedTransport

#endif
