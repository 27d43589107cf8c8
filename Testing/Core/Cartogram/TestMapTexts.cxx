// SPDX-License-Identifier: BSD-3-Clause
// Maps in space: their plane and projection, what moves along, and what is refused or warned of.
#include "Core/Cartogram/MapOverlays.h"
#include "Core/Cartogram/MapWarnings.h"
#include "Core/Cartogram/RegionChecks.h"
#include "Core/Cartogram/RegionList.h"
#include "Core/Messages/Failure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace RectifiedTransport
{
namespace
{

template <class Call>
std::string failureOf(const Call& call)
{
  try
  {
    call();
  }
  catch (const Failure& failure)
  {
    return failure.what();
  }
  return "";
}

void visitSquare(const std::function<void(const std::vector<std::int64_t>&)>& visit)
{
  visit({ 0, 1, 2, 3 });
}

TEST(MapTexts, RegionsHaveAPlane)
{
  std::vector<Point<3>> places{ { 0, 0, 2 }, { 4, 0, 2 }, { 4, 4, 2 }, { 0, 4, 2 } };
  const PlaneFrame frame = planeOfRegions(places, visitSquare);
  EXPECT_EQ(frame.Distance({ 1.0, 1.0, 5.0 }), 3.0);
  EXPECT_EQ(frame.ToPlane({ 3.0, 1.0, 2.0 }), (Point<2>{ 1.0, -1.0 }));
  places[0][2] = 3.0;
  EXPECT_EQ(failureOf([&]() {
    planeOfRegions(places, visitSquare);
  }).rfind("The regions are not in a plane: points are up to ", 0),
    0u);
  EXPECT_EQ(failureOf([&]() {
    planeOfRegions({ 4, Point<3>{} }, visitSquare);
  }),
    "The regions have no area; they must be polygons or closed lines in a plane");
}

TEST(MapTexts, RegionsHaveAreasAndMasses)
{
  const std::vector<std::string> names{ "'a'", "'b'", "'c'", "'d'" };
  EXPECT_EQ(requireAreas({ 1.0, 2.0, 3.0, 4.0 }, names), 10.0);
  EXPECT_EQ(failureOf([&]() {
    requireAreas({ 1.0, 0.0, 0.0, 1.0 }, names);
  }),
    "2 of 4 regions (50 %) have no area (the first is the region 'b'); remove them, with "
    "Threshold");
  std::vector<double> masses{ 0.0, 1.0, 1.0, 2.0 };
  std::vector<std::string> warnings;
  EXPECT_EQ(completeMasses(masses, 0.0, { 1.0, 1.0, 1.0, 2.0 }, names, warnings), 0);
  EXPECT_EQ(masses, (std::vector<double>{ leastRegionDensity * 4.0 * 0.2, 1.0, 1.0, 2.0 }));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
    "1 of 4 regions (25 %) have no mass (the first is the region 'a'); they get a ten-thousandth "
    "of the mean density, as no area can be shown");
  EXPECT_EQ(completeMasses(masses, 0.1, { 1.0, 1.0, 1.0, 2.0 }, names, warnings), 1);
  EXPECT_EQ(warnings.back(), "1 of 4 regions (25 %) are enlarged to MinimumShare");
}

TEST(MapTexts, MissedRegionsAreAWarningFromOneInAHundredOfTheMass)
{
  CartogramResult result;
  result.Errors = { 0.0, -0.05, 0.001 };
  result.Overlaps = { 0.0, 0.0, 0.0 };
  const std::vector<std::string> names{ "'a'", "'b'", "'c'" };
  for (const double mass : { 0.5, 2.0 })
  {
    std::vector<std::string> warnings;
    EXPECT_EQ(addWarnings(result, { 50.0, mass, 49.0 }, names, 3, 0.01, warnings), 1);
    EXPECT_EQ(warnings.size(), mass < 1.0 ? 0u : 1u);
  }
  std::vector<std::string> warnings;
  EXPECT_EQ(addWarnings(result, { 50.0, 2.0, 49.0 }, names, 3, 0.1, warnings), 0);
  EXPECT_TRUE(warnings.empty());
}

TEST(MapTexts, RegionsAreNumberedByKeys)
{
  RegionList regions("'mass'");
  const auto add = [&](const std::string& key, double mass) {
    return regions.Add(key, mass, [&]() { return "'" + key + "'"; });
  };
  EXPECT_EQ(failureOf([&]() { regions.RequireMass(); }),
    "The masses in 'mass' sum to 0; they must sum to a number above 0");
  EXPECT_EQ(add("b", 2.0), 0);
  EXPECT_EQ(add("a", 0.1), 1);
  EXPECT_EQ(add("b", 2.0), 0);
  regions.RequireMass();
  EXPECT_EQ(regions.Names, (std::vector<std::string>{ "'b'", "'a'" }));
  EXPECT_EQ(failureOf([&]() { add("a", 0.25); }),
    "The region 'a' has cells of mass 0.1 and 0.25 in 'mass'; all cells of a region must have its "
    "mass, which counts once");
  EXPECT_EQ(failureOf([&]() { add("c", -1.0); }),
    "The mass of the region 'c' in 'mass' is -1; masses must be at least 0 and finite");
}

TEST(MapTexts, ProjectionKeepsAreas)
{
  const MapProjection projection({ { 0, -30, 0 }, { 10, 50, 0 } });
  const auto areaAt = [&](double latitude) {
    const Point<3> low = projection.Project({ 20, latitude, 7 });
    const Point<3> high = projection.Project({ 21, latitude + 1, 7 });
    return (high[0] - low[0]) * (high[1] - low[1]);
  };
  constexpr double radian = 3.14159265358979323846 / 180.0;
  const auto onEarth = [&](double latitude) {
    return 6371.0 * 6371.0 * radian *
      (std::sin((latitude + 1) * radian) - std::sin(latitude * radian));
  };
  for (const double latitude : { -80.0, 0.0, 45.0 })
  {
    EXPECT_NEAR(areaAt(latitude) / onEarth(latitude), 1.0, 1e-9) << latitude;
  }
  EXPECT_EQ(MapProjection().Project({ 1, 2, 3 }), (Point<3>{ 1, 2, 3 }));
  EXPECT_EQ(failureOf([]() {
    MapProjection({ { 0, 0, 0 }, { 5, 91, 0 } });
  }).rfind("Projection is EqualArea, and point 1 of the input is at (5, 91);", 0),
    0u);
}

TEST(MapTexts, LookLikeDegrees)
{
  EXPECT_TRUE(looksLikeDegrees({ { -20, 30, 0 }, { 20, 40, 0 } }));
  EXPECT_TRUE(looksLikeDegrees({ { 5, 47, 0 }, { 15, 55, 0 } }));
  EXPECT_FALSE(looksLikeDegrees({ { 0, 0, 0 }, { 10, 10, 0 } }));
  EXPECT_FALSE(looksLikeDegrees({ { 0, 0, 0 }, { 400, 100, 0 } }));
}

// A square of 32 x 32 cells of size 1, in the plane of x and y.
TEST(MapTexts, OverlaysMoveAlong)
{
  RegionMap map;
  map.AddPoint({ 0.0, 0.0 });
  map.AddPoint({ 32.0, 32.0 });
  const MapPlace place{ MapProjection(), PlaneFrame({ 0, 0, 0 }, { 0, 0, 1 }),
    { { 0.0, 0.0 }, 1.0, 32 }, 0.5 };
  MapOverlays overlays(place, map);
  // 17 lines each way, of two parts in each of 16 squares.
  ASSERT_EQ(overlays.LineEnds().size(), 34u);
  EXPECT_EQ(overlays.LineEnds().back(), 34u * 33u);
  overlays.AddOverlay({ { 1, 2, 5 } });
  overlays.AddOverlay({ { 3, 4, 0 }, { 5, 6, 0 } });
  ASSERT_EQ(overlays.Points().size(), 34u * 33u + 3u);
  EXPECT_EQ(overlays.OverlayPoint(2), (Point<3>{ 5, 6, 0 }));
  for (Point<2>& point : overlays.Points())
  {
    point[0] += 2.0;
  }
  EXPECT_EQ(overlays.OverlayPoint(0), (Point<3>{ 2, 2, 5 })) << "half of the way";
  EXPECT_EQ(overlays.GraticulePoint(0), (Point<3>{ 1, 0, 0 }));
}

} // namespace
} // namespace RectifiedTransport
