// SPDX-License-Identifier: BSD-3-Clause
// FoldedCells and LargestBlockError of vtkTransportMap: against the arrays of its output, and the
// warning.
#include "MapTest.h"

#include <sstream>

namespace
{

// Of each size, cells or points: 1, a disc or ball of `contrast` in the middle, and nothing below
// `from` along x.
vtkSmartPointer<vtkImageData> makeDisc(
  const std::array<int, 3>& n, bool cells, double contrast, double from = 0.0)
{
  const int extra = cells ? 1 : 0;
  return makeImage(
    n[0] + extra, n[1] + extra, n[2] > 1 ? n[2] + extra : 1, cells, [=](vtkIdType i) {
      const double x = (static_cast<double>(i % n[0]) + 0.5) / n[0];
      const double y = (static_cast<double>(i / n[0] % n[1]) + 0.5) / n[1];
      const double z = (static_cast<double>(i / n[0] / n[1]) + 0.5) / n[2];
      const double r = std::hypot(x - 0.5, y - 0.5, z - 0.5);
      return x < from ? 0.0 : r < 0.17 ? contrast : 1.0;
    });
}

struct Folds
{
  int Count = 0;
  int All = 0;       // samples that count if they have mass
  double Area = 0.0; // of the folded, in samples
};

// Samples with a determinant that is not positive and a density that is, away from corners and
// edges of the domain.
Folds countFolds(vtkImageData* map, const std::array<int, 3>& n, bool needsMass)
{
  const Values determinants = imageValues(map, "JacobianDeterminant");
  const Values density = imageValues(map, "Density");
  Folds folds;
  for (std::size_t i = 0; i < determinants.size(); ++i)
  {
    const int at[3] = { static_cast<int>(i) % n[0], static_cast<int>(i) / n[0] % n[1],
      static_cast<int>(i) / n[0] / n[1] };
    int borders = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
      borders += n[a] > 1 && (at[a] < 2 || at[a] >= n[a] - 2) ? 1 : 0;
    }
    const bool counts = !needsMass || density[i] > 0.0;
    const bool isFolded = borders < 2 && determinants[i] <= 0.0 && counts;
    folds.All += counts ? 1 : 0;
    folds.Count += isFolded ? 1 : 0;
    folds.Area += isFolded ? -determinants[i] : 0.0;
  }
  return folds;
}

void checkFolds(Checks& checks, const std::array<int, 3>& n, bool cells, double from)
{
  vtkNew<vtkTransportMap> map;
  map->SetInputData(makeDisc(n, cells, 300.0, from));
  for (const int direction : { 0, 1 })
  {
    map->SetDirection(direction);
    for (const int steps : { 4, 32 })
    {
      map->SetNumberOfSteps(steps);
      for (const int tables : { vtkTransportMap::TABLES_WHOLE, vtkTransportMap::TABLES_TILED })
      {
        if (tables == vtkTransportMap::TABLES_TILED && steps < 32)
        {
          continue;
        }
        map->SetTables(tables);
        Messages messages(map);
        map->Update();
        CHECK(checks, messages.Errors.empty());
        const double folded = fieldValue(map->GetOutput(), "FoldedCells");
        const Folds folds = countFolds(map->GetOutput(), n, direction == 1);
        CHECK_NEAR(checks, folded, folds.Count, 0.0);
        if (direction == 1 && steps == 4)
        {
          CHECK(checks, folded > 0.0);
        }
        std::vector<std::string> said;
        for (const std::string& text : messages.Warnings)
        {
          if (contains(text, " folded: "))
          {
            said.push_back(text);
          }
        }
        // A thousandth of the samples with mass, or of the area.
        const bool areMany = folds.Count > 0 &&
          (1000 * folds.Count >= folds.All || 1000.0 * folds.Area >= n[0] * n[1] * n[2]);
        CHECK(checks, said.size() == (areMany ? 1u : 0u));
        if (!said.empty())
        {
          const int all = n[0] * n[1] * n[2];
          std::ostringstream expected;
          expected.precision(3);
          expected << static_cast<int>(folded) << " of " << all << " samples ("
                   << 100.0 * folded / all
                   << " %) are folded: JacobianDeterminant is 0 or negative there; more "
                      "NumberOfSteps unfold "
                   << (direction == 1 ? "most, but not beside regions without mass"
                                      : "some, but not at sharp edges of the density");
          checks.That(contains(said[0], expected.str().c_str()), "the text", __LINE__, said[0]);
        }
      }
    }
  }
}

// Smooth maps have none, and do not warn; also not of what is beside the corners.
void checkNoFolds(Checks& checks)
{
  vtkNew<vtkTransportMap> map;
  Messages messages(map);
  map->SetNumberOfSteps(256);
  const std::vector<vtkSmartPointer<vtkImageData>> images = { makeImage(33, 29, 1, true,
                                                                [](vtkIdType) { return 3.0; }),
    makeImage(40, 32, 1, false, smoothDensity(40, 32)),
    makeImage(17, 15, 12, false, smoothDensity(17, 15, 12)), makeDisc({ 96, 96, 1 }, true, 100.0),
    makeImage(50, 1, 1, false, bumpy) };
  for (const auto& image : images)
  {
    map->SetInputData(image);
    for (const int direction : { 0, 1 })
    {
      map->SetDirection(direction);
      map->Update();
      CHECK(checks, fieldValue(map->GetOutput(), "FoldedCells") == 0.0);
    }
  }
  CHECK(checks, messages.Errors.empty() && messages.Warnings.empty());
}

// The errors of the blocks of 4 x 4 cells of a backward map of the unit cells of an image.
Values blockErrors(vtkImageData* map, int nx, int ny)
{
  const Values moves = imageValues(map, "Displacement");
  const Values density = imageValues(map, "Density");
  const double mean = sumOf(density) / static_cast<double>(density.size());
  const auto image = [&](int i, int j) {
    const double* d = moves.data() + 3 * (j * nx + i);
    return std::array<double, 2>{ i + d[0], j + d[1] };
  };
  Values errors;
  for (int v = 0; v + 4 < ny; v += 4)
  {
    for (int u = 0; u + 4 < nx; u += 4)
    {
      double area = 0.0;
      double mass = 0.0;
      double least = mean;
      for (int j = v; j <= v + 4; ++j)
      {
        for (int i = u; i <= u + 4; ++i)
        {
          // Half of an outer cell, a quarter of one at a corner.
          const double part =
            (i == u || i == u + 4 ? 0.5 : 1.0) * (j == v || j == v + 4 ? 0.5 : 1.0);
          const double value = density[static_cast<std::size_t>(j * nx + i)];
          mass += part * value / mean;
          least = std::min(least, value);
          if (i < u + 4 && j < v + 4)
          {
            const auto a = image(i, j);
            const auto b = image(i + 1, j);
            const auto c = image(i + 1, j + 1);
            const auto d = image(i, j + 1);
            area += 0.5 * ((c[0] - a[0]) * (d[1] - b[1]) - (c[1] - a[1]) * (d[0] - b[0]));
          }
        }
      }
      if (least > 0.05 * mean)
      {
        errors.push_back(std::abs(area - mass) / mass);
      }
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

void checkBlocks(Checks& checks)
{
  constexpr int nx = 170;
  constexpr int ny = 133;
  vtkNew<vtkTransportMap> map;
  map->SetInputData(
    makeImage(nx + 1, ny + 1, 1, true, [](vtkIdType i) { return i % 37 == 5 ? 0.3 : bumpy(i); }));
  map->SetDirectionToDensityToUniform();
  for (const int tables : { vtkTransportMap::TABLES_WHOLE, vtkTransportMap::TABLES_TILED })
  {
    map->SetTables(tables);
    map->Update();
    const Values errors = blockErrors(map->GetOutput(), nx, ny);
    CHECK(checks, errors.size() > 100 && errors.size() < 42u * 33u);
    vtkDataArray* found = map->GetOutput()->GetFieldData()->GetArray("LargestBlockError");
    CHECK(checks, found && found->GetNumberOfTuples() == 1 && found->GetNumberOfComponents() == 2);
    const Values both = arrayValues(found);
    CHECK_NEAR(checks, both[0], errors[errors.size() * 999 / 1000], 1e-9);
    CHECK_NEAR(checks, both[1], errors.back(), 1e-9);
  }
}

// Falls with the steps, is none of few samples, and the same for all threads.
void checkOfSteps(Checks& checks)
{
  vtkNew<vtkTransportMap> map;
  const auto errorsAt = [&](int steps) {
    map->SetNumberOfSteps(steps);
    map->Update();
    return arrayValues(map->GetOutput()->GetFieldData()->GetArray("LargestBlockError"));
  };
  for (const bool isVolume : { false, true })
  {
    map->SetSampleDimensions(0, 0, 0);
    map->SetInputData(isVolume ? makeImage(21, 18, 19, false, smoothDensity(21, 18, 19))
                               : makeImage(64, 50, 1, false, smoothDensity(64, 50)));
    for (const int direction : { 0, 1 })
    {
      map->SetDirection(direction);
      const Values few = errorsAt(8);
      const Values many = errorsAt(128);
      CHECK(checks, many[0] > 0.0 && many[0] <= many[1] && many[1] < 0.03);
      CHECK(checks, few[0] > 3.0 * many[0]);
      for (const int threading : { 1, 2, 3 })
      {
        map->SetThreading(threading);
        CHECK(checks, errorsAt(128) == many);
      }
    }
    map->SetSampleDimensions(20, 4, 0);
    const Values none = errorsAt(8);
    CHECK(checks, none.size() == 2 && std::isnan(none[0]) && std::isnan(none[1]));
  }
}

} // namespace

int TestMapFolds(int, char*[])
{
  Checks checks;
  for (const double from : { 0.0, 0.4 })
  {
    checkFolds(checks, { 64, 60, 1 }, true, from);
    checkFolds(checks, { 64, 60, 1 }, false, from);
    checkFolds(checks, { 30, 28, 26 }, true, from);
  }
  checkNoFolds(checks);
  checkBlocks(checks);
  checkOfSteps(checks);
  return checks.Result();
}
