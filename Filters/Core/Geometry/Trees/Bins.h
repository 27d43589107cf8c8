// SPDX-License-Identifier: BSD-3-Clause
// Items in numbered bins, one after the other in memory.
#ifndef RectifiedTransport_Bins_h
#define RectifiedTransport_Bins_h

#include <cstddef>
#include <vector>

namespace RectifiedTransport
{

// A counting sort: one pass counts, the other one places. Contiguous memory, no list a bin.
template <class Item>
class Bins
{
public:
  struct Range
  {
    const Item* begin() const { return this->First; }
    const Item* end() const { return this->Last; }
    std::size_t Size() const { return static_cast<std::size_t>(this->Last - this->First); }

    const Item* First;
    const Item* Last;
  };

  // Fills the bins. visit(add) calls add(bin, item) for all items; it is called twice and must do
  // the same each time. An item may be in several bins. Within a bin, items are in the order of the
  // calls.
  template <class Visit>
  void Fill(std::size_t bins, const Visit& visit)
  {
    // Counts are stored at bin + 2. Summed, Begin[bin + 1] is where the bin begins, and once its
    // items are placed, where it ends.
    this->Begin.assign(bins + 2, 0);
    visit([this](std::size_t bin, const Item&) { ++this->Begin[bin + 2]; });
    for (std::size_t bin = 2; bin < this->Begin.size(); ++bin)
    {
      this->Begin[bin] += this->Begin[bin - 1];
    }
    this->Items.resize(this->Begin.back());
    visit(
      [this](std::size_t bin, const Item& item) { this->Items[this->Begin[bin + 1]++] = item; });
  }

  Range operator[](std::size_t bin) const { return this->Of(bin, bin); }
  // The items of several bins, the last one included.
  Range Of(std::size_t first, std::size_t last) const
  {
    const Item* items = this->Items.data();
    return { items + this->Begin[first], items + this->Begin[last + 1] };
  }

private:
  std::vector<std::size_t> Begin; // where each bin begins, and the end
  std::vector<Item> Items;        // bin after bin
};

} // namespace RectifiedTransport

#endif
