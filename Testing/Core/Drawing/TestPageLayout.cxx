// SPDX-License-Identifier: BSD-3-Clause
// Where data lie on a page, and what has no place there.
#include "Core/Drawing/PageLayout.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace RectifiedTransport
{
namespace
{

constexpr double farthest = 5080.0;

// A rectangle of 4 x 2 in the plane of y and z.
DrawingExtent rectangle()
{
  DrawingExtent extent;
  extent.Include(Point<3>{ 1.0, 2.0, 3.0 }.data(), 0, 0.0);
  extent.Include(Point<3>{ 1.0, 6.0, 5.0 }.data(), 1, 0.0);
  return extent;
}

template <class Call>
std::string errorOf(const Call& call)
{
  try
  {
    call();
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return "";
}

TEST(PageLayout, FillsTheWidth)
{
  const PageLayout layout = PageSettings{ 50.0, 5.0, {}, 1.0 }.Layout(rectangle(), farthest);
  EXPECT_EQ(layout.Scale(), 10.0);
  EXPECT_EQ(layout.Size(), (Point<2>{ 50.0, 30.0 }));
  EXPECT_EQ(layout.At(Point<3>{ 7.0, 2.0, 3.0 }.data()), (Point<2>{ 5.0, 5.0 }));
  EXPECT_EQ(layout.At(Point<3>{ 1.0, 6.0, 5.0 }.data()), (Point<2>{ 45.0, 25.0 }));
}

TEST(PageLayout, RadiiAndStrokesFitOnThePage)
{
  DrawingExtent extent = rectangle();
  extent.HasStrokes = true;
  for (const Point<3>& corner : { Point<3>{ 1.0, 2.0, 3.0 }, { 1.0, 6.0, 5.0 } })
  {
    extent.IncludeDot(corner.data(), 2);
  }
  extent.SetRadiusOfDots(1.0);
  const PageLayout layout = PageSettings{ 62.0, 0.0, {}, 2.0 }.Layout(extent, farthest);
  EXPECT_EQ(layout.Scale(), 10.0);
  EXPECT_EQ(layout.At(Point<3>{ 0.0, 1.0, 2.0 }.data()), (Point<2>{ 1.0, 1.0 }));
}

TEST(PageLayout, ShowsTheBounds)
{
  const PageSettings page{ 80.0, 0.0, { 0.0, 0.0, 0.0, 8.0, 0.0, 8.0 }, 1.0 };
  page.CheckBounds();
  const PageLayout layout = page.Layout(rectangle(), farthest);
  EXPECT_EQ(layout.Size(), (Point<2>{ 80.0, 80.0 }));
  EXPECT_EQ(layout.At(Point<3>{ 1.0, 2.0, 3.0 }.data()), (Point<2>{ 20.0, 30.0 }));
}

TEST(PageLayout, RefusesWhatHasNoPlace)
{
  const DrawingExtent extent = rectangle();
  EXPECT_EQ(errorOf([&]() {
    PageSettings{ 10.0, 5.0, {}, 1.0 }.Layout(extent, farthest);
  }),
    "Width is 10; it must be more than 10, twice PageMargin");
  EXPECT_EQ(errorOf([&]() {
    PageSettings{ 6000.0, 0.0, {}, 1.0 }.Layout(extent, farthest);
  }),
    "The page is 6000 x 3000 mm with Width 6000; no side may be longer than 5080 mm in this "
    "format: Width must be at most 5080");
  const PageSettings small{ 100.0, 0.0, { 0.0, 0.0, 0.0, 1e-6, 0.0, 1e-6 }, 1.0 };
  EXPECT_EQ(errorOf([&]() {
    small.Layout(extent, farthest);
  }).rfind("PageBounds are so small that the input reaches", 0),
    0u);
  const PageSettings line{ 100.0, 0.0, { 0.0, 0.0, 0.0, 0.0, 0.0, 1.0 }, 1.0 };
  EXPECT_EQ(errorOf([&]() { line.CheckBounds(); }).rfind("PageBounds are 0 0 0 0 0 1;", 0), 0u);
}

TEST(PageLayout, RefusesWhatIsNotFinite)
{
  DrawingExtent extent;
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(errorOf([&]() {
    extent.IncludeDot(Point<3>{ 0.0, infinity, 0.0 }.data(), 7);
  }),
    "The input has a point that is NaN or infinite, at index 7; all coordinates must be finite");
  EXPECT_EQ(errorOf([&]() { extent.Include(Point<3>{}.data(), 3, -1.0); }),
    "RadiusArray has the value -1 at index 3; every radius must be finite and not negative");
  EXPECT_TRUE(extent.OtherShapes.isEmpty());
}

} // namespace
} // namespace RectifiedTransport
