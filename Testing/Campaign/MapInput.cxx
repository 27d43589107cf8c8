// SPDX-License-Identifier: BSD-3-Clause
#include "Input.h"

#include "vtkAppendFilter.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Campaign
{

namespace
{

using Ring = std::vector<std::array<double, 2>>;

struct Region
{
  std::vector<Ring> Rings; // the outline first
  double Mass = 1.0;
};

// Squares with moved corners, which neighbours share.
std::vector<Region> drawRegions(RandomSource& random, int side)
{
  const double move = random.Of({ 0.0, 0.2, 0.2 });
  std::vector<std::array<double, 2>> corners;
  for (int y = 0; y <= side; ++y)
  {
    for (int x = 0; x <= side; ++x)
    {
      corners.push_back({ x + random.Real(-move, move), y + random.Real(-move, move) });
    }
  }
  const double left = random.Of({ 0.0, 0.0, 0.2, 0.6 });  // seas between
  const std::int64_t span = random.Of({ 0, 1, 3, 3, 8 }); // of masses, in powers of two
  std::vector<Region> regions;
  for (int i = 0; i < side * side; ++i)
  {
    if (random.Chance(left) && !regions.empty())
    {
      continue;
    }
    const auto at = static_cast<std::size_t>(i / side * (side + 1) + i % side);
    const std::size_t up = at + static_cast<std::size_t>(side) + 1;
    Region region{ { { corners[at], corners[at + 1], corners[up + 1], corners[up] } } };
    region.Mass = span == 0 ? 1.0 : random.Magnitude(0, static_cast<int>(span));
    regions.push_back(region);
  }
  return regions;
}

Ring squareAt(double x, double y, double half)
{
  return { { x - half, y - half }, { x + half, y - half }, { x + half, y + half },
    { x - half, y + half } };
}

// Holes with and without a region, islands, and ways to a hole and back.
void drawDetails(RandomSource& random, int side, std::vector<Region>& regions)
{
  const std::size_t count = regions.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!random.Chance(0.15))
    {
      continue;
    }
    const Ring outline = regions[i].Rings[0];
    std::array<double, 2> middle{ 0.0, 0.0 };
    for (const auto& corner : outline)
    {
      middle = { middle[0] + 0.25 * corner[0], middle[1] + 0.25 * corner[1] };
    }
    Ring hole = squareAt(middle[0], middle[1], 0.1);
    switch (random.Whole(0, 3))
    {
      case 0:
        regions[i].Rings.push_back(hole);
        break;
      case 1:
        regions[i].Rings.push_back(hole);
        regions.push_back({ { hole }, 0.05 * regions[i].Mass });
        break;
      case 2: // an island of the region in the sea
        regions[i].Rings.push_back(
          squareAt(side + 1.0 + static_cast<double>(i), -1.0, random.Real(0.1, 0.4)));
        break;
      default:
      {
        Ring keyhole = outline;
        keyhole.push_back(outline[0]);
        keyhole.insert(keyhole.end(), hole.rbegin(), hole.rend());
        keyhole.push_back(hole.back());
        regions[i].Rings[0] = keyhole;
        break;
      }
    }
  }
}

// What no map has, or few.
void drawDefect(RandomSource& random, std::vector<Region>& regions, Input& input)
{
  Region& region = regions[static_cast<std::size_t>(
    random.Whole(0, static_cast<std::int64_t>(regions.size()) - 1))];
  Ring& ring = region.Rings[0];
  const auto defect = random.Whole(0, 8);
  input.Describe("defect " + std::to_string(defect));
  State state = State::Odd;
  switch (defect)
  {
    case 0:
      region.Mass = drawExceptional(random);
      break;
    case 1:
      for (Region& each : regions)
      {
        each.Mass = 0.0;
      }
      state = State::Faulty;
      break;
    case 2: // crosses itself
      std::swap(ring[0], ring[1]);
      break;
    case 3: // no area
      ring = { ring[0], ring[1], ring[0], ring[1] };
      break;
    case 4: // overlaps
      for (auto& corner : ring)
      {
        corner[0] += 0.5;
      }
      break;
    case 5: // far away
      for (auto& corner : ring)
      {
        corner[0] += random.Of({ 50.0, 1e4, 1e9 });
      }
      break;
    case 6: // smaller than a cell
      ring = squareAt(ring[0][0] - 0.5, -2.0, random.Of({ 1e-3, 1e-6, 1e-12 }));
      break;
    case 7:
      ring[0] = { drawExceptional(random), drawExceptional(random) };
      break;
    default:
      region.Mass = random.Of({ 1e-300, 1e300, 5e-324, 0.0 });
      break;
  }
  input.Worsen(state);
}

class MapWriter
{
public:
  MapWriter(RandomSource& random, Input& input)
    : Random(random)
    , AreLines(random.Chance(0.4))
    , AreGrids(random.Chance(0.2))
    , HasRiver(random.Chance(0.2))
    , Turn(random.Chance(0.2))
    , Size(random.Of({ 1.0, 1.0, 1.0, 1e5, 1e-5 }))
    , Shift(random.Of({ 0.0, 0.0, -3.0, 1e3 }))
  {
    if (this->Turn)
    {
      input.Describe("in another plane");
    }
    if (this->AreGrids)
    {
      input.Describe("as grids");
    }
    if (this->HasRiver)
    {
      input.Describe("with a river");
    }
  }

  vtkSmartPointer<vtkPointSet> Write(const std::vector<Region>& regions, int first)
  {
    const auto data = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> cells;
    vtkNew<vtkDoubleArray> masses;
    vtkNew<vtkStringArray> names;
    masses->SetName("Mass");
    names->SetName("Land");
    const auto addRiver = [&](bool isHere) { // lines are numbered before polygons
      if (this->HasRiver && isHere)
      {
        masses->InsertNextValue(std::nan(""));
        names->InsertNextValue("river");
      }
    };
    addRiver(!this->AreLines);
    for (const Region& region : regions)
    {
      const std::string name = "land " + std::to_string(first++);
      for (Ring ring : region.Rings)
      {
        if (this->Random.Chance(0.3))
        {
          ring = Ring(ring.rbegin(), ring.rend());
        }
        std::vector<vtkIdType> ids;
        for (const auto& [x, y] : ring)
        {
          ids.push_back(this->AddPoint(points, x, y));
        }
        if (this->AreLines)
        {
          // The end may be a point of its own.
          const auto& [x, y] = ring[0];
          ids.push_back(this->Random.Chance(0.5) ? ids[0] : this->AddPoint(points, x, y));
        }
        cells->InsertNextCell(static_cast<vtkIdType>(ids.size()), ids.data());
        masses->InsertNextValue(region.Mass);
        names->InsertNextValue(name);
      }
    }
    addRiver(this->AreLines);
    vtkNew<vtkCellArray> river;
    vtkCellArray* const lines = this->AreLines ? cells.Get() : river.Get();
    if (this->HasRiver)
    {
      const vtkIdType ends[2] = { 0, this->AddPoint(points, this->Random.Real(-1.0, 3.0), 0.3) };
      lines->InsertNextCell(2, ends);
    }
    data->SetPoints(points);
    data->SetLines(lines);
    if (!this->AreLines)
    {
      data->SetPolys(cells);
    }
    data->GetCellData()->AddArray(masses);
    data->GetCellData()->AddArray(names);
    if (!this->AreGrids)
    {
      return data;
    }
    vtkNew<vtkAppendFilter> append;
    append->AddInputData(data);
    append->Update();
    return append->GetOutput();
  }

private:
  vtkIdType AddPoint(vtkPoints* points, double x, double y) const
  {
    const double u = this->Size * (x + this->Shift);
    const double v = this->Size * (y + this->Shift);
    return this->Turn ? points->InsertNextPoint(0.6 * u, v, 0.8 * u)
                      : points->InsertNextPoint(u, v, 0.0);
  }

  RandomSource& Random;
  const bool AreLines;
  const bool AreGrids;
  const bool HasRiver;
  const bool Turn;
  const double Size;
  const double Shift;
};

} // namespace

Input drawMap(RandomSource& random)
{
  Input input;
  const int side = random.Of({ 1, 2, 3, 4, 6 });
  std::vector<Region> regions = drawRegions(random, side);
  drawDetails(random, side, regions);
  if (random.Chance(0.25))
  {
    drawDefect(random, regions, input);
  }
  input.Describe(std::to_string(regions.size()) + " regions");
  MapWriter writer(random, input);
  if (!random.Chance(0.3))
  {
    input.Data = writer.Write(regions, 0);
    return input;
  }
  input.Describe("as blocks");
  const auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::size_t i = 0; i < regions.size(); ++i)
  {
    blocks->SetBlock(
      static_cast<unsigned int>(i), writer.Write({ regions[i] }, static_cast<int>(i)));
  }
  input.Data = blocks;
  return input;
}

} // namespace Campaign
