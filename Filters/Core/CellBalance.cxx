// SPDX-License-Identifier: BSD-3-Clause
#include "CellBalance.h"

#include "Pacer.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace RectifiedTransport
{

namespace
{

constexpr int mostRounds = 64;

template <int Dimension>
class Balance
{
public:
  Balance(const SitePixels<Dimension>& sites, const Point<Dimension>& spacing, std::int64_t* owners,
    Pacer& pacer)
    : Sites(sites)
    , Size(sites.Size())
    , Owners(owners)
    , Pace(pacer)
    , Cells(sites.NumberOfPixels())
    , Excess(static_cast<std::size_t>(this->Cells), 0)
    , Count(static_cast<std::size_t>(this->Cells), 0)
  {
    for (int axis = 0; axis < Dimension; ++axis)
    {
      this->Weight[axis] = spacing[axis] * spacing[axis];
      this->Stride[axis] = axis == 0 ? 1 : this->Stride[axis - 1] * this->Size[axis - 1];
    }
    this->Rows = this->Stride[Dimension - 1] * this->Size[Dimension - 1] / this->Size[0];
  }

  // False if the host wants to stop.
  bool Run()
  {
    this->Pace.BeginStage(0.2, this->Rows);
    if (!this->VisitRows([this](std::int64_t row) {
          const std::int64_t* owner = this->Owners + row * this->Size[0];
          for (std::int64_t i = 0; i < this->Size[0]; ++i)
          {
            ++this->Count[owner[i]];
          }
        }))
    {
      return false;
    }
    this->SettleEmptyCells();
    this->SetTargets();
    for (int round = 0; round < mostRounds && !this->IsBalanced(); ++round)
    {
      this->Pace.BeginStage(1.0 - 0.8 / (round + 2.0), 2 * this->Rows);
      this->Moved = 0;
      if (!this->FindContacts() || !this->Plan() || !this->Move())
      {
        return false;
      }
      if (this->Moved == 0)
      {
        break;
      }
    }
    return true;
  }

private:
  // Two cells that touch.
  struct Contact
  {
    std::int64_t Low; // Low < High
    std::int64_t High;
    std::int64_t Faces = 0;
    std::int64_t Flow = 0; // pixels to go from Low to High
  };

  struct Neighbour
  {
    std::int64_t Cell;
    std::int64_t Contact;
    int Sign; // of a flow to that cell
  };

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
  bool VisitRows(const Visit& visit)
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
      if (!this->Pace.EndSlice(slice))
      {
        return false;
      }
    }
    return true;
  }

  // Calls visit(pixel, neighbour) for all faces between pixels of two cells.
  template <class Visit>
  bool VisitBorders(const Visit& visit)
  {
    return this->VisitRows([&](std::int64_t row) {
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

  bool IsBalanced() const
  {
    return std::all_of(
      this->Excess.begin(), this->Excess.end(), [](std::int64_t excess) { return excess == 0; });
  }

  std::int64_t Key(std::int64_t low, std::int64_t high) const { return low * this->Cells + high; }

  bool FindContacts()
  {
    this->Contacts.clear();
    this->ContactOf.clear();
    if (!this->VisitBorders([this](std::int64_t pixel, std::int64_t other) {
          const auto [low, high] = std::minmax(this->Owners[pixel], this->Owners[other]);
          const auto next = static_cast<std::int64_t>(this->Contacts.size());
          const auto [found, isNew] = this->ContactOf.try_emplace(this->Key(low, high), next);
          if (isNew)
          {
            this->Contacts.push_back({ low, high });
          }
          ++this->Contacts[found->second].Faces;
        }))
    {
      return false;
    }
    this->FirstNeighbour.assign(static_cast<std::size_t>(this->Cells) + 1, 0);
    for (const Contact& contact : this->Contacts)
    {
      ++this->FirstNeighbour[contact.Low + 1];
      ++this->FirstNeighbour[contact.High + 1];
    }
    std::partial_sum(
      this->FirstNeighbour.begin(), this->FirstNeighbour.end(), this->FirstNeighbour.begin());
    this->Neighbours.resize(2 * this->Contacts.size());
    std::vector<std::int64_t> next(this->FirstNeighbour);
    for (std::size_t i = 0; i < this->Contacts.size(); ++i)
    {
      const Contact& contact = this->Contacts[i];
      const auto number = static_cast<std::int64_t>(i);
      this->Neighbours[next[contact.Low]++] = { contact.High, number, 1 };
      this->Neighbours[next[contact.High]++] = { contact.Low, number, -1 };
    }
    return true;
  }

  // How much more may flow: half of the pixels of a border, that it stays where it is.
  std::int64_t Capacity(const Neighbour& to) const
  {
    const Contact& contact = this->Contacts[to.Contact];
    return std::max<std::int64_t>(1, contact.Faces / 2) - to.Sign * contact.Flow;
  }

  // Sends what a cell has too many of to the nearest ones, from neighbour to neighbour, that have
  // too few. What finds no way waits for the next round.
  bool Plan()
  {
    std::vector<char> isCut(static_cast<std::size_t>(this->Cells), 0);
    this->From.assign(static_cast<std::size_t>(this->Cells), nullptr);
    this->Seen.assign(static_cast<std::size_t>(this->Cells), -1);
    this->Searches = 0;
    std::vector<std::int64_t> open(this->Excess);
    for (std::int64_t cell = 0; cell < this->Cells; ++cell)
    {
      while (open[cell] > 0 && !isCut[cell])
      {
        const std::int64_t end = this->FindDeficit(cell, open, isCut);
        if (this->Pace.ShouldStop())
        {
          return false;
        }
        if (end >= 0)
        {
          this->Send(cell, end, open);
        }
      }
    }
    return true;
  }

  // The nearest cell that has too few; -1 if there is none, and all that were seen are then cut.
  std::int64_t FindDeficit(
    std::int64_t start, const std::vector<std::int64_t>& open, std::vector<char>& isCut)
  {
    const std::int64_t search = this->Searches++;
    this->Queue.assign(1, start);
    this->Seen[start] = search;
    for (std::size_t at = 0; at < this->Queue.size(); ++at)
    {
      const std::int64_t cell = this->Queue[at];
      for (std::int64_t i = this->FirstNeighbour[cell]; i < this->FirstNeighbour[cell + 1]; ++i)
      {
        const Neighbour& to = this->Neighbours[i];
        if (this->Seen[to.Cell] == search || isCut[to.Cell] || this->Capacity(to) <= 0)
        {
          continue;
        }
        this->Seen[to.Cell] = search;
        this->From[to.Cell] = &to;
        if (open[to.Cell] < 0)
        {
          return to.Cell;
        }
        this->Queue.push_back(to.Cell);
      }
    }
    for (const std::int64_t cell : this->Queue)
    {
      isCut[cell] = 1;
    }
    return -1;
  }

  void Send(std::int64_t start, std::int64_t end, std::vector<std::int64_t>& open)
  {
    std::int64_t amount = std::min(open[start], -open[end]);
    const auto before = [this](const Neighbour& step) {
      const Contact& contact = this->Contacts[step.Contact];
      return step.Sign > 0 ? contact.Low : contact.High;
    };
    for (std::int64_t cell = end; cell != start; cell = before(*this->From[cell]))
    {
      amount = std::min(amount, this->Capacity(*this->From[cell]));
    }
    for (std::int64_t cell = end; cell != start; cell = before(*this->From[cell]))
    {
      const Neighbour& step = *this->From[cell];
      this->Contacts[step.Contact].Flow += step.Sign * amount;
    }
    open[start] -= amount;
    open[end] += amount;
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

  bool Move()
  {
    std::vector<std::int64_t> first(this->Contacts.size() + 1, 0);
    for (std::size_t i = 0; i < this->Contacts.size(); ++i)
    {
      first[i + 1] = first[i] + (this->Contacts[i].Flow != 0 ? this->Contacts[i].Faces : 0);
    }
    std::vector<Candidate> candidates(static_cast<std::size_t>(first.back()));
    std::vector<std::int64_t> next(first);
    if (!this->VisitBorders([&](std::int64_t pixel, std::int64_t other) {
          std::int64_t low = this->Owners[pixel];
          std::int64_t high = this->Owners[other];
          if (low > high)
          {
            std::swap(low, high);
            std::swap(pixel, other);
          }
          const std::int64_t number = this->ContactOf.find(this->Key(low, high))->second;
          const std::int64_t flow = this->Contacts[number].Flow;
          if (flow != 0)
          {
            candidates[next[number]++] = flow > 0
              ? Candidate{ this->CostOf(pixel, low, high), pixel }
              : Candidate{ this->CostOf(other, high, low), other };
          }
        }))
    {
      return false;
    }
    for (std::size_t i = 0; i < this->Contacts.size(); ++i)
    {
      const Contact& contact = this->Contacts[i];
      if (contact.Flow != 0)
      {
        std::sort(candidates.begin() + first[i], candidates.begin() + first[i + 1]);
        this->MoveFirst(contact, candidates.data() + first[i], candidates.data() + first[i + 1]);
      }
      if (this->Pace.ShouldStop())
      {
        return false;
      }
    }
    return true;
  }

  // A pixel with two faces to the other cell is there twice, and one between three cells may have
  // moved already.
  void MoveFirst(const Contact& contact, const Candidate* begin, const Candidate* end)
  {
    const bool up = contact.Flow > 0;
    const std::int64_t from = up ? contact.Low : contact.High;
    const std::int64_t to = up ? contact.High : contact.Low;
    std::int64_t left = up ? contact.Flow : -contact.Flow;
    for (; begin != end && left > 0 && this->Count[from] > 1; ++begin)
    {
      if (this->Owners[begin->Pixel] == from)
      {
        this->Owners[begin->Pixel] = to;
        --this->Count[from];
        ++this->Count[to];
        --this->Excess[from];
        ++this->Excess[to];
        --left;
        ++this->Moved;
      }
    }
  }

  const SitePixels<Dimension>& Sites;
  const GridSize<Dimension> Size;
  std::int64_t* Owners;
  Pacer& Pace;
  const std::int64_t Cells;
  std::vector<std::int64_t> Excess; // pixels that a cell has too many
  std::vector<std::int64_t> Count;
  double Weight[Dimension];
  std::int64_t Stride[Dimension];
  std::int64_t Rows;
  std::int64_t Moved = 0;
  std::vector<Contact> Contacts;
  std::unordered_map<std::int64_t, std::int64_t> ContactOf;
  std::vector<std::int64_t> FirstNeighbour;
  std::vector<Neighbour> Neighbours;
  std::vector<const Neighbour*> From;
  std::vector<std::int64_t> Seen;
  std::vector<std::int64_t> Queue;
  std::int64_t Searches = 0;
};

} // namespace

template <int Dimension>
bool balanceCells(const SitePixels<Dimension>& sites, const Point<Dimension>& spacing,
  std::int64_t* owners, const Monitor& monitor)
{
  Pacer pacer(monitor);
  return Balance<Dimension>(sites, spacing, owners, pacer).Run();
}

template bool balanceCells<1>(const SitePixels<1>&, const Point<1>&, std::int64_t*, const Monitor&);
template bool balanceCells<2>(const SitePixels<2>&, const Point<2>&, std::int64_t*, const Monitor&);
template bool balanceCells<3>(const SitePixels<3>&, const Point<3>&, std::int64_t*, const Monitor&);

} // namespace RectifiedTransport
