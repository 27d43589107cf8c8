// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/EqualizeSiteCells.h"

#include "Core/Parallel/Progress.h"
#include "Core/SiteCells/BorderMaxFlow.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr int mostRounds = 1000;
// Rounds that may pass without fewer pixels in excess than ever before.
constexpr int mostIdleRounds = 64;

template <int Dimension>
class Balance
{
public:
  Balance(const SiteDensity<Dimension>& sites, const Point<Dimension>& spacing,
    std::int64_t* owners, Progress& progress)
    : Sites(sites)
    , Size(sites.Size())
    , Owners(owners)
    , Pace(progress)
    , Cells(sites.NumberOfPixels())
    , Excess(static_cast<std::size_t>(this->Cells), 0)
    , Count(static_cast<std::size_t>(this->Cells), 0)
    , Contacts(this->Cells)
  {
    // Relative to the longest side: squares of lengths may pass the range of numbers.
    const double longest = *std::max_element(spacing.begin(), spacing.end());
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double side = spacing[axis] / longest;
      this->Weight[axis] = side * side;
      this->Stride[axis] = axis == 0 ? 1 : this->Stride[axis - 1] * this->Size[axis - 1];
    }
    this->Rows = this->Stride[Dimension - 1] * this->Size[Dimension - 1] / this->Size[0];
  }

  // Throws Cancelled.
  void Run()
  {
    this->Pace.BeginStage(0.2, this->Rows);
    this->VisitRows([this](std::int64_t row) {
      const std::int64_t* owner = this->Owners + row * this->Size[0];
      for (std::int64_t i = 0; i < this->Size[0]; ++i)
      {
        ++this->Count[owner[i]];
      }
    });
    this->SettleEmptyCells();
    this->SetTargets();
    if constexpr (Dimension == 1)
    {
      this->FillIntervals();
      return;
    }
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (int round = 0, idle = 0; round < mostRounds && idle < mostIdleRounds; ++round, ++idle)
    {
      const std::int64_t excess = this->TotalExcess();
      if (excess == 0)
      {
        break;
      }
      if (excess < least)
      {
        least = excess;
        idle = 0;
      }
      this->Pace.BeginStage(1.0 - 0.8 / (round + 2.0), 2 * this->Rows);
      this->Moved = 0;
      this->FindContacts();
      this->Contacts.Plan(this->Excess, this->Count, this->Pace);
      this->Move();
      if (this->Moved == 0)
      {
        break;
      }
    }
  }

private:
  struct Candidate
  {
    double Cost;
    std::int64_t Pixel;
    bool operator<(const Candidate& other) const
    {
      return this->Cost != other.Cost ? this->Cost < other.Cost : this->Pixel < other.Pixel;
    }
  };

  template <class Visit>
  void VisitRows(const Visit& visit)
  {
    constexpr std::int64_t pixels = std::int64_t{ 1 } << 16;
    const std::int64_t smallest = std::max<std::int64_t>(1, pixels / this->Size[0]);
    for (std::int64_t row = 0; row < this->Rows;)
    {
      const std::int64_t slice = std::min(this->Rows - row, this->Pace.NextSlice(smallest));
      for (const std::int64_t end = row + slice; row < end; ++row)
      {
        visit(row);
      }
      this->Pace.EndSlice(slice);
    }
  }

  // Calls visit(pixel, neighbour) for all faces between pixels of two cells.
  template <class Visit>
  void VisitBorders(const Visit& visit)
  {
    this->VisitRows([&](std::int64_t row) {
      std::int64_t position[Dimension] = {};
      for (std::int64_t rest = row, axis = 1; axis < Dimension; ++axis)
      {
        position[axis] = rest % this->Size[axis];
        rest /= this->Size[axis];
      }
      const std::int64_t first = row * this->Size[0];
      for (int axis = 0; axis < Dimension; ++axis)
      {
        const std::int64_t last = axis == 0 ? this->Size[0] - 1 : this->Size[0];
        if (axis > 0 && position[axis] + 1 == this->Size[axis])
        {
          continue;
        }
        for (std::int64_t pixel = first; pixel < first + last; ++pixel)
        {
          if (this->Owners[pixel] != this->Owners[pixel + this->Stride[axis]])
          {
            visit(pixel, pixel + this->Stride[axis]);
          }
        }
      }
    });
  }

  // A cell that got nothing touches no other. It begins with the pixel of its sites, and whoever
  // loses the last one does the same.
  void SettleEmptyCells()
  {
    std::vector<std::int64_t> empty;
    for (std::int64_t cell = this->Cells; cell-- > 0;)
    {
      if (this->Count[cell] == 0)
      {
        empty.push_back(cell);
      }
    }
    while (!empty.empty())
    {
      const std::int64_t cell = empty.back();
      empty.pop_back();
      std::int64_t& owner = this->Owners[this->Sites.Pixel(cell)];
      if (--this->Count[owner] == 0)
      {
        empty.push_back(owner);
      }
      owner = cell;
      this->Count[cell] = 1;
    }
  }

  // What does not divide goes to the cells that have most now.
  void SetTargets()
  {
    const std::int64_t pixels = this->Rows * this->Size[0];
    const std::int64_t each = pixels / this->Sites.NumberOfSites();
    std::int64_t left = pixels % this->Sites.NumberOfSites();
    for (std::int64_t cell = 0; cell < this->Cells; ++cell)
    {
      this->Excess[cell] = this->Count[cell] - each * this->Sites.SitesIn(cell);
    }
    std::vector<std::int64_t> order(static_cast<std::size_t>(this->Cells));
    std::iota(order.begin(), order.end(), std::int64_t{ 0 });
    std::stable_sort(order.begin(), order.end(), [this](std::int64_t a, std::int64_t b) {
      return this->Excess[a] * this->Sites.SitesIn(b) > this->Excess[b] * this->Sites.SitesIn(a);
    });
    for (const std::int64_t cell : order)
    {
      const std::int64_t more = std::min(left, this->Sites.SitesIn(cell));
      this->Excess[cell] -= more;
      left -= more;
    }
  }

  // On a line no other cells are nearer than intervals in the order of the sites.
  void FillIntervals()
  {
    std::int64_t* pixel = this->Owners;
    for (std::int64_t cell = 0; cell < this->Cells; ++cell)
    {
      pixel = std::fill_n(pixel, this->Count[cell] - this->Excess[cell], cell);
    }
  }

  std::int64_t TotalExcess() const
  {
    return std::accumulate(this->Excess.begin(), this->Excess.end(), std::int64_t{ 0 },
      [](
        std::int64_t sum, std::int64_t excess) { return sum + std::max<std::int64_t>(excess, 0); });
  }

  void FindContacts()
  {
    this->Contacts.Clear();
    this->VisitBorders([this](std::int64_t pixel, std::int64_t other) {
      const auto [low, high] = std::minmax(this->Owners[pixel], this->Owners[other]);
      ++this->Contacts[this->Contacts.Add(low, high)].Faces;
    });
  }

  // How much further a pixel is, in squared distance, from the one than from the other.
  double CostOf(std::int64_t pixel, std::int64_t from, std::int64_t to) const
  {
    double cost = 0.0;
    std::int64_t x = pixel;
    std::int64_t a = this->Sites.Pixel(from);
    std::int64_t b = this->Sites.Pixel(to);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto size = this->Size[axis];
      const auto old = static_cast<double>(x % size - a % size);
      const auto now = static_cast<double>(x % size - b % size);
      cost += this->Weight[axis] * (now * now - old * old);
      x /= size;
      a /= size;
      b /= size;
    }
    return cost;
  }

  void Move()
  {
    std::vector<std::int64_t> first(this->Contacts.Size() + 1, 0);
    for (std::size_t i = 0; i < this->Contacts.Size(); ++i)
    {
      first[i + 1] = first[i] + (this->Contacts[i].Flow != 0 ? this->Contacts[i].Faces : 0);
    }
    std::vector<Candidate> candidates(static_cast<std::size_t>(first.back()));
    std::vector<std::int64_t> next(first);
    this->VisitBorders([&](std::int64_t pixel, std::int64_t other) {
      std::int64_t low = this->Owners[pixel];
      std::int64_t high = this->Owners[other];
      if (low > high)
      {
        std::swap(low, high);
        std::swap(pixel, other);
      }
      const std::int64_t number = this->Contacts.Find(low, high);
      const std::int64_t flow = this->Contacts[number].Flow;
      if (flow != 0)
      {
        candidates[next[number]++] = flow > 0 ? Candidate{ this->CostOf(pixel, low, high), pixel }
                                              : Candidate{ this->CostOf(other, high, low), other };
      }
    });
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < this->Contacts.Size(); ++i)
    {
      this->Pace.Check();
      if (this->Contacts[i].Flow != 0)
      {
        std::sort(candidates.begin() + first[i], candidates.begin() + first[i + 1]);
        next[i] = first[i];
        waiting.push_back(i);
      }
    }
    // A cell of one pixel must get another before it gives its own, so that some moves wait.
    for (std::int64_t before = -1; before != this->Moved;)
    {
      before = this->Moved;
      std::size_t kept = 0;
      for (const std::size_t i : waiting)
      {
        if (this->MoveFirst(this->Contacts[i], candidates.data(), next[i], first[i + 1]))
        {
          waiting[kept++] = i;
        }
      }
      waiting.resize(kept);
      this->Pace.Check();
    }
  }

  // A pixel with two faces to the other cell is there twice, and one between three cells may have
  // moved already. True if a cell of one pixel has still to give it.
  bool MoveFirst(
    SiteCellBorder& contact, const Candidate* candidates, std::int64_t& next, std::int64_t end)
  {
    const int sign = contact.Flow > 0 ? 1 : -1;
    const std::int64_t from = sign > 0 ? contact.Low : contact.High;
    const std::int64_t to = sign > 0 ? contact.High : contact.Low;
    for (; next < end && contact.Flow != 0 && this->Count[from] > 1; ++next)
    {
      std::int64_t& owner = this->Owners[candidates[next].Pixel];
      if (owner == from)
      {
        owner = to;
        --this->Count[from];
        ++this->Count[to];
        --this->Excess[from];
        ++this->Excess[to];
        contact.Flow -= sign;
        ++this->Moved;
      }
    }
    return next < end && contact.Flow != 0;
  }

  const SiteDensity<Dimension>& Sites;
  const GridSize<Dimension> Size;
  std::int64_t* Owners;
  Progress& Pace;
  const std::int64_t Cells;
  std::vector<std::int64_t> Excess; // pixels that a cell has too many
  std::vector<std::int64_t> Count;
  double Weight[Dimension];
  std::int64_t Stride[Dimension];
  std::int64_t Rows;
  std::int64_t Moved = 0;
  BorderMaxFlow Contacts;
};

} // namespace

template <int Dimension>
void equalizeSiteCells(const SiteDensity<Dimension>& sites, const Point<Dimension>& spacing,
  std::int64_t* owners, const Context& context)
{
  Progress progress(context);
  Balance<Dimension>(sites, spacing, owners, progress).Run();
}

template void equalizeSiteCells<1>(
  const SiteDensity<1>&, const Point<1>&, std::int64_t*, const Context&);
template void equalizeSiteCells<2>(
  const SiteDensity<2>&, const Point<2>&, std::int64_t*, const Context&);
template void equalizeSiteCells<3>(
  const SiteDensity<3>&, const Point<3>&, std::int64_t*, const Context&);

} // namespace RectifiedTransport
