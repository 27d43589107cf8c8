// SPDX-License-Identifier: BSD-3-Clause
// Particles between two steps: fading and tracked ones, their clouds, and what moves along.
#include "ThreadRanks.h"

#include "Core/Series/AdvectedMeans.h"
#include "Core/Series/CloudLengths.h"
#include "Core/Series/FadingParticles.h"
#include "Core/Series/SeriesLabels.h"
#include "Core/Series/SeriesTracks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

constexpr int cells = 12;
constexpr double spacing = 0.5;

// Cells along one axis.
ImageGrid lineGrid()
{
  return { { 0, cells, 0, 0, 0, 0 }, Eigen::Vector3d(10.0, 1.0, 2.0),
    Eigen::Vector3d(spacing, 1.0, 1.0), ImageGrid::Matrix::Identity(), false };
}

std::vector<double> boxOf(int first, int last)
{
  std::vector<double> values(cells, 0.0);
  for (int i = first; i < last; ++i)
  {
    values[static_cast<std::size_t>(i)] = 2.0;
  }
  return values;
}

double massOf(const std::vector<double>& values)
{
  return spacing * std::accumulate(values.begin(), values.end(), 0.0);
}

void shift(PointSpan<1> points, double way)
{
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    points[i][0] += way;
  }
}

// Two steps, a box and the same box further on.
struct MovingBox
{
  static constexpr double Way = 5.0; // in cells
  ImageGrid Grid = lineGrid();
  std::vector<double> First = boxOf(1, 4);
  std::vector<double> Second = boxOf(6, 9);

  SeriesParticles Make(int perCell, const Context& context) const
  {
    Progress progress(context);
    return makeFadingParticles<1>(
      { this->Grid, this->First.data(), massOf(this->First) },
      { this->Grid, this->Second.data(), massOf(this->Second) }, perCell,
      [](PointSpan<1> first, PointSpan<1> second, Progress&) {
        shift(first, Way);
        shift(second, -Way);
      },
      progress);
  }
};

struct Placed
{
  SeriesSnapshot Moment;
  std::vector<Point<3>> Points;
  std::vector<double> Masses;

  Placed(const SeriesParticles& particles, double part, double mass = 1.0)
    : Moment(particles, part)
    , Points(static_cast<std::size_t>(this->Moment.Count()))
    , Masses(this->Points.size())
  {
    const SerialExecutor serial;
    Progress progress{ Context(serial) };
    this->Moment.Write(mass, this->Points, this->Masses.data(), progress);
  }

  std::vector<double> Density(const ImageGrid& grid) const
  {
    const SerialExecutor serial;
    Progress progress{ Context(serial) };
    std::vector<double> density(cells);
    splatClouds<1>(this->Moment.CloudsIn<1>(grid), grid, 3.0, LatticePart<1>::WholeOf({ cells }),
      density.data(), progress);
    return density;
  }
};

// The lengths of clouds are floats.
void expectNear(const std::vector<double>& found, const std::vector<double>& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_NEAR(found[i], expected[i], 1e-7) << i;
  }
}

TEST(FadingParticles, AreTheDensitiesAtBothEndsAndMoveBetween)
{
  const SerialExecutor serial;
  const MovingBox box;
  for (const int perCell : { 1, 2, 3 })
  {
    const SeriesParticles particles = box.Make(perCell, serial);
    EXPECT_EQ(particles.OfFirst, 3 * perCell);
    EXPECT_EQ(particles.Count(), 6 * perCell);
    EXPECT_NEAR(particles.Cost, std::pow(MovingBox::Way * spacing, 2), 1e-12);
    EXPECT_EQ(Placed(particles, 0.0).Moment.Count(), 3 * perCell);
    EXPECT_EQ(Placed(particles, 1.0).Moment.First(), 3 * perCell);
    expectNear(Placed(particles, 0.0).Density(box.Grid), box.First);
    expectNear(Placed(particles, 1.0).Density(box.Grid), box.Second);
    expectNear(Placed(particles, 0.4).Density(box.Grid), boxOf(3, 6));
  }
}

TEST(FadingParticles, StayWhereTheOtherStepHasNoMass)
{
  const SerialExecutor serial;
  MovingBox box;
  box.Second.assign(cells, 0.0);
  const SeriesParticles particles = box.Make(2, serial);
  EXPECT_EQ(particles.Count(), particles.OfFirst);
  EXPECT_EQ(particles.Cost, 0.0);
  std::vector<double> faded = box.First;
  for (double& value : faded)
  {
    value *= 0.25;
  }
  expectNear(Placed(particles, 0.75).Density(box.Grid), faded);
}

TEST(FadingParticles, AreThoseOfOneRankOnSeveral)
{
  const SerialExecutor serial;
  const MovingBox box;
  const SeriesParticles alone = box.Make(3, serial);
  runOnRanks(3, [&](const Ranks& ranks) {
    Context context(serial);
    context.Group = &ranks;
    const SeriesParticles own = box.Make(3, context);
    EXPECT_EQ(own.Cost, alone.Cost);
    std::vector<std::int64_t> numbers(36, -1);
    for (std::int64_t i = 0; i < alone.Count(); ++i)
    {
      // Three cells of the lattice in each cell of a box.
      numbers[static_cast<std::size_t>(i)] = i < 9 ? 3 + i : 3 * cells + 18 + i - 9;
    }
    ASSERT_EQ(own.Numbers.size(), static_cast<std::size_t>(own.Count()));
    for (std::int64_t i = 0; i < own.Count(); ++i)
    {
      const auto found =
        std::find(numbers.begin(), numbers.end(), own.Numbers[static_cast<std::size_t>(i)]);
      ASSERT_NE(found, numbers.end());
      const auto at = found - numbers.begin();
      EXPECT_EQ(own.From->Span()[i][0], alone.From->Span()[at][0]);
      EXPECT_EQ(own.To->Span()[i][0], alone.To->Span()[at][0]);
      EXPECT_EQ(
        own.Clouds[1][static_cast<std::size_t>(i)], alone.Clouds[1][static_cast<std::size_t>(at)]);
    }
  });
}

// Clouds grow with the distance of their neighbours, but not where mass comes apart.
TEST(CloudLengths, AreDistancesOfNeighbours)
{
  const ImageGrid grid = lineGrid();
  const PivotLattice<1> lattice{ { cells }, { { 0.5 } } };
  const std::vector<double> images = { 1.0, 2.5, 4.0, 9.0, 10.0 };
  const std::vector<std::int64_t> numbers = { 2, 3, 4, 5, 6 };
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  std::vector<float> lengths = { 7.0F };
  addCloudsAtImages<1>(lattice, grid, grid, numbers, { images.data(), 5 }, progress, lengths);
  EXPECT_EQ(lengths, (std::vector<float>{ 7.0F, 1.5F, 1.5F, 1.5F, 1.0F, 1.0F }));
  addCloudsInCells<1>(lattice, grid, 2, lengths);
  EXPECT_EQ(lengths.size(), 8u);
  EXPECT_EQ(lengths.back(), 1.0F);
}

TEST(TrackedParticles, KeepTheirIdentity)
{
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  const ImageGrid grid = lineGrid();
  const std::vector<double> uniform(cells, 1.0);
  TrackedParticles tracked;
  tracked.Begin<1>({ grid, uniform.data(), massOf(uniform) }, 2, progress);
  EXPECT_EQ(tracked.All(), 2 * cells);
  const auto move = [](PointSpan<1> samples, Progress&) -> MoveReport {
    for (std::int64_t i = 0; i < samples.size(); ++i)
    {
      samples[i][0] *= 0.5;
    }
    return { 0.125, true };
  };
  tracked.Follow<1>(grid, grid, move, progress);
  EXPECT_EQ(tracked.Count(), 2);
  const SeriesParticles particles = tracked.Between(0, 1, SoloRanks::Get());
  EXPECT_EQ(particles.Bound, 0.125);
  EXPECT_TRUE(particles.HasBound && particles.AreTracked);
  double cost = 0.0;
  for (std::int64_t i = 0; i < particles.Count(); ++i)
  {
    const double from = particles.From->Span()[i][0] - 10.0;
    EXPECT_NEAR(particles.To->Span()[i][0] - 10.0, 0.5 * from, 1e-12);
    cost += 0.25 * from * from / static_cast<double>(particles.Count());
  }
  EXPECT_NEAR(particles.Cost, cost, 1e-12);
  const Placed middle(particles, 0.5, 6.0);
  EXPECT_EQ(middle.Moment.Count(), 2 * cells);
  EXPECT_NEAR(std::accumulate(middle.Masses.begin(), middle.Masses.end(), 0.0), 6.0, 1e-12);
  tracked.Keep(1);
  EXPECT_EQ(tracked.Count(), 1);
  EXPECT_EQ(tracked.Between(0, 0, SoloRanks::Get()).Cost, 0.0);
}

TEST(SeriesTracks, KnowStepsUntilOneChanges)
{
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  const Ranks& ranks = SoloRanks::Get();
  const ImageGrid grid = lineGrid();
  const std::vector<double> uniform(cells, 1.0);
  const SeriesStep step{ grid, uniform.data(), massOf(uniform) };
  const auto stay = [](PointSpan<1>, Progress&) { return MoveReport{}; };
  SeriesTracks tracks;
  tracks.SetSettings({ 1, true }, 1);
  const std::vector<SeriesTracks::Name> names = { { 3 }, { 4 }, { 5 } };
  for (const SeriesTracks::Name& name : names)
  {
    ASSERT_FALSE(tracks.Knows(name, ranks));
    tracks.Extend<1>(tracks.Count() > 0 ? &grid : nullptr, step, name, stay, progress);
  }
  EXPECT_EQ(tracks.Count(), 3);
  tracks.Recheck();
  EXPECT_TRUE(tracks.Knows({ 3 }, ranks));
  EXPECT_FALSE(tracks.Knows({ 7 }, ranks)); // forgets it and the step after it
  EXPECT_EQ(tracks.Count(), 1);
  EXPECT_EQ(tracks.Particles().Count(), 1);
  tracks.SetSettings({ 2, true }, 1);
  EXPECT_EQ(tracks.Count(), 0);
  EXPECT_FALSE(tracks.Knows({ 3 }, ranks));
}

TEST(SeriesLabels, AreEqualByTheirKeys)
{
  const std::array<std::vector<std::string>, 2> keys = { { { "a", "a", "b", "a" }, { "b", "c" } } };
  const auto equal = findEqual({ 4, 2 }, [&](std::size_t step, std::int64_t tuple) {
    return keys[step][static_cast<std::size_t>(tuple)];
  });
  EXPECT_EQ(equal, (std::vector<std::int64_t>{ 0, 0, 2, 0, 2, 5 }));
}

// Each cell of the first step has a label of its own, each of the second that of the cell from
// which its mass comes.
TEST(SeriesLabels, MoveAlong)
{
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  const MovingBox box;
  const SeriesParticles particles = box.Make(1, serial);
  const SeriesLabels labels({ box.Grid, box.Grid }, false, particles);
  std::vector<std::int64_t> equal(2 * cells);
  for (int i = 0; i < cells; ++i)
  {
    equal[static_cast<std::size_t>(i)] = i;
    equal[static_cast<std::size_t>(cells + i)] = i >= 5 ? i - 5 : cells + i;
  }
  const auto find = [&](double part) {
    const Placed placed(particles, part);
    std::vector<std::int64_t> found;
    labels.Find<1>(placed.Moment, box.Grid, LatticePart<1>::WholeOf({ cells }), { equal }, progress,
      [&](std::size_t, const std::vector<std::int64_t>& tuples) { found = tuples; });
    return found;
  };
  const std::vector<std::int64_t> early = { 0, 1, 2, 1, 2, 3, 6, 7, 8, 9, 10, 11 };
  EXPECT_EQ(find(0.4), early);
  const std::vector<std::int64_t> late = { 12, 13, 14, 15, 1, 2, 3, 19, 20, 21, 22, 23 };
  EXPECT_EQ(find(0.6), late);
}

TEST(AdvectedMeans, AreMeansByMass)
{
  const SerialExecutor serial;
  Progress progress{ Context(serial) };
  const MovingBox box;
  const SeriesParticles particles = box.Make(1, serial);
  const Placed placed(particles, 0.4);
  std::vector<double> from(6);
  std::iota(from.begin(), from.end(), 1.0);
  const std::vector<double> to(6, 11.0);
  const std::vector<double> before(cells, -1.0);
  const std::vector<double> after(cells, -2.0);
  const AdvectedValues values{ { from.data(), to.data() }, { before.data(), after.data() }, 1 };
  std::vector<double> moments(6);
  writeMoments(values, placed.Moment, progress, moments.data());
  for (std::size_t i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(moments[i], placed.Masses[i] * (0.6 * from[i] + 0.4 * 11.0), 1e-12);
  }
  const LatticePart<3> image{ {}, { cells, 1, 1 } };
  const LatticePart<3> wanted{ { 2, 0, 0 }, { 2, 1, 1 } };
  const std::vector<double> masses = { 0.0, 2.0 };
  std::vector<double> sums = { 0.0, 5.0 };
  writeMeans(values, 0.4, image, wanted, masses.data(), progress, sums.data());
  EXPECT_NEAR(sums[0], -1.4, 1e-15);
  EXPECT_EQ(sums[1], 2.5);
  EXPECT_EQ(AdvectedValues::Between(values.OfParticles, 0, 1.0), 11.0);
}

} // namespace
} // namespace RectifiedTransport
