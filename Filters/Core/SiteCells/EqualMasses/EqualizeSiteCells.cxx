// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/EqualMasses/EqualizeSiteCells.h"

#include "Core/Parallel/Stages.h"
#include "Core/SiteCells/EqualMasses/BorderMaxFlow.h"
#include "Core/SiteCells/PixelRows.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// This bound ends rounds that do not converge.
constexpr int mostRounds = 1000;
// Ends after this many consecutive rounds without a new minimum of the pixels in excess.
constexpr int mostIdleRounds = 64;

// Makes the numbers of pixels of site cells equal: in each round a maximum flow plans how many
// pixels pass each border, and those that cost least move. A round may move fewer than planned,
// because borders change with every pixel; the next round plans again.
template <int Dimension>
class Balance
{
public:
  Balance(
    const SiteDensity<Dimension>& sites, const Point<Dimension>& spacing, std::int64_t* owners)
    : Sites(sites)
    , Rows(sites.Size())
    , Owners(owners)
    , Cells(sites.NumberOfPixels())
    , Excess(static_cast<std::size_t>(this->Cells), 0)
    , Count(static_cast<std::size_t>(this->Cells), 0)
    , Weight(squaredSides<Dimension>(spacing))
    , Borders(this->Cells)
  {
  }

  // Throws Cancelled.
  void Run(Progress& progress)
  {
    Stages stages(progress, { { "counts", 1 }, { "rounds", 4 } });
    stages["counts"].ForEachInOrder(this->Rows.Count * this->Rows.Size[0], std::int64_t{ 1 } << 16,
      [this](std::int64_t pixel) { ++this->Count[this->Owners[pixel]]; });
    this->FillEmptyCells();
    this->SetTargets();
    if constexpr (Dimension == 1)
    {
      this->FillIntervals();
      return;
    }
    Rounds rounds(stages["rounds"], 1);
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (int round = 0, idle = 0; round < mostRounds && idle < mostIdleRounds; ++round, ++idle)
    {
      // The number of pixels that are in the wrong cells; 0 ends the rounds.
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
      Progress& work = rounds.Next().Expect(2 * this->Rows.Count);
      this->Moved = 0;
      this->FindBorders(work);
      // Each round plans a maximum flow of pixels over the borders as they are, then moves the
      // cheapest pixels.
      this->Borders.Plan(this->Excess, this->Count, work);
      this->Move(work);
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

  // Calls visit(pixel, neighbour) for all faces between pixels of two site cells.
  template <class Visit>
  void VisitBorders(Progress& progress, const Visit& visit)
  {
    constexpr std::int64_t pixels = std::int64_t{ 1 } << 16;
    const std::int64_t grain = std::max<std::int64_t>(1, pixels / this->Rows.Size[0]);
    progress.ForEachInOrder(
      this->Rows.Count, grain,
      [&](std::int64_t row) { this->Rows.VisitFaces(row, this->Owners, visit); }, grain);
  }

  // A site cell without pixels has no borders, so it gets the pixel of its sites. If that was
  // another cell's last pixel, that cell gets its own pixel next.
  void FillEmptyCells()
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
      // The pixel of the cell's sites, which belongs to another cell so far.
      std::int64_t& owner = this->Owners[this->Sites.Pixel(cell)];
      if (--this->Count[owner] == 0)
      {
        empty.push_back(owner);
      }
      owner = cell;
      this->Count[cell] = 1;
    }
  }

  // Sets the targets: the quotient of pixels and sites for each site. The remainder goes to the
  // cells that have most now, one for each site at most.
  void SetTargets()
  {
    const std::int64_t pixels = this->Rows.Count * this->Rows.Size[0];
    const std::int64_t each = pixels / this->Sites.NumberOfSites();
    std::int64_t left = pixels % this->Sites.NumberOfSites();
    for (std::int64_t cell = 0; cell < this->Cells; ++cell)
    {
      // Pixels that the cell has beyond the quotient for each of its sites.
      this->Excess[cell] = this->Count[cell] - each * this->Sites.SitesIn(cell);
    }
    std::vector<std::int64_t> order(static_cast<std::size_t>(this->Cells));
    std::iota(order.begin(), order.end(), std::int64_t{ 0 });
    std::stable_sort(order.begin(), order.end(), [this](std::int64_t a, std::int64_t b) {
      // Compares the excess for each site by cross multiplication.
      return this->Excess[a] * this->Sites.SitesIn(b) > this->Excess[b] * this->Sites.SitesIn(a);
    });
    for (const std::int64_t cell : order)
    {
      const std::int64_t more = std::min(left, this->Sites.SitesIn(cell));
      this->Excess[cell] -= more;
      left -= more;
    }
  }

  // In 1D, the optimal cells are intervals in the order of the sites.
  void FillIntervals()
  {
    std::int64_t* pixel = this->Owners;
    for (std::int64_t cell = 0; cell < this->Cells; ++cell)
    {
      pixel = std::fill_n(pixel, this->Count[cell] - this->Excess[cell], cell);
    }
  }

  // The excess is positive where a cell has too many pixels; all excesses sum to 0.
  std::int64_t TotalExcess() const
  {
    return std::accumulate(this->Excess.begin(), this->Excess.end(), std::int64_t{ 0 },
      [](
        std::int64_t sum, std::int64_t excess) { return sum + std::max<std::int64_t>(excess, 0); });
  }

  // Finds the borders of the current cells; the extent of each is its number of faces.
  void FindBorders(Progress& progress)
  {
    this->Borders.Clear();
    this->VisitBorders(progress, [this](std::int64_t pixel, std::int64_t other) {
      const auto [low, high] = std::minmax(this->Owners[pixel], this->Owners[other]);
      ++this->Borders[this->Borders.Add(low, high)].Extent;
    });
  }

  // Returns the change of a pixel's squared distance when it moves from one site to another, in
  // squares of its longest side.
  double CostOf(std::int64_t pixel, std::int64_t from, std::int64_t to) const
  {
    double cost = 0.0;
    std::int64_t x = pixel;
    std::int64_t a = this->Sites.Pixel(from);
    std::int64_t b = this->Sites.Pixel(to);
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const auto size = this->Rows.Size[axis];
      // Offsets from the old and the new site along an axis, in pixels.
      const auto old = static_cast<double>(x % size - a % size);
      const auto now = static_cast<double>(x % size - b % size);
      cost += this->Weight[axis] * (now * now - old * old);
      x /= size;
      a /= size;
      b /= size;
    }
    return cost;
  }

  // Collects the faces of each border with a flow as candidates, sorts them by cost, and moves as
  // many pixels as the flow demands.
  void Move(Progress& progress)
  {
    std::vector<std::int64_t> first(this->Borders.Size() + 1, 0);
    for (std::size_t i = 0; i < this->Borders.Size(); ++i)
    {
      first[i + 1] = first[i] + (this->Borders[i].Flow != 0 ? this->Borders[i].Extent : 0);
    }
    // One for each face of a border with a flow, grouped by borders.
    std::vector<Candidate> candidates(static_cast<std::size_t>(first.back()));
    std::vector<std::int64_t> next(first);
    this->VisitBorders(progress, [&](std::int64_t pixel, std::int64_t other) {
      std::int64_t low = this->Owners[pixel];
      std::int64_t high = this->Owners[other];
      if (low > high)
      {
        std::swap(low, high);
        std::swap(pixel, other);
      }
      const std::int64_t number = this->Borders.Find(low, high);
      const std::int64_t flow = this->Borders[number].Flow;
      if (flow != 0)
      {
        candidates[next[number]++] = flow > 0 ? Candidate{ this->CostOf(pixel, low, high), pixel }
                                              : Candidate{ this->CostOf(other, high, low), other };
      }
    });
    // The borders that still have moves.
    std::vector<std::size_t> pending;
    for (std::size_t i = 0; i < this->Borders.Size(); ++i)
    {
      progress.Check();
      if (this->Borders[i].Flow != 0)
      {
        std::sort(candidates.begin() + first[i], candidates.begin() + first[i + 1]);
        next[i] = first[i];
        pending.push_back(i);
      }
    }
    // A site cell of one pixel must receive another one before it loses its own, so that some moves
    // are deferred.
    for (std::int64_t before = -1; before != this->Moved;)
    {
      before = this->Moved;
      std::size_t left = 0;
      for (const std::size_t i : pending)
      {
        if (this->MoveFirst(this->Borders[i], candidates.data(), next[i], first[i + 1]))
        {
          pending[left++] = i;
        }
      }
      pending.resize(left);
      progress.Check();
    }
  }

  // Moves the cheapest candidates. A pixel with two faces to the other cell is listed twice, and a
  // pixel between three cells may have moved already, so its owner is checked. Returns true if a
  // cell of one pixel still has to lose it.
  bool MoveFirst(
    SiteCellBorder& border, const Candidate* candidates, std::int64_t& next, std::int64_t end)
  {
    // The flow is from `from` to `to`, one pixel at a time, cheapest first.
    const int sign = border.Flow > 0 ? 1 : -1;
    const std::int64_t from = sign > 0 ? border.Low : border.High;
    const std::int64_t to = sign > 0 ? border.High : border.Low;
    for (; next < end && border.Flow != 0 && this->Count[from] > 1; ++next)
    {
      std::int64_t& owner = this->Owners[candidates[next].Pixel];
      if (owner == from)
      {
        owner = to;
        --this->Count[from];
        ++this->Count[to];
        --this->Excess[from];
        ++this->Excess[to];
        border.Flow -= sign;
        ++this->Moved;
      }
    }
    return next < end && border.Flow != 0;
  }

  const SiteDensity<Dimension>& Sites;
  const PixelRows<Dimension> Rows;
  std::int64_t* Owners;
  const std::int64_t Cells;
  std::vector<std::int64_t> Excess; // pixels of a site cell less its target
  std::vector<std::int64_t> Count;
  const Point<Dimension> Weight;
  std::int64_t Moved = 0;
  BorderMaxFlow Borders;
};

} // namespace

template <int Dimension>
void equalizeSiteCells(const SiteDensity<Dimension>& sites, const Point<Dimension>& spacing,
  std::int64_t* owners, const Context& context)
{
  Progress progress(context);
  Balance<Dimension>(sites, spacing, owners).Run(progress);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(equalizeSiteCells);

} // namespace RectifiedTransport
