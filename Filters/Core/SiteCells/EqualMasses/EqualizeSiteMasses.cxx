// SPDX-License-Identifier: BSD-3-Clause
#include "Core/SiteCells/EqualMasses/EqualizeSiteMasses.h"

#include "Core/Geometry/Trees/Bins.h"
#include "Core/Parallel/Stages.h"
#include "Core/SiteCells/EqualMasses/BorderMaxFlow.h"
#include "Core/SiteCells/PixelRows.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <vector>

namespace RectifiedTransport
{

namespace
{

// This bound ends rounds that do not settle.
constexpr int mostMassRounds = 1000;
// Ends after this many consecutive rounds of little gain: 3 if no two groups differ by more than
// the heaviest pixel, 10 if none differs by more from its share, and 64 in any case.
constexpr int idleRounds = 3;
constexpr int moreIdleRounds = 10;
constexpr int mostIdleMassRounds = 64;

// Makes the masses of groups equal, as EqualizeSiteCells.cxx does with numbers of pixels. Pixels
// have different masses and are indivisible, so that the rounds end when they gain nothing more.
template <int Dimension>
class MassBalance
{
public:
  MassBalance(const SiteGroups& groups, const PixelMasses<Dimension>& masses,
    ConstPointSpan<Dimension> places, const Point<Dimension>& spacing, std::int64_t* owners)
    : Groups(groups)
    , Masses(masses)
    , Rows(masses.Size())
    , Places(places)
    , Owners(owners)
    , Count(groups.NumberOfGroups())
    , Mass(static_cast<std::size_t>(this->Count), 0)
    , Excess(this->Mass)
    , Planned(this->Mass)
    , Weight(squaredSides<Dimension>(spacing))
    , Borders(this->Count)
  {
    // The mean mass of a pixel, at least one unit: the scale on which a pixel counts as light.
    this->MeanMass = std::max<std::int64_t>(1, masses.Total() / masses.NumberOfPixels());
    this->FirstFace.resize(static_cast<std::size_t>(this->Rows.Count) + 1);
  }

  // Throws Cancelled.
  void Run(Progress& progress)
  {
    Stages stages(progress, { { "masses", 1 }, { "rounds", 4 } });
    this->SumMasses(stages["masses"]);
    Rounds rounds(stages["rounds"], 1);
    double least = 2.0 * static_cast<double>(this->Masses.Total());
    int stuck = 0;
    for (int round = 0, idle = 0; round < mostMassRounds && idle < mostIdleMassRounds && stuck < 3;
         ++round, ++idle)
    {
      // A gain is a reduction of the total deviation by 1 %.
      constexpr double gain = 0.99;
      // Rounding may make pixels of equal mass differ by so many units.
      constexpr std::int64_t rounding = 16;
      double all = 0.0;
      for (const std::int64_t excess : this->Excess)
      {
        // The total deviation decides about progress, the range of the deviations about the end.
        all += static_cast<double>(std::abs(excess));
      }
      const auto [lowest, highest] = std::minmax_element(this->Excess.begin(), this->Excess.end());
      // Two groups that differ by less than the heaviest pixel cannot become more equal by moving
      // it.
      const std::int64_t range = *highest - *lowest;
      if (all < gain * least)
      {
        least = all;
        idle = 0;
      }
      const bool isSettled = idle >= idleRounds;
      const std::int64_t heaviest = this->Masses.Heaviest();
      if (range == 0 || (isSettled && range <= heaviest + rounding) ||
        (idle >= moreIdleRounds && std::max(*highest, -*lowest) <= heaviest))
      {
        break;
      }
      Progress& work = rounds.Next().Expect(2 * this->Rows.Count);
      this->TakesLighter = isSettled;
      this->FindFaces(work);
      this->FindBorders();
      this->Borders.Plan(
        isSettled ? this->LargeExcess(round % 2 == 0) : this->Excess, this->Mass, work);
      // Without a move, only rounds of the other kinds may still find one.
      stuck = this->Move(work) ? 0 : stuck + 1;
      idle = stuck > 0 ? std::max(idle, idleRounds) : idle;
    }
  }

private:
  struct Face
  {
    std::int64_t Pixel;
    std::int64_t Other;
    std::int64_t Border;
  };

  struct Candidate
  {
    double Cost;
    std::int64_t Pixel;
    // The cheapest one is on top of a heap.
    bool operator<(const Candidate& other) const
    {
      return this->Cost != other.Cost ? this->Cost > other.Cost : this->Pixel > other.Pixel;
    }
  };

  // Calls visit(row) on all threads.
  template <class Visit>
  void VisitRows(Progress& progress, const Visit& visit) const
  {
    constexpr std::int64_t pixels = std::int64_t{ 1 } << 14;
    const std::int64_t grain = std::max<std::int64_t>(1, pixels / this->Rows.Size[0]);
    progress.ForEach(this->Rows.Count, grain, visit, grain);
  }

  void SumMasses(Progress& progress)
  {
    progress.ForEachInOrder(this->Masses.NumberOfPixels(), std::int64_t{ 1 } << 16,
      [this](std::int64_t pixel) { this->Mass[this->Owners[pixel]] += this->Masses[pixel]; });
    // Quotient and remainder do not overflow; the remainder, below one unit for each site, is far
    // below the mass of a pixel.
    const std::int64_t sites = this->Groups.NumberOfSites();
    const std::int64_t each = this->Masses.Total() / sites;
    std::int64_t left = this->Masses.Total() % sites;
    for (std::int64_t group = 0; group < this->Count; ++group)
    {
      const std::int64_t more = std::min(left, this->Groups.SitesIn(group));
      left -= more;
      this->Excess[group] = this->Mass[group] - each * this->Groups.SitesIn(group) - more;
    }
  }

  // Returns the excess, except that of groups with too much (or with too little) whose masses are
  // as equal as pixels allow. They would only pass their pixels around.
  const std::vector<std::int64_t>& LargeExcess(bool isOfTooMuch)
  {
    this->Planned = this->Excess;
    for (std::int64_t& excess : this->Planned)
    {
      const bool isLarge = 2 * std::abs(excess) > this->Masses.Heaviest();
      excess = isLarge || (excess > 0) != isOfTooMuch ? excess : 0;
    }
    return this->Planned;
  }

  // Lists all faces between groups in the order of the rows: counts, prefix sums, then a second
  // pass in parallel.
  void FindFaces(Progress& progress)
  {
    this->FirstFace[0] = 0;
    this->VisitRows(progress, [this](std::int64_t row) {
      std::int64_t faces = 0;
      this->Rows.VisitFaces(row, this->Owners, [&faces](std::int64_t, std::int64_t) { ++faces; });
      this->FirstFace[row + 1] = faces;
    });
    std::partial_sum(this->FirstFace.begin(), this->FirstFace.end(), this->FirstFace.begin());
    this->Faces.resize(static_cast<std::size_t>(this->FirstFace.back()));
    this->VisitRows(progress, [this](std::int64_t row) {
      Face* face = this->Faces.data() + this->FirstFace[row];
      this->Rows.VisitFaces(row, this->Owners, [&face](std::int64_t pixel, std::int64_t other) {
        *face++ = { pixel, other, -1 };
      });
    });
  }

  // Finds the borders and their capacities. A border without mass has the capacity of one in a
  // uniform density, because the mass behind it may have to move; a border of one face lets its
  // pixel pass.
  void FindBorders()
  {
    this->Borders.Clear();
    for (Face& face : this->Faces)
    {
      const auto [low, high] = std::minmax(this->Owners[face.Pixel], this->Owners[face.Other]);
      face.Border = this->Borders.Add(low, high);
      const std::int64_t mass =
        std::max({ this->Masses[face.Pixel], this->Masses[face.Other], this->MeanMass });
      std::int64_t& extent = this->Borders[face.Border].Extent;
      extent = std::max(extent + mass, 2 * mass);
    }
  }

  // Returns the change of the squared distance |x - b|^2 - |x - a|^2 = (a - b) . (2 x - a - b) when
  // a pixel moves from the group at a to that at b.
  double CostOf(std::int64_t pixel, std::int64_t from, std::int64_t to) const
  {
    const double* a = this->Places[from];
    const double* b = this->Places[to];
    double cost = 0.0;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const double x = static_cast<double>(pixel % this->Rows.Size[axis]) + 0.5;
      pixel /= this->Rows.Size[axis];
      cost += this->Weight[axis] * (a[axis] - b[axis]) * (2.0 * x - a[axis] - b[axis]);
    }
    return cost;
  }

  // Moves pixels by the planned flows. Returns whether a pixel with mass moved.
  bool Move(Progress& progress)
  {
    this->Candidates.Fill(this->Borders.Size(), [this](const auto& add) {
      for (const Face& face : this->Faces)
      {
        const SiteCellBorder& border = this->Borders[face.Border];
        if (border.Flow != 0)
        {
          const bool isDonor = this->Owners[face.Pixel] == Donor(border);
          add(static_cast<std::size_t>(face.Border), isDonor ? face.Pixel : face.Other);
        }
      }
    });
    // The excess that each group is to have when all flows are done.
    this->Planned = this->Excess;
    for (std::size_t i = 0; i < this->Borders.Size(); ++i)
    {
      this->Planned[this->Borders[i].Low] -= this->Borders[i].Flow;
      this->Planned[this->Borders[i].High] += this->Borders[i].Flow;
    }
    bool isMoved = false;
    for (std::size_t i = 0; i < this->Borders.Size(); ++i)
    {
      if (this->Borders[i].Flow != 0)
      {
        progress.Check();
        isMoved = this->MoveOver(this->Borders[i], this->Candidates[i]) || isMoved;
      }
    }
    return isMoved;
  }

  static std::int64_t Donor(const SiteCellBorder& border)
  {
    return border.Flow > 0 ? border.Low : border.High;
  }

  // Moves pixels over one border. Pixels are indivisible: one moves if that brings both groups
  // nearer to each other, counting what the previous borders left of their flows. So no group
  // collects many such remainders.
  bool MoveOver(const SiteCellBorder& border, const Bins<std::int64_t>::Range& candidates)
  {
    const std::int64_t from = Donor(border);
    const std::int64_t to = border.Flow > 0 ? border.High : border.Low;
    this->Planned[from] += std::abs(border.Flow);
    this->Planned[to] -= std::abs(border.Flow);
    this->Heap.clear();
    for (const std::int64_t pixel : candidates)
    {
      this->Heap.push_back({ this->CostOf(pixel, from, to), pixel });
    }
    std::make_heap(this->Heap.begin(), this->Heap.end());
    bool isMoved = false;
    while (!this->Heap.empty() && this->Planned[from] > this->Planned[to])
    {
      std::pop_heap(this->Heap.begin(), this->Heap.end());
      const std::int64_t pixel = this->Heap.back().Pixel;
      this->Heap.pop_back();
      const std::int64_t mass = this->Masses[pixel];
      // A pixel with several faces is listed several times, and a group keeps some of its mass.
      if (this->Owners[pixel] != from || mass >= this->Mass[from])
      {
        continue;
      }
      if (mass > 0 && this->Planned[from] - this->Planned[to] <= mass)
      {
        // Lighter pixels behind a heavy one would leave it as an enclave; they move only if nothing
        // else does.
        if (this->TakesLighter)
        {
          continue;
        }
        break;
      }
      this->Owners[pixel] = to;
      this->Shift(this->Mass, mass, from, to);
      this->Shift(this->Excess, mass, from, to);
      this->Shift(this->Planned, mass, from, to);
      isMoved = isMoved || mass > 0;
      this->PushBehind(pixel, from, to);
    }
    return isMoved;
  }

  static void Shift(
    std::vector<std::int64_t>& values, std::int64_t mass, std::int64_t from, std::int64_t to)
  {
    values[from] -= mass;
    values[to] += mass;
  }

  // Adds the neighbours of a pixel that is nearly without mass: the mass that is to move may be
  // behind it.
  void PushBehind(std::int64_t pixel, std::int64_t from, std::int64_t to)
  {
    // Pixels of at most 1 / 64 of the mean mass count as nearly without mass.
    constexpr std::int64_t light = 64;
    if (this->Masses[pixel] > this->MeanMass / light)
    {
      return;
    }
    std::int64_t rest = pixel;
    for (int axis = 0; axis < Dimension; ++axis)
    {
      const std::int64_t position = rest % this->Rows.Size[axis];
      rest /= this->Rows.Size[axis];
      for (const int step : { -1, 1 })
      {
        const std::int64_t other = pixel + step * this->Rows.Stride[axis];
        if (position + step >= 0 && position + step < this->Rows.Size[axis] &&
          this->Owners[other] == from)
        {
          this->Heap.push_back({ this->CostOf(other, from, to), other });
          std::push_heap(this->Heap.begin(), this->Heap.end());
        }
      }
    }
  }

  const SiteGroups& Groups;
  const PixelMasses<Dimension>& Masses;
  const PixelRows<Dimension> Rows;
  const ConstPointSpan<Dimension> Places;
  std::int64_t* Owners;
  const std::int64_t Count;
  std::vector<std::int64_t> Mass;
  std::vector<std::int64_t> Excess; // mass of a group less its target
  std::vector<std::int64_t> Planned;
  const Point<Dimension> Weight;
  bool TakesLighter = false;
  std::int64_t MeanMass;               // mean mass of a pixel
  std::vector<std::int64_t> FirstFace; // first face of each row
  std::vector<Face> Faces;
  BorderMaxFlow Borders;
  Bins<std::int64_t> Candidates; // pixels at each border
  std::vector<Candidate> Heap;
};

} // namespace

template <int Dimension>
void equalizeSiteMasses(const SiteGroups& groups, const PixelMasses<Dimension>& masses,
  ConstPointSpan<Dimension> places, const Point<Dimension>& spacing, std::int64_t* owners,
  const Context& context)
{
  Progress progress(context);
  MassBalance<Dimension>(groups, masses, places, spacing, owners).Run(progress);
}

template decltype(equalizeSiteMasses<2>) equalizeSiteMasses<2>;
template decltype(equalizeSiteMasses<3>) equalizeSiteMasses<3>;

} // namespace RectifiedTransport
