// SPDX-License-Identifier: BSD-3-Clause
// What the output of vtkTransportMap holds: arrays, attributes, data of the input, masses, costs.
#include "MapTest.h"

#include "vtkStringArray.h"

#include <numeric>

namespace
{

double meanSquare(const Values& displacement, const Values& weights)
{
  double cost = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    const double* d = displacement.data() + 3 * i;
    cost += weights[i] * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    all += weights[i];
  }
  return cost / all;
}

void checkArrays(Checks& checks, bool cells)
{
  auto image = makeImage<vtkDoubleArray>(9, 8, 6, cells, bumpy);
  image->SetSpacing(0.5, 2.0, 1.5);
  image->SetOrigin(7.0, -3.0, 1.0);
  vtkNew<vtkTransportMap> map;
  map->SetInputData(image);
  map->Update();
  vtkImageData* output = map->GetOutput();
  auto* data = output->GetAttributes(cells ? vtkDataObject::CELL : vtkDataObject::POINT);
  auto* other = output->GetAttributes(cells ? vtkDataObject::POINT : vtkDataObject::CELL);
  const vtkIdType count = cells ? image->GetNumberOfCells() : image->GetNumberOfPoints();
  const char* const names[] = { "Displacement", "Divergence", "JacobianDeterminant" };
  for (const char* name : names)
  {
    vtkDataArray* array = data->GetArray(name);
    CHECK(checks, array && array->GetDataType() == VTK_DOUBLE);
    CHECK(checks, array && array->GetNumberOfTuples() == count);
    CHECK(checks, array && array->GetNumberOfComponents() == (name == names[0] ? 3 : 1));
    CHECK(checks, other->GetArray(name) == nullptr);
  }
  CHECK(checks, data->GetVectors() == data->GetArray("Displacement"));
  CHECK(checks, data->GetScalars() && data->GetScalars()->GetName() == std::string("Density"));
  CHECK(checks, std::equal(image->GetBounds(), image->GetBounds() + 6, output->GetBounds()));

  const Values density = imageValues(output, "Density");
  const double measure = 0.5 * 2.0 * 1.5;
  const double mass = measure * std::accumulate(density.begin(), density.end(), 0.0);
  CHECK_NEAR(checks, fieldValue(output, "TotalMass") / mass, 1.0, 1e-14);
  const Values even(density.size(), 1.0);
  CHECK_NEAR(checks,
    fieldValue(output, "TransportCost") / meanSquare(imageValues(output, "Displacement"), even),
    1.0, 1e-13);
  map->SetDirectionToDensityToUniform();
  map->Update();
  CHECK_NEAR(checks,
    fieldValue(output, "TransportCost") / meanSquare(imageValues(output, "Displacement"), density),
    1.0, 1e-11);
  CHECK_NEAR(checks, fieldValue(output, "TotalMass") / mass, 1.0, 1e-14);
}

// The input's field data is kept; its other data where they still fit.
void checkInputData(Checks& checks)
{
  auto image = makeImage(9, 8, 1, true, bumpy);
  const auto add = [](vtkFieldData* data, const char* name, vtkIdType count) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfTuples(count);
    array->FillValue(3.5);
    data->AddArray(array);
  };
  add(image->GetPointData(), "OnPoints", image->GetNumberOfPoints());
  add(image->GetCellData(), "OnCells", image->GetNumberOfCells());
  add(image->GetCellData(), "Displacement", image->GetNumberOfCells()); // has to give way
  add(image->GetFieldData(), "TotalMass", 1);
  vtkNew<vtkStringArray> words;
  words->SetName("Words");
  words->InsertNextValue("kept");
  image->GetFieldData()->AddArray(words);
  vtkNew<vtkTransportMap> map;
  map->SetInputData(image);
  for (const int samples : { 0, 8, 5 }) // as the input by default, explicitly, other
  {
    map->SetSampleDimensions(samples, 0, 0);
    map->Update();
    vtkImageData* output = map->GetOutput();
    const bool same = samples != 5;
    CHECK(checks, (output->GetPointData()->GetArray("OnPoints") != nullptr) == same);
    CHECK(checks, (output->GetCellData()->GetArray("OnCells") != nullptr) == same);
    CHECK(checks, (output->GetCellData()->GetArray("Density") != nullptr) == same);
    CHECK(checks, imageValues(output, "Displacement").size() == (same ? 56u : 35u) * 3);
    CHECK(checks, fieldValue(output, "TotalMass") != 3.5);
    CHECK(checks, output->GetFieldData()->GetAbstractArray("Words") != nullptr);
    CHECK(checks, output->GetCellData()->GetNumberOfArrays() == (same ? 5 : 3));
  }
  // The input itself is as it was.
  CHECK(checks, image->GetCellData()->GetArray("Displacement")->GetNumberOfComponents() == 1);
  CHECK(checks, image->GetFieldData()->GetArray("TransportCost") == nullptr);
}

// A uniform density is the identity up to the integrator's error, both ways.
void checkUniform(Checks& checks)
{
  vtkNew<vtkTransportMap> map;
  map->SetInputData(makeImage(40, 31, 1, false, [](vtkIdType) { return 2.0; }));
  for (const int direction : { 0, 1 })
  {
    map->SetDirection(direction);
    map->SetNumberOfSteps(64);
    map->Update();
    const double cost = fieldValue(map->GetOutput(), "TransportCost");
    CHECK_NEAR(checks, cost, 0.0, 1e-5);
    for (const double value : imageValues(map->GetOutput(), "JacobianDeterminant"))
    {
      CHECK_NEAR(checks, value, 1.0, 0.01);
    }
    map->SetNumberOfSteps(256);
    map->Update();
    CHECK_NEAR(checks, fieldValue(map->GetOutput(), "TransportCost"), 0.0, 0.05 * cost);
  }
}

// Both costs are those of one coupling, and each map undoes the other: the backward displacement,
// interpolated where the forward map ends.
void checkInverse(Checks& checks)
{
  constexpr int nx = 64;
  constexpr int ny = 50;
  vtkNew<vtkTransportMap> map;
  map->SetInputData(makeImage(nx, ny, 1, false, smoothDensity(nx, ny)));
  map->SetNumberOfSteps(128);
  map->Update();
  const Values forth = imageValues(map->GetOutput(), "Displacement");
  const double cost = fieldValue(map->GetOutput(), "TransportCost");
  map->SetDirectionToDensityToUniform();
  map->Update();
  const Values back = imageValues(map->GetOutput(), "Displacement");
  CHECK(checks, cost > 1.0);
  CHECK_NEAR(checks, fieldValue(map->GetOutput(), "TransportCost") / cost, 1.0, 0.01);
  double worst = 0.0;
  for (int j = 1; j < ny - 1; ++j)
  {
    for (int i = 1; i < nx - 1; ++i)
    {
      const double* d = forth.data() + 3 * (j * nx + i);
      const double x = i + d[0];
      const double y = j + d[1];
      const int u = std::min(std::max(static_cast<int>(x), 0), nx - 2);
      const int v = std::min(std::max(static_cast<int>(y), 0), ny - 2);
      const double r = x - u;
      const double s = y - v;
      double end[2] = { x, y };
      for (int a = 0; a < 2; ++a)
      {
        const auto at = [&](int p, int q) { return back[3 * ((v + q) * nx + u + p) + a]; };
        end[a] +=
          (1 - s) * ((1 - r) * at(0, 0) + r * at(1, 0)) + s * ((1 - r) * at(0, 1) + r * at(1, 1));
      }
      worst = std::max(worst, std::hypot(end[0] - i, end[1] - j));
    }
  }
  CHECK_NEAR(checks, worst, 0.0, 0.15);
}

} // namespace

int TestMapOutput(int, char*[])
{
  Checks checks;
  checkArrays(checks, true);
  checkArrays(checks, false);
  checkInputData(checks);
  checkUniform(checks);
  checkInverse(checks);
  return checks.Result();
}
