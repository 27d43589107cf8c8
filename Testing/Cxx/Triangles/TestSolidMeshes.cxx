// SPDX-License-Identifier: BSD-3-Clause
// vtkSolidDensity on real meshes, turned at random: volumes against vtkMassProperties, no leaks.
#include "MeshFile.h"
#include "SolidTest.h"

#include "vtkFeatureEdges.h"

#include <random>

namespace
{

vtkSmartPointer<vtkPolyData> open(const std::string& name)
{
  return readMesh(RECTIFIEDTRANSPORT_MESHES "/" + name + ".off");
}

void checkVolume(Checks& checks, const std::string& name)
{
  auto mesh = open(name);
  checks.That(mesh != nullptr, "a mesh", __LINE__, name);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int run = 0; mesh && run < 3; ++run)
  {
    vtkNew<vtkTransform> transform;
    if (run > 0)
    {
      transform->RotateWXYZ(360.0 * normal(random), normal(random), normal(random), normal(random));
    }
    auto surface = transformed(mesh, transform);
    vtkNew<vtkSolidDensity> solid;
    solid->SetInputData(surface);
    solid->SetResolution(128);
    solid->Update();
    checks.That(std::abs(massOf(solid) / volumeOf(surface) - 1.0) < 1e-5, "volume", __LINE__, name);
    double bounds[6];
    surface->GetBounds(bounds);
    checks.That(countLeaks(solid, bounds) == 0, "no leaks", __LINE__, name);
  }
}

// The numbers of vtkFeatureEdges, once points of equal coordinates are one.
void checkOpen(Checks& checks, const std::string& name)
{
  auto mesh = open(name);
  checks.That(mesh != nullptr, "a mesh", __LINE__, name);
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(mesh);
  clean->ToleranceIsAbsoluteOn();
  clean->SetAbsoluteTolerance(0.0);
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputConnection(clean->GetOutputPort());
  edges->FeatureEdgesOff();
  edges->NonManifoldEdgesOff();
  edges->Update();
  const vtkIdType boundary = edges->GetOutput()->GetNumberOfCells();
  edges->NonManifoldEdgesOn();
  edges->BoundaryEdgesOff();
  edges->Update();
  std::ostringstream text;
  text << "it has " << boundary << " open edges and " << edges->GetOutput()->GetNumberOfCells()
       << " non-manifold edges";
  vtkNew<vtkSolidDensity> solid;
  solid->SetInputData(mesh);
  ErrorTest(checks, solid).Expect(text.str(), __LINE__);
}

// The same surface, its triangles turned at random.
void checkShuffled(Checks& checks)
{
  auto right = open("blobby");
  auto shuffled = open("blobby-shuffled");
  CHECK(checks, right && shuffled);
  CHECK_NEAR(checks, massOf(shuffled, 64), massOf(right, 64), 1e-9 * massOf(right, 64));
}

} // namespace

int TestSolidMeshes(int, char*[])
{
  Checks checks;
  for (const char* name :
    { "armadillo", "bunny00", "elephant", "knot2", "turbine", "beam", "cross" })
  {
    checkVolume(checks, name);
  }
  for (const char* name : { "lion-head", "mannequin-devil", "elephant-with-holes" })
  {
    checkOpen(checks, name);
  }
  checkVolume(checks, "diplodocus"); // two of its edges have four triangles
  checkShuffled(checks);
  return checks.Result();
}
