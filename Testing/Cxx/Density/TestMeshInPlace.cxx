// SPDX-License-Identifier: BSD-3-Clause
// A density of a mesh that a program writes into, with Modified() of the data set only.
#include "BlocksTest.h"
#include "MeshSampler.h"
#include "TestData.h"

#include "vtkAppendFilter.h"
#include "vtkCellArray.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkIdTypeArray.h"
#include "vtkRectilinearGrid.h"
#include "vtkTransportSampler.h"
#include "vtkUnstructuredGrid.h"

#include <vector>

namespace
{

// Without a lattice: one point is moved.
vtkSmartPointer<vtkUnstructuredGrid> makeMesh(bool isLattice = false)
{
  vtkNew<vtkAppendFilter> append;
  append->AddInputData(unitCells(6, 5, 4));
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  append->Update();
  auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
  mesh->DeepCopy(append->GetOutput());
  if (!isLattice)
  {
    vtkDataArray* x = mesh->GetPoints()->GetData();
    x->SetComponent(x->GetNumberOfTuples() - 1, 0, 6.25);
  }
  return mesh;
}

void scale(vtkDataArray* array, double factor)
{
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      array->SetComponent(i, c, factor * array->GetComponent(i, c));
    }
  }
}

void checkMesh(Checks& checks)
{
  for (const bool isLattice : { false, true })
  {
    auto mesh = makeMesh(isLattice);
    auto sampler = makeSampler(mesh);
    const double mass = massOf(sampler);
    CHECK(checks, mass > 0.0);
    const vtkMTimeType built = sampler->GetTableBuildTime();

    mesh->Modified(); // nothing is written
    CHECK_NEAR(checks, massOf(sampler), mass, 0.0);
    CHECK(checks, sampler->GetTableBuildTime() == built);
    vtkNew<vtkUnstructuredGrid> around; // as ParaView makes one at every update
    around->ShallowCopy(mesh);
    sampler->SetInputDataObject(around);
    CHECK_NEAR(checks, massOf(sampler), mass, 0.0);
    CHECK(checks, sampler->GetTableBuildTime() == built);

    scale(mesh->GetCellData()->GetScalars(), 2.0);
    around->Modified();
    CHECK_NEAR(checks, massOf(sampler) / mass, 2.0, 1e-12);
    scale(mesh->GetPoints()->GetData(), 2.0);
    around->Modified();
    CHECK_NEAR(checks, massOf(sampler) / mass, 16.0, 1e-6);
  }
}

// One cell becomes another one.
void checkCells(Checks& checks)
{
  vtkNew<vtkDataSetTriangleFilter> triangulate;
  triangulate->SetInputData(makeImage(2, 2, 1, true, [](vtkIdType) { return 1.0; }));
  triangulate->Update();
  vtkUnstructuredGrid* mesh = triangulate->GetOutput();
  auto sampler = makeSampler(mesh);
  CHECK_NEAR(checks, massOf(sampler), 1.0, 1e-9);
  const Values before = coordinates(sampler->GetOutput());
  vtkDataArray* points = mesh->GetCells()->GetConnectivityArray();
  for (vtkIdType i = 0; i < 3; ++i)
  {
    points->SetComponent(i, 0, points->GetComponent(i + 3, 0));
  }
  mesh->Modified();
  CHECK(checks, massOf(sampler) > 0.0);
  CHECK(checks, largestDifference(before, coordinates(sampler->GetOutput())) > 0.01);
}

void checkGrid(Checks& checks)
{
  vtkNew<vtkRectilinearGrid> grid;
  grid->SetDimensions(3, 2, 2);
  const auto coordinate = [](const char* name, vtkIdType count) {
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName(name);
    for (vtkIdType i = 0; i < count; ++i)
    {
      array->InsertNextValue(static_cast<double>(i * i));
    }
    return array;
  };
  auto x = coordinate("x", 3);
  grid->SetXCoordinates(x);
  grid->SetYCoordinates(coordinate("y", 2));
  grid->SetZCoordinates(coordinate("z", 2));
  vtkNew<vtkDoubleArray> values;
  values->SetName("Density");
  values->InsertNextValue(1.0);
  values->InsertNextValue(2.0);
  grid->GetCellData()->SetScalars(values);
  auto sampler = makeSampler(grid);
  CHECK_NEAR(checks, massOf(sampler), 7.0, 1e-9);
  x->SetValue(2, 5.0);
  grid->Modified();
  CHECK_NEAR(checks, massOf(sampler), 9.0, 1e-9);
}

// Values in blocks, marked at the block or at what holds it.
void checkBlocks(Checks& checks)
{
  auto mesh = makeMesh();
  auto inner = makeBlocks({ mesh });
  auto outer = makeBlocks({ inner });
  auto sampler = makeSampler(outer);
  const double mass = massOf(sampler);
  vtkDataArray* values = mesh->GetCellData()->GetScalars();
  double factor = 1.0;
  for (vtkDataObject* marked : { static_cast<vtkDataObject*>(mesh),
         static_cast<vtkDataObject*>(inner), static_cast<vtkDataObject*>(outer) })
  {
    scale(values, 2.0);
    factor *= 2.0;
    marked->Modified();
    sampler->Modified(); // VTK does not look into blocks
    CHECK_NEAR(checks, massOf(sampler) / mass, factor, 1e-12);
  }
}

// Arrays beside the density are those of the last data set.
void checkOtherArrays(Checks& checks)
{
  auto image = unitCells(6, 5, 4);
  const std::vector<vtkSmartPointer<vtkDataObject>> all{ makeMesh(), makeMesh(true),
    makeTiles(image, 3) };
  for (const vtkSmartPointer<vtkDataObject>& kept : all)
  {
    auto sampler = makeSampler(kept);
    sampler->Update();
    const vtkMTimeType built = sampler->GetTableBuildTime();
    for (const double value : { 3.0, 4.0 })
    {
      const auto next = vtkSmartPointer<vtkDataObject>::Take(kept->NewInstance());
      next->ShallowCopy(kept);
      auto* blocks = vtkMultiBlockDataSet::SafeDownCast(next);
      for (unsigned int b = 0; b < (blocks ? blocks->GetNumberOfBlocks() : 1); ++b)
      {
        auto* set = vtkDataSet::SafeDownCast(blocks ? blocks->GetBlock(b) : next.Get());
        vtkNew<vtkDoubleArray> other;
        other->SetName("Other");
        other->SetNumberOfTuples(set->GetNumberOfCells());
        other->Fill(value);
        set->GetCellData()->AddArray(other);
      }
      sampler->SetInputDataObject(next);
      sampler->Update();
      vtkDataArray* sampled = pointArray(sampler->GetOutput(), "Other");
      CHECK(checks, sampled && sampled->GetComponent(5, 0) == value);
      CHECK(checks, sampler->GetTableBuildTime() == built);
    }
  }
}

} // namespace

int TestMeshInPlace(int, char*[])
{
  return runChecks({ checkMesh, checkCells, checkGrid, checkBlocks, checkOtherArrays });
}
