// SPDX-License-Identifier: BSD-3-Clause
// Items that lie in layers of a grid, for a walk upwards through batches of layers that touches
// each item only where it lies.
#ifndef RectifiedTransport_LayerBins_h
#define RectifiedTransport_LayerBins_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace RectifiedTransport
{

// Layers [First, End).
struct LayerSpan
{
  std::int64_t First;
  std::int64_t End;
};

class LayerBins
{
public:
  explicit LayerBins(std::vector<LayerSpan> spans)
    : Spans(std::move(spans))
    , Order(this->Spans.size())
  {
    std::iota(this->Order.begin(), this->Order.end(), std::int64_t{ 0 });
    const auto isBelow = [this](std::int64_t a, std::int64_t b) {
      return this->Of(a).First < this->Of(b).First;
    };
    if (!std::is_sorted(this->Order.begin(), this->Order.end(), isBelow))
    {
      std::sort(this->Order.begin(), this->Order.end(), isBelow);
    }
  }

  // Returns the items that lie in a batch. Batches must ascend.
  const std::vector<std::int64_t>& In(const LayerSpan& batch)
  {
    // Items that end below the batch leave; items that begin in it enter, in the order of their
    // beginnings.
    const auto isBelow = [&](std::int64_t item) { return this->Of(item).End <= batch.First; };
    this->Found.erase(
      std::remove_if(this->Found.begin(), this->Found.end(), isBelow), this->Found.end());
    for (; this->Next < this->Order.size() && this->Of(this->Order[this->Next]).First < batch.End;
         ++this->Next)
    {
      if (!isBelow(this->Order[this->Next]))
      {
        this->Found.push_back(this->Order[this->Next]);
      }
    }
    return this->Found;
  }

private:
  const LayerSpan& Of(std::int64_t item) const
  {
    return this->Spans[static_cast<std::size_t>(item)];
  }

  std::vector<LayerSpan> Spans;
  std::vector<std::int64_t> Order;
  std::vector<std::int64_t> Found;
  std::size_t Next = 0;
};

} // namespace RectifiedTransport

#endif
