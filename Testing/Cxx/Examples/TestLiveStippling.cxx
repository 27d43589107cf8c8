// SPDX-License-Identifier: BSD-3-Clause
// Examples/LiveStippling without its window: the painting, the pairs, the points' identity, files.
#include "Checks.h"

#include "PairPoints.h"
#include "Stippling.h"

#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <numeric>

namespace
{

using Places = std::map<vtkIdType, std::array<double, 3>>;

Places placesOf(Stippling& stippling)
{
  vtkPolyData* points = stippling.GetTransport().GetOutput();
  auto* ids = vtkIdTypeArray::SafeDownCast(points->GetPointData()->GetArray("PointId"));
  Places places;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    points->GetPoint(i, places[ids->GetValue(i)].data());
  }
  return places;
}

// The longest way of a point that is in both, and how many are.
std::pair<double, std::size_t> compare(const Places& before, const Places& after)
{
  double longest = 0.0;
  std::size_t common = 0;
  for (const auto& [id, place] : after)
  {
    const auto old = before.find(id);
    if (old != before.end())
    {
      longest = std::max(longest, std::hypot(place[0] - old->second[0], place[1] - old->second[1]));
      common += 1;
    }
  }
  return { longest, common };
}

Stippling::Options small()
{
  Stippling::Options options;
  options.NumberOfPoints = 1000;
  options.Side = 128;
  return options;
}

void settle(Stippling& stippling)
{
  for (int i = 0; i < 60; ++i)
  {
    stippling.Update();
  }
}

std::ptrdiff_t countNear(const Places& places, double x, double y, double radius)
{
  return std::count_if(places.begin(), places.end(), [&](const auto& entry) {
    return std::hypot(entry.second[0] - x, entry.second[1] - y) < radius;
  });
}

void checkPainting(Checks& checks)
{
  Painting painting(64, 32, 0.0f);
  CHECK(checks, painting.IsEmpty());
  CHECK(checks, !painting.Follows());
  painting.Stroke({ 10.0, 16.0 }, { 50.0, 16.0 }, 6.0, 0.1);
  CHECK(checks, !painting.IsEmpty());
  CHECK(checks, painting.Painted(30, 16) > painting.Painted(30, 20));
  CHECK_NEAR(checks, painting.Painted(30, 20), painting.Painted(30, 11), 1e-6);
  CHECK(checks, painting.Painted(30, 30) == 0.0f);
  // Partly and wholly outside of the sheet.
  painting.Stroke({ -3.0, 31.0 }, { -3.0, 31.0 }, 6.0, 5.0);
  painting.Stroke({ 1e9, -1e9 }, { 1e9, -1e9 }, 6.0, 5.0);
  CHECK(checks, painting.Painted(0, 31) == 1.0f);
  int updates = 0;
  while (painting.Follows())
  {
    ++updates;
  }
  CHECK(checks, updates > 5 && updates < 60);
  CHECK(checks, painting.Shown()[16 * 64 + 30] == painting.Painted(30, 16));
  painting.Invert();
  CHECK(checks, painting.Painted(0, 31) == 0.0f && painting.Painted(30, 30) == 1.0f);
  painting.Stroke({ 0.0, 16.0 }, { 64.0, 16.0 }, 40.0, -2.0);
  CHECK(checks, painting.IsEmpty());
}

void checkResize(Checks& checks)
{
  Painting painting(16, 16, 0.25f);
  painting.Stroke({ 4.0, 12.0 }, { 4.0, 12.0 }, 4.0, 1.0);
  const Painting larger(64, 32, painting);
  CHECK(checks, larger.Painted(16, 24) == painting.Painted(4, 12));
  CHECK(checks, larger.Painted(60, 4) == 0.25f);
}

void checkPairs(Checks& checks)
{
  const Points few = { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 9.0, 5.0, 0.0 } };
  const Points more = { { 9.0, 4.0, 0.0 }, { 1.1, 0.0, 0.0 }, { 0.4, 0.0, 0.0 },
    { 5.0, 5.0, 0.0 } };
  CHECK(checks, (pairPoints(few, more) == std::vector<int>{ 2, 1, 0 }));
  CHECK(checks, (pairPoints(more, few) == std::vector<int>{ 2, 1, 0, -1 }));
  CHECK(checks, pairPoints({}, few).empty());
  CHECK(checks, (pairPoints(few, {}) == std::vector<int>{ -1, -1, -1 }));
  const Points same(3, { 2.0, 2.0, 0.0 });
  CHECK(checks, (pairPoints(same, same) == std::vector<int>{ 0, 1, 2 }));
}

void checkPointsFollowInk(Checks& checks)
{
  Stippling stippling(small());
  settle(stippling);
  const Places before = placesOf(stippling);
  CHECK(checks, before.size() == 1000);
  Places last = before;
  double longest = 0.0;
  for (int i = 0; i <= 20; ++i)
  {
    stippling.Paint({ 40.0 + 2.0 * i, 64.0 }, false);
    CHECK(checks, stippling.Update());
    const Places now = placesOf(stippling);
    longest = std::max(longest, compare(last, now).first);
    last = now;
  }
  stippling.LiftBrush();
  CHECK(checks, countNear(last, 60.0, 64.0, 15.0) > 2 * countNear(before, 60.0, 64.0, 15.0));
  CHECK(checks, compare(before, last).second == 1000);
  CHECK(checks, longest < 16.0);
  // The points follow from the picture alone.
  stippling.StartOver();
  settle(stippling);
  CHECK(checks, compare(before, placesOf(stippling)).first < 1e-3);
  CHECK(checks, !stippling.Update());
}

void checkNumberOfPoints(Checks& checks)
{
  Stippling stippling(small());
  settle(stippling);
  const Places before = placesOf(stippling);
  stippling.ScaleNumberOfPoints(1.1);
  stippling.Update();
  const Places first = placesOf(stippling);
  CHECK(checks, first.size() == 1100);
  // Those that were there remain, and hardly move at first: they are four cells apart.
  CHECK(checks, compare(before, first).second == 1000);
  CHECK(checks, compare(before, first).first < 1.0);
  settle(stippling);
  stippling.SetNumberOfPoints(700);
  stippling.Update();
  const Places fewer = placesOf(stippling);
  CHECK(checks, fewer.size() == 700 && compare(first, fewer).second == 700);
  stippling.SetNumberOfPoints(0);
  settle(stippling);
  CHECK(checks, placesOf(stippling).size() == 1);
  stippling.SetNumberOfPoints(1e12);
  CHECK(checks, stippling.GetTransport().GetNumberOfPoints() == LiveTransport::MostPoints);
  CHECK(checks, contains(stippling.GetMessage(), "at most 200000 points"));
}

void checkNothingPainted(Checks& checks)
{
  Stippling stippling(small());
  stippling.Paint({ 30.0, 30.0 }, false);
  settle(stippling);
  const Places before = placesOf(stippling);
  stippling.Clear();
  CHECK(checks, !stippling.Update());
  CHECK(checks, contains(stippling.GetMessage(), "Nothing is painted"));
  CHECK(checks, placesOf(stippling) == before);
  stippling.LiftBrush();
  stippling.Paint({ 100.0, 100.0 }, false);
  settle(stippling);
  CHECK(checks, stippling.GetMessage().empty());
  const double radius = stippling.GetBrushRadius();
  CHECK(checks, countNear(placesOf(stippling), 100.0, 100.0, radius + 1.0) == 1000);
}

void write(const std::string& path, int width, int height, int grey)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  image->GetPointData()->GetScalars()->Fill(grey);
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(image);
  writer->Write();
}

void checkFiles(Checks& checks)
{
  Stippling stippling(small());
  settle(stippling);
  const Places before = placesOf(stippling);
  std::ofstream("live-broken.png") << "no picture";
  std::ofstream("live-text.txt") << "no\npicture but a text of two lines"; // see takesAnything
  for (const char* path : { "live-broken.png", "live-text.txt", "live-nowhere.png", "." })
  {
    CHECK(checks, !stippling.Open(path));
    CHECK(checks, contains(stippling.GetMessage(), std::string(path) + " holds no picture"));
    CHECK(checks, !stippling.Update() && placesOf(stippling) == before);
  }
  write("live-pixel.png", 1, 1, 100);
  write("live-line.png", 400, 1, 100);
  write("live-photo.png", 80, 40, 100);
  write("live-white.png", 40, 40, 255);
  const std::map<std::string, std::array<int, 2>> sizes = { { "live-pixel.png", { 128, 128 } },
    { "live-line.png", { 128, 16 } }, { "live-photo.png", { 128, 64 } } };
  for (const auto& [path, size] : sizes)
  {
    CHECK(checks, stippling.Open(path));
    settle(stippling);
    Painting& painting = stippling.GetPainting();
    CHECK(checks, painting.Width() == size[0] && painting.Height() == size[1]);
    CHECK_NEAR(checks, painting.Painted(size[0] - 1, 7), 155.0 / 255.0, 1e-6);
    const Places places = placesOf(stippling);
    CHECK(checks, places.size() == 1000 && compare(before, places).second == 1000);
  }
  CHECK(checks, stippling.Open("live-white.png"));
  settle(stippling);
  CHECK(checks, contains(stippling.GetMessage(), "Nothing is painted"));
  CHECK(checks, placesOf(stippling).size() == 1000);
  for (const char* path : { "live-broken.png", "live-text.txt", "live-pixel.png", "live-line.png",
         "live-photo.png", "live-white.png" })
  {
    std::remove(path);
  }
}

} // namespace

int TestLiveStippling(int, char*[])
{
  return runChecks({ checkPainting, checkResize, checkPairs, checkPointsFollowInk,
    checkNumberOfPoints, checkNothingPainted, checkFiles });
}
