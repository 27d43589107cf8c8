// SPDX-License-Identifier: BSD-3-Clause
// vtkTransportMap with a target: maps that are known, costs, masses and both directions.
#include "MapTargetTest.h"

#include "vtkFloatArray.h"

#include <algorithm>
#include <array>

namespace
{

// The root mean square over the mass of what displacements are off by.
double errorOf(vtkTransportMap* map, const std::function<std::array<double, 2>(const double*)>& of)
{
  vtkImageData* output = map->GetOutput();
  const Values displacements = imageValues(output, "Displacement");
  const Values places = samplePlaces(output);
  const Values shares = sharesOf(output);
  double sum = 0.0;
  for (std::size_t i = 0; i < shares.size() && displacements.size() == 3 * shares.size(); ++i)
  {
    const double* d = displacements.data() + 3 * i;
    const std::array<double, 2> wanted = of(places.data() + 3 * i);
    sum += shares[i] * (std::pow(d[0] - wanted[0], 2) + std::pow(d[1] - wanted[1], 2));
  }
  return displacements.empty() ? HUGE_VAL : std::sqrt(sum);
}

// The same density elsewhere, in another box: one displacement for all.
void checkTranslated(Checks& checks)
{
  const auto source = makeImage(31, 25, 1, true, smoothDensity(30, 24));
  vtkNew<vtkImageData> target;
  target->DeepCopy(source);
  target->SetOrigin(7.0, -3.0, 0.0);
  for (const int method : { 0, 1 })
  {
    auto map = makeMapBetween(source, target);
    map->SetMethod(method);
    map->SetNumberOfSteps(256);
    map->Update();
    const double error = errorOf(map, [](const double*) { return std::array{ 7.0, -3.0 }; });
    CHECK_NEAR(checks, error, 0.0, method == 1 ? 0.03 : 0.01);
    CHECK_NEAR(checks, fieldValue(map->GetOutput(), "TransportCost"), 58.0, 0.1);
    const Values determinants = imageValues(map->GetOutput(), "JacobianDeterminant");
    for (std::size_t i = 0; i < determinants.size(); ++i)
    {
      const std::size_t x = i % 30;
      const std::size_t y = i / 30;
      const bool isInside = x > 1 && x < 28 && y > 1 && y < 22; // in corners it has none
      CHECK_NEAR(checks, determinants[i], 1.0, isInside ? 0.05 : 1.0);
    }
  }
}

// Between two bells the map is linear. Both methods find it: along each axis there is one map that
// keeps the order.
void checkBells(Checks& checks)
{
  constexpr int side = 96;
  const Bell from{ 40.0, 44.0, 6.0 };
  const Bell to{ 54.0, 50.0, 9.0, 5.0 };
  const double grow = to.Width / from.Width;
  const auto source = from.On(side);
  for (const int method : { 0, 1 })
  {
    auto map = makeMapBetween(source, to.On(side));
    map->SetMethod(method);
    map->SetNumberOfSteps(256);
    map->Update();
    vtkImageData* output = map->GetOutput();
    const double error = errorOf(map, [&](const double* x) {
      return std::array{ to.X + grow * (x[0] - from.X) - x[0],
        to.Y + grow * (x[1] - from.Y) - x[1] };
    });
    CHECK_NEAR(checks, error, 0.0, method == 1 ? 0.3 : 0.03);
    // Of Gaussians: the square of the way, and that of the difference of the widths, for each axis.
    const double cost = 14.0 * 14.0 + 6.0 * 6.0 + 2.0 * 3.0 * 3.0;
    CHECK_NEAR(checks, fieldValue(output, "TransportCost"), cost, 0.003 * cost);
    const std::size_t centre = 44 * side + 40;
    CHECK_NEAR(
      checks, imageValues(output, "JacobianDeterminant")[centre], grow * grow, 0.02 * grow * grow);
    CHECK_NEAR(checks, imageValues(output, "Divergence")[centre], 2.0 * (grow - 1.0), 0.02);
    if (method == 1)
    {
      const double bound = fieldValue(output, "TransportCostLowerBound");
      CHECK_NEAR(checks, bound, cost, 0.003 * cost);
      CHECK(checks, bound <= cost * (1.0 + 1e-4));
      CHECK_NEAR(checks, fieldValue(output, "OptimalityGap"), 0.0, 0.003);
    }
  }
}

// One density in both places stays where it is: exactly with the steps, and without any error with
// Optimal.
void checkIdentical(Checks& checks)
{
  const auto source = makeImage(31, 25, 1, true, smoothDensity(30, 24));
  auto map = makeMapBetween(source, source);
  double before = HUGE_VAL;
  for (const int steps : { 16, 64, 256 })
  {
    map->SetNumberOfSteps(steps);
    map->Update();
    const double cost = fieldValue(map->GetOutput(), "TransportCost");
    CHECK(checks, cost < 0.3 * before);
    before = cost;
  }
  CHECK_NEAR(checks, before, 0.0, 1e-4);
  map->SetMethodToOptimal();
  map->Update();
  CHECK_NEAR(checks, fieldValue(map->GetOutput(), "TransportCost"), 0.0, 1e-3);
  CHECK_NEAR(checks, fieldValue(map->GetOutput(), "TransportCostLowerBound"), 0.0, 1e-9);
  CHECK(checks, fieldValue(map->GetOutput(), "OptimalityGap") == 0.0);
}

// CostDensity is the share of the mass times the squared displacement, and sums up to the cost.
void checkCosts(Checks& checks)
{
  const std::array<std::array<int, 3>, 3> sizes = { { { 40, 1, 1 }, { 17, 13, 1 }, { 9, 8, 7 } } };
  for (const auto& [nx, ny, nz] : sizes)
  {
    for (const bool cells : { true, false })
    {
      const auto source = makeImage<vtkFloatArray>(nx, ny, nz, cells, bumpy);
      source->SetSpacing(0.5, 2.0, 1.5);
      const auto target =
        makeImage(nx, ny, nz, cells, [](vtkIdType i) { return 3.0 * bumpy(i + 5); });
      target->SetOrigin(2.0, 0.0, 0.0);
      auto map = makeMapBetween(source, target);
      for (const int method : { 0, 1 })
      {
        map->SetMethod(method);
        map->Update();
        vtkImageData* output = map->GetOutput();
        const Values costs = imageValues(output, "CostDensity");
        const Values displacements = imageValues(output, "Displacement");
        const Values shares = sharesOf(output);
        const double cost = fieldValue(output, "TransportCost");
        CHECK(checks, costs.size() == shares.size() && cost > 0.0);
        CHECK_NEAR(checks, sumOf(costs) / cost, 1.0, 1e-12);
        for (std::size_t i = 0; i < costs.size(); ++i)
        {
          const double wanted = shares[i] * squareAt(displacements, i);
          CHECK_NEAR(checks, costs[i], wanted, 1e-9 * cost);
        }
        CHECK_NEAR(checks,
          fieldValue(output, "TotalMass") /
            (sumOf(imageValues(output, "Density")) * 0.5 * (ny > 1 ? 2.0 : 1.0) *
              (nz > 1 ? 1.5 : 1.0)),
          1.0, 1e-6);
      }
      // Of other samples, the parts of the mass in their cells.
      map->SetSampleDimensions(5, ny > 1 ? 21 : 1, nz > 1 ? 4 : 1);
      map->Update();
      const Values coarse = imageValues(map->GetOutput(), "CostDensity");
      CHECK(checks, !coarse.empty());
      CHECK_NEAR(checks, sumOf(coarse) / fieldValue(map->GetOutput(), "TransportCost"), 1.0, 1e-12);
    }
  }
}

// What is moved makes the target: masses of blocks of cells, and LargestBlockError.
void checkMasses(Checks& checks)
{
  constexpr int side = 64;
  constexpr std::size_t blocks = 8;
  constexpr int fine = 4;
  const auto source = makeImage(side + 1, side + 1, 1, true, smoothDensity(side, side));
  const auto target = makeImage(side + 1, side + 1, 1, true,
    [](vtkIdType i) { return smoothDensity(side, side)(side * side - 1 - i); });
  const Values shares = sharesOf(source);
  const Values wanted = sharesOf(target);
  for (const int method : { 0, 1 })
  {
    auto map = makeMapBetween(source, target);
    map->SetMethod(method);
    map->SetNumberOfSteps(128);
    map->Update();
    vtkDataArray* errors = map->GetOutput()->GetFieldData()->GetArray("LargestBlockError");
    CHECK(checks, errors && errors->GetNumberOfComponents() == 2);
    CHECK_NEAR(checks, errors->GetComponent(0, 1), 0.0, method == 1 ? 0.05 : 0.02);
    CHECK(checks, errors->GetComponent(0, 0) > 0.0);
    CHECK(checks, fieldValue(map->GetOutput(), "FoldedCells") == 0.0);
    // Several samples in each cell, so that few pass the border of a block together.
    map->SetSampleDimensions(fine * side, fine * side, 1);
    map->Update();
    const Values displacements = imageValues(map->GetOutput(), "Displacement");
    const Values places = samplePlaces(map->GetOutput());
    Values left(blocks * blocks, 0.0);
    const auto at = [](double place) { return static_cast<std::size_t>(place) * blocks / side; };
    for (std::size_t i = 0; i < displacements.size() / 3; ++i)
    {
      const double* from = places.data() + 3 * i;
      const double* way = displacements.data() + 3 * i;
      const std::size_t cell =
        static_cast<std::size_t>(from[1]) * side + static_cast<std::size_t>(from[0]);
      left[at(from[1] + way[1]) * blocks + at(from[0] + way[0])] += shares[cell] / (fine * fine);
      left[at(from[1]) * blocks + at(from[0])] -= wanted[cell] / (fine * fine);
    }
    for (const double rest : left)
    {
      CHECK_NEAR(checks, rest, 0.0, 0.1 / (blocks * blocks));
    }
    // A map that does not reach its target is found out.
    map->SetSampleDimensions(0, 0, 0);
    map->SetMethod(0);
    map->SetIntegratorToEuler();
    map->SetNumberOfSteps(3);
    map->Update();
    errors = map->GetOutput()->GetFieldData()->GetArray("LargestBlockError");
    CHECK(checks, errors->GetComponent(0, 1) > 0.1);
  }
}

// DensityToUniform leads back: as with both inputs exchanged, to the bit.
void checkDirections(Checks& checks)
{
  const auto source = makeImage(19, 14, 1, false, bumpy);
  const auto target = makeImage(23, 9, 1, true, [](vtkIdType i) { return bumpy(i + 7); });
  target->SetOrigin(3.0, 4.0, 0.0);
  target->SetSpacing(0.7, 2.0, 1.0);
  for (const int method : { 0, 1 })
  {
    auto back = makeMapBetween(source, target);
    auto exchanged = makeMapBetween(target, source);
    for (vtkTransportMap* map : { back.Get(), exchanged.Get() })
    {
      map->SetMethod(method);
    }
    back->SetDirectionToDensityToUniform();
    for (const char* name : { "Displacement", "Divergence", "JacobianDeterminant", "CostDensity" })
    {
      back->Update();
      exchanged->Update();
      const Values values = imageValues(back->GetOutput(), name);
      CHECK(checks, values.size() == 22u * 8 * (name[2] == 's' && name[0] == 'D' ? 3 : 1));
      CHECK(checks, values == imageValues(exchanged->GetOutput(), name));
    }
    // The cost of the way there is that of the way back.
    const double cost = fieldValue(back->GetOutput(), "TransportCost");
    back->SetDirectionToUniformToDensity();
    back->Update();
    CHECK_NEAR(checks, fieldValue(back->GetOutput(), "TransportCost") / cost, 1.0, 0.03);
  }
}

// Rotated images, with the same map in their axes.
void checkGeometry(Checks& checks)
{
  const double turn[9] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
  const auto source = makeImage(12, 9, 1, true, bumpy);
  const auto target = makeImage(8, 15, 1, true, [](vtkIdType i) { return bumpy(i + 3); });
  target->SetSpacing(1.5, 0.5, 1.0);
  auto map = makeMapBetween(source, target);
  for (const int method : { 0, 1 })
  {
    for (vtkImageData* image : { source.Get(), target.Get() })
    {
      image->SetDirectionMatrix(1, 0, 0, 0, 1, 0, 0, 0, 1);
    }
    map->SetMethod(method);
    map->Update();
    const Values straight = imageValues(map->GetOutput(), "Displacement");
    const double cost = fieldValue(map->GetOutput(), "TransportCost");
    for (vtkImageData* image : { source.Get(), target.Get() })
    {
      image->SetDirectionMatrix(turn);
    }
    map->Update();
    const Values turned = imageValues(map->GetOutput(), "Displacement");
    CHECK(checks, straight.size() == turned.size() && !turned.empty());
    double worst = 0.0;
    for (std::size_t i = 0; i < straight.size() && straight.size() == turned.size(); i += 3)
    {
      worst = std::max({ worst, std::abs(turned[i] + straight[i + 1]),
        std::abs(turned[i + 1] - straight[i]), std::abs(turned[i + 2]) });
    }
    CHECK_NEAR(checks, worst, 0.0, 1e-9);
    CHECK_NEAR(checks, fieldValue(map->GetOutput(), "TransportCost") / cost, 1.0, 1e-9);
  }
}

} // namespace

int TestMapTarget(int, char*[])
{
  return runChecks({ checkTranslated, checkBells, checkIdentical, checkCosts, checkMasses,
    checkDirections, checkGeometry });
}
