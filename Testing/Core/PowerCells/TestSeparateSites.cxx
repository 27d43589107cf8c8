// SPDX-License-Identifier: BSD-3-Clause
// Sites that lie at one point, or nearly, are moved apart.
#include "Core/PowerCells/SeparateSites.h"

#include "Core/Parallel/Progress.h"

#include "TestFlow.h"

#include <gtest/gtest.h>

#include <cmath>

namespace RectifiedTransport
{
namespace
{

void separate(Points<2>& sites, double distance, const SiteBounds& bounds = {})
{
  Progress progress{ Context() };
  separateSites(sites, distance, bounds, progress);
}

void expectApart(const Points<2>& sites, double distance)
{
  for (std::size_t i = 0; i < sites.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      ASSERT_GE(
        std::hypot(sites[i][0] - sites[j][0], sites[i][1] - sites[j][1]), distance * (1.0 - 1e-12));
    }
  }
}

TEST(SeparateSites, AreApartAndNear)
{
  Points<2> places = randomPoints<2>({ 1, 1 }, 3000, 8);
  for (std::size_t i = 1000; i < 2500; ++i)
  {
    places[i] = i % 2 == 0 ? places[7] : Point<2>{ 0.5 + 1e-4 * places[i][0], 0.5 };
  }
  const Points<2> given = places;
  constexpr double distance = 1e-3;
  separate(places, distance);
  expectApart(places, distance);
  std::size_t stayed = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    stayed += places[i] == given[i] ? 1 : 0;
    // A disc that holds 1500 of them.
    EXPECT_LT(std::hypot(places[i][0] - given[i][0], places[i][1] - given[i][1]), 0.15);
  }
  EXPECT_GT(stayed, 1300u);
}

TEST(SeparateSites, StayInTheBounds)
{
  const SiteBounds square = { { 0.0, 0.0 }, { 1.0, 1.0 } };
  const SiteBounds line = { { 0.0, 0.5 }, { 1.0, 0.5 } };
  for (const auto& [bounds, place] : { std::make_pair(square, Point<2>{ 0.0, 1.0 }),
         { square, { 1.0, 0.3 } }, { line, { 0.7, 0.5 } } })
  {
    Points<2> sites(200, place);
    separate(sites, 1e-3, bounds);
    expectApart(sites, 1e-3);
    for (const Point<2>& site : sites)
    {
      EXPECT_LT(std::hypot(site[0] - place[0], site[1] - place[1]), 0.25);
      for (std::size_t a = 0; a < 2; ++a)
      {
        EXPECT_GE(site[a], bounds.Low[a]);
        EXPECT_LE(site[a], bounds.High[a]);
      }
    }
  }
}

} // namespace
} // namespace RectifiedTransport
