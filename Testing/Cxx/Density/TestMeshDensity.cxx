// SPDX-License-Identifier: BSD-3-Clause
// The density of a mesh on an image: what it is where the mesh is, aborts, threads.
#include "ProgressTest.h"
#include "TestData.h"

#include "Bridge/VTKCompatibility.h"

#include "vtkDataSetTriangleFilter.h"
#include "vtkImageData.h"
#include "vtkTransportMap.h"
#include "vtkTransportSampler.h"
#include "vtkUnstructuredGrid.h"
#ifdef RECTIFIEDTRANSPORT_VTK_HAS_CELL_TYPES_OF_ANY_ARRAY
#include "vtkConstantArray.h"
#endif

#include <algorithm>

namespace
{

// The tetrahedra of an image's cells.
vtkSmartPointer<vtkUnstructuredGrid> makeTetrahedra(int points, bool cells)
{
  vtkNew<vtkDataSetTriangleFilter> triangulate;
  triangulate->SetInputData(makeImage(points, points, points, cells, bumpy));
  triangulate->Update();
  return triangulate->GetOutput();
}

// On the image's own cells the means are the values of these.
void checkMeans(Checks& checks)
{
  auto image = makeImage(9, 9, 9, true, bumpy);
  const Values expected = imageValues(image, "Density");
  vtkNew<vtkTransportMap> map;
  map->SetInputDataObject(makeTetrahedra(9, true));
  map->SetDensityResolution(8);
  map->Update();
  const Values found = imageValues(map->GetOutput(), "Density");
  CHECK(checks, found.size() == expected.size());
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i)
  {
    checks.Near(found[i], expected[i], 1e-12 * expected[i], "the value of a cell", __LINE__);
  }
}

// Where all cells are of one type, VTK may keep it once.
#ifdef RECTIFIEDTRANSPORT_VTK_HAS_CELL_TYPES_OF_ANY_ARRAY
void checkOneType(Checks& checks)
{
  const auto mesh = makeTetrahedra(5, true);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputDataObject(mesh);
  sampler->SetNumberOfParticles(100);
  sampler->Update();
  const double mass = fieldValue(sampler->GetOutput(), "TotalMass");
  vtkNew<vtkConstantArray<unsigned char>> types;
  types->ConstructBackend(static_cast<unsigned char>(VTK_TETRA));
  types->SetNumberOfTuples(mesh->GetNumberOfCells());
  mesh->SetCells(types, mesh->GetCells());
  sampler->Update();
  CHECK(checks, fieldValue(sampler->GetOutput(), "TotalMass") == mass);

  types->SetNumberOfTuples(mesh->GetNumberOfCells() - 1);
  mesh->Modified();
  ErrorTest(checks, sampler).Expect("there must be one for each", __LINE__);
}
#else
void checkOneType(Checks&) {}
#endif

void checkAborts(Checks& checks)
{
  auto mesh = makeTetrahedra(64, false);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputDataObject(mesh);
  sampler->SetNumberOfParticles(1000);
  int resolution = 128;
  for (const int delay : { 0, 20, 200 })
  {
    checkAbort(
      checks, sampler, 0.0, [&]() { sampler->SetDensityResolution(++resolution); }, __LINE__,
      delay);
  }
  sampler->Modified();
  sampler->Update();
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 1000);
}

} // namespace

int TestMeshDensity(int, char*[])
{
  return runChecks({ checkMeans, checkOneType, checkAborts });
}
