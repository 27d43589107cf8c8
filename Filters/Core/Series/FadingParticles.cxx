// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Series/FadingParticles.h"

#include "Core/Flow/PivotLattice.h"
#include "Core/Geometry/MeanSquare.h"
#include "Core/Geometry/PhysicalPoints.h"
#include "Core/Parallel/RankShare.h"
#include "Core/Parallel/Stages.h"
#include "Core/Series/CloudLengths.h"

#include <algorithm>

namespace RectifiedTransport
{

namespace
{

// The particles of one step, in those cells of its density that have mass.
template <int D>
struct StepParticles
{
  PivotLattice<D> Lattice;
  LargeBuffer<double> Points; // places in the density's index space, interleaved
  std::vector<double> Masses;
  std::vector<std::int64_t> Numbers;

  std::int64_t Count() const { return static_cast<std::int64_t>(this->Masses.size()); }
  PointSpan<D> Span() { return { this->Points.data(), this->Count() }; }
};

// Places particles by their numbers in the lattice, which are independent of the ranks: number n is
// at place n / (lattice cells) of lattice cell n % (lattice cells). Each gets the mass of its cell
// divided by the particles in a cell.
template <int D>
StepParticles<D> placeParticles(const SeriesStep& step, int perCell, const Ranks& ranks)
{
  StepParticles<D> particles;
  particles.Lattice = pivotLattice<D>(step.Grid.Size<D>(), perCell);
  // The lattice has at least the cells of the grid, with one or more places in each of its own
  // cells.
  const GridSize<D>& lattice = particles.Lattice.Lattice;
  const Point<D> side = latticeStep<D>(lattice, step.Grid.Size<D>());
  const auto all = LatticePart<D>::WholeOf(lattice);
  const auto cells = LatticePart<D>::WholeOf(step.Grid.Size<D>());
  // A lattice finer than the grid has several of its cells in one cell of the grid.
  const auto valueOf = [&](std::int64_t number) {
    GridSize<D> cell = all.CellOf(number % all.Count());
    for (int axis = 0; axis < D; ++axis)
    {
      cell[axis] /= lattice[axis] / step.Grid.Size<D>()[axis];
    }
    return step.Values[cells.NumberOf(cell)];
  };
  // Ranks divide the particles by their numbers, before those without mass are left out.
  const RankShare share(particles.Lattice.NumberOfParticles(), ranks);
  const double measure = step.Grid.CellMeasure() / static_cast<double>(perCell);
  for (std::int64_t n = share.First; n < share.First + share.Count; ++n)
  {
    if (valueOf(n) > 0.0)
    {
      particles.Numbers.push_back(n);
    }
  }
  particles.Masses.resize(particles.Numbers.size());
  particles.Points = LargeBuffer<double>(particles.Count() * D);
  for (std::int64_t i = 0; i < particles.Count(); ++i)
  {
    const std::int64_t n = particles.Numbers[static_cast<std::size_t>(i)];
    const GridSize<D> corner = all.CellOf(n % all.Count());
    const Point<D>& place = particles.Lattice.Places[static_cast<std::size_t>(n / all.Count())];
    particles.Masses[static_cast<std::size_t>(i)] = valueOf(n) * measure;
    for (int axis = 0; axis < D; ++axis)
    {
      particles.Points.data()[i * D + axis] =
        (static_cast<double>(corner[axis]) + place[axis]) * side[axis];
    }
  }
  return particles;
}

// The particles of an interval: those of the first step, then those of the second one. From and To
// have the positions of both sets at both ends of the interval.
template <int D>
class ParticleMaker
{
public:
  ParticleMaker(const SeriesStep& from, const SeriesStep& to, int perCell, const Ranks& ranks)
    : FirstStep(from)
    , SecondStep(to)
    , First(placeParticles<D>(from, perCell, ranks))
    , Second(placeParticles<D>(to, perCell, ranks))
    , From(std::make_shared<SeriesPositions>(this->First.Count() + this->Second.Count()))
    , To(std::make_shared<SeriesPositions>(this->First.Count() + this->Second.Count()))
  {
    this->Made.From = this->From;
    this->Made.To = this->To;
    this->Made.OfFirst = this->First.Count();
    this->Made.Grids = { from.Grid, to.Grid };
    this->Made.Masses = LargeBuffer<double>(this->Made.Count());
    // Masses of the first step's particles, then those of the second step's.
    std::copy(this->Second.Masses.begin(), this->Second.Masses.end(),
      std::copy(this->First.Masses.begin(), this->First.Masses.end(), this->Made.Masses.data()));
    // On several ranks, the second step's numbers follow all of the first step's.
    if (ranks.AreSeveral())
    {
      const std::int64_t before = this->First.Lattice.NumberOfParticles();
      this->Made.Numbers = this->First.Numbers;
      for (const std::int64_t number : this->Second.Numbers)
      {
        this->Made.Numbers.push_back(before + number);
      }
    }
  }

  // Each set begins (or ends) in its own step's cells, and the map moves it to the other step.
  SeriesParticles Make(const MoveBetween<D>& move, Progress& progress)
  {
    Stages stages(progress, { { "starts", 1 }, { "move", 98 }, { "images", 1 } });
    const ImageGrid& firstGrid = this->FirstStep.Grid;
    const ImageGrid& secondGrid = this->SecondStep.Grid;
    auto& [from, to] = this->Made.Clouds;
    this->WriteFirst(firstGrid, *this->From, stages["starts"]);
    this->WriteSecond(secondGrid, *this->To, stages["starts"]);
    addCloudsInCells<D>(this->First.Lattice, firstGrid, this->First.Count(), from);
    // With mass in one step only, there is no transport: particles stay in place and only fade.
    if (this->FirstStep.Mass > 0.0 && this->SecondStep.Mass > 0.0)
    {
      move(this->First.Span(), this->Second.Span(), stages["move"]);
      this->WriteFirst(secondGrid, *this->To, stages["images"]);
      this->WriteSecond(firstGrid, *this->From, stages["images"]);
      // The cost is the mean squared displacement over the mass of the first step.
      const std::int64_t first = this->First.Count();
      this->Made.Cost = meanSquare(LengthScale(firstGrid), this->From->Span().Part(0, first),
        this->To->Span().Part(0, first), this->Made.Masses.data(), this->FirstStep.Mass,
        stages["images"]);
      // Clouds stretch with the map: lengths at the images are measured between neighbouring
      // images.
      addCloudsAtImages<D>(this->Second.Lattice, secondGrid, firstGrid, this->Second.Numbers,
        this->Second.Span(), stages["images"], from);
      addCloudsAtImages<D>(this->First.Lattice, firstGrid, secondGrid, this->First.Numbers,
        this->First.Span(), stages["images"], to);
    }
    else
    {
      this->WriteFirst(firstGrid, *this->To, stages["images"]);
      this->WriteSecond(secondGrid, *this->From, stages["images"]);
      addCloudsInCells<D>(this->Second.Lattice, secondGrid, this->Second.Count(), from);
      to = std::vector<float>(from.begin(), from.begin() + D * this->First.Count());
    }
    addCloudsInCells<D>(this->Second.Lattice, secondGrid, this->Second.Count(), to);
    return std::move(this->Made);
  }

private:
  // Writes where the first step's particles are, in the physical space of a grid, before those of
  // the second step.
  void WriteFirst(const ImageGrid& grid, SeriesPositions& to, Progress& progress)
  {
    const std::int64_t count = this->First.Count();
    writePhysical<D>(grid, this->First.Span(), progress, to.Span().Part(0, count));
  }
  // The same for the second step's particles, after those of the first.
  void WriteSecond(const ImageGrid& grid, SeriesPositions& to, Progress& progress)
  {
    const std::int64_t count = this->Second.Count();
    writePhysical<D>(
      grid, this->Second.Span(), progress, to.Span().Part(this->First.Count(), count));
  }

  const SeriesStep& FirstStep;
  const SeriesStep& SecondStep;
  StepParticles<D> First;
  StepParticles<D> Second;
  const std::shared_ptr<SeriesPositions> From;
  const std::shared_ptr<SeriesPositions> To;
  SeriesParticles Made;
};

} // namespace

template <int D>
SeriesParticles makeFadingParticles(const SeriesStep& from, const SeriesStep& to, int perCell,
  const MoveBetween<D>& move, Progress& progress)
{
  return ParticleMaker<D>(from, to, perCell, progress.Group()).Make(move, progress);
}

RECTIFIEDTRANSPORT_INSTANTIATE_FUNCTION(makeFadingParticles);

} // namespace RectifiedTransport
