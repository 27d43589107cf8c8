// SPDX-License-Identifier: BSD-3-Clause
// What is wrong is reported once, whichever request finds it first.
#include "BlendTest.h"
#include "CellsTest.h"

#include "vtkBlueNoiseRelaxation.h"
#include "vtkMassSplatter.h"
#include "vtkTable.h"
#include "vtkTransportMap.h"
#include "vtkTransportQuality.h"

namespace
{

// An array of something that an image has not.
void checkAssociations(Checks& checks, vtkAlgorithm* filter, int index, int port, int line)
{
  for (const int association : { -5, -1, 2, 4, 5, 6, 7, 8, 1000 })
  {
    filter->SetInputArrayToProcess(index, port, 0, association, "Density");
    Messages messages(filter);
    filter->UpdateInformation();
    filter->Update();
    std::string all;
    for (const std::string& error : messages.Errors)
    {
      all += error + " | ";
    }
    checks.That(messages.Errors.size() == 1 && contains(all, "association of the ") &&
        contains(all, " array is " + std::to_string(association) + "; it must be"),
      "one error", line, std::to_string(association) + ": " + all);
  }
  filter->SetInputArrayToProcess(index, port, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
}

} // namespace

int TestOneError(int, char*[])
{
  Checks checks;
  auto image = makeImage(6, 5, 1, true, bumpy);
  auto points = makePoints({ 1, 1, 0, 2, 3, 0 });
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  checkAssociations(checks, sampler, 0, 0, __LINE__);
  vtkNew<vtkTransportMap> map;
  map->SetInputData(image);
  checkAssociations(checks, map, 0, 0, __LINE__);
  vtkNew<vtkDensityEqualizingWarp> warp;
  warp->SetInputData(points);
  warp->SetDensityData(image);
  checkAssociations(checks, warp, 0, 1, __LINE__);
  vtkNew<vtkTransportQuality> quality;
  quality->SetInputData(points);
  quality->SetDensityData(image);
  checkAssociations(checks, quality, 0, 1, __LINE__);
  vtkNew<vtkBlueNoiseRelaxation> relaxation;
  relaxation->SetInputData(points);
  relaxation->SetDensityData(image);
  checkAssociations(checks, relaxation, 0, 1, __LINE__);
  auto morph = makeMorph(image, image);
  checkAssociations(checks, morph, 0, 0, __LINE__);
  checkAssociations(checks, morph, 1, 1, __LINE__);
  checkAssociations(checks, makeBarycenter({ image, image }), 0, 0, __LINE__);
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(points);
  checkAssociations(checks, splatter, 0, 0, __LINE__);
  return checks.Result();
}
