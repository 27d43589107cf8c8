// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that the conformal map of vtkSurfaceSampler does not serve, and what is said of them.
#include "SurfaceSamplerTest.h"

#include <algorithm>
#include <set>

namespace
{

// A tube of radius 1, closed at the height `height`, over a disk of radius 2.
vtkSmartPointer<vtkPolyData> makeFinger(double height)
{
  constexpr int cells = 64;
  return makeSheet(cells, cells, [height](double i, double j) {
    const double x = i - cells / 2;
    const double y = j - cells / 2;
    const double around = std::atan2(y, x);
    const double out = std::max(std::abs(x), std::abs(y)) / (cells / 2); // 0 to 1
    const double radius = out < 0.2 ? out / 0.2 : std::max(1.0, 1.0 + (out - 0.9) / 0.1);
    const double z = height * std::min(1.0, std::max(0.0, (0.9 - out) / 0.7));
    return std::array<double, 3>{ radius * std::cos(around), radius * std::sin(around), z };
  });
}

// Particles are as many along a tube as there is of it.
void checkFinger(Checks& checks, double height, std::size_t warnings)
{
  auto finger = makeFinger(height);
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  Messages messages(sampler);
  sampler->SetInputData(finger);
  sampler->SetResolution(512);
  const Values points = coordinates(runSampler(sampler));
  CHECK(checks, points.size() == 3 * 8192);
  constexpr std::size_t bands = 7;
  Values counts(bands, 0.0);
  for (std::size_t i = 2; i < points.size(); i += 3)
  {
    const double part = points[i] / height;
    if (part > 1e-6 && part < 1.0 - 1e-6)
    {
      counts[static_cast<std::size_t>(bands * part)] += 1.0;
    }
  }
  const double mean = sumOf(counts) / bands;
  for (const double count : counts)
  {
    checks.That(std::abs(count - mean) < 0.12 * mean, "as many", __LINE__, std::to_string(count));
  }
  CHECK(checks, messages.Errors.empty() && messages.Warnings.size() == warnings);
  for (const std::string& warning : messages.Warnings)
  {
    CHECK(checks,
      contains(warning,
        "The conformal map squeezes much of the surface into few cells: the particles "
        "come from the area-preserving map instead"));
  }
}

void checkTeeth(Checks& checks)
{
  auto teeth = makeTeeth();
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  Messages messages(sampler);
  sampler->SetInputData(teeth);
  CHECK(checks, runSampler(sampler)->GetNumberOfPoints() == 8192);
  const auto hasPart = [](const std::string& text) {
    return contains(text, " of 24 triangles have all points on one side of the square");
  };
  CHECK(checks, messages.Errors.empty());
  CHECK(checks, std::any_of(messages.Warnings.begin(), messages.Warnings.end(), hasPart));
}

// Mass on single cells, which few steps miss: the more steps, the fewer particles are moved.
void checkMoved(Checks& checks)
{
  auto hill = makeHill();
  hill->GetCellData()->AddArray(makeArray<vtkIntArray>("Light", hill->GetNumberOfCells(),
    [](vtkIdType i) { return i / 2 % 7 == 3 && i / 48 % 5 == 2 ? 1.0 : 0.0; }));
  vtkNew<vtkSurfaceSampler> sampler;
  sampler->SetMethodToFlow();
  sampler->SetInputData(hill);
  sampler->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Light");
  sampler->SetNumberOfParticles(20000);
  sampler->SetResolution(300);
  std::set<bool> given;
  for (const int steps : { 1, 2, 4, 8, 16 })
  {
    Messages messages(sampler);
    sampler->SetNumberOfSteps(steps);
    const double moved = fieldValue(runSampler(sampler), "MovedParticles");
    CHECK(checks, messages.Warnings.size() == (moved >= 20.0 ? 1u : 0u));
    CHECK(checks,
      messages.Warnings.empty() ||
        contains(messages.Warnings[0],
          std::to_string(static_cast<int>(moved)) + " of 20000 particles in empty cells moved"));
    if (moved > 0.0)
    {
      given.insert(moved >= 20.0);
    }
  }
  CHECK(checks, given.size() == 2);
}

} // namespace

int TestSurfaceSamplerWarnings(int, char*[])
{
  Checks checks;
  checkFinger(checks, 2.0, 0);
  checkFinger(checks, 12.0, 1);
  checkTeeth(checks);
  checkMoved(checks);
  return checks.Result();
}
