// SPDX-License-Identifier: BSD-3-Clause
// What the sampler requests of its inputs, publishes and keeps in a pipeline.
#include "BlocksTest.h"
#include "TestData.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointDataToCellData.h"
#include "vtkRTAnalyticSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTrivialProducer.h"
#include "vtkUniformSeedSource.h"

namespace
{

// Whole images and all seeds, whichever piece is wanted downstream; the particles are in one piece.
void checkPieces(Checks& checks)
{
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(-9, 12, -3, 4, 5, 11);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputConnection(source->GetOutputPort());
  sampler->SetNumberOfParticles(600);
  sampler->SetNegativeValuesToClamp();
  sampler->Update();
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 600);
  const double mass = fieldValue(sampler->GetOutput(), "TotalMass");
  sampler->UpdatePiece(0, 2, 1);
  int extent[6];
  vtkImageData::SafeDownCast(source->GetOutputDataObject(0))->GetExtent(extent);
  CHECK(checks, extent[0] == -9 && extent[1] == 12 && extent[4] == 5 && extent[5] == 11);
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 600);
  CHECK(checks, fieldValue(sampler->GetOutput(), "TotalMass") == mass);
  sampler->UpdatePiece(1, 2, 0);
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 0);
}

// A change upstream arrives; a filter between points and cells does not matter.
void checkUpstream(Checks& checks)
{
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(0, 10, 0, 10, 0, 0);
  vtkNew<vtkPointDataToCellData> toCells;
  toCells->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputConnection(toCells->GetOutputPort());
  sampler->SetNegativeValuesToClamp();
  const std::vector<double> first = sampleCoordinates(sampler);
  const vtkMTimeType built = sampler->GetTableBuildTime();
  source->SetMaximum(1000.0);
  CHECK(checks, sampleCoordinates(sampler) != first);
  CHECK(checks, sampler->GetTableBuildTime() > built);
}

// The images of a composite input are one density.
void checkComposite(Checks& checks)
{
  for (const bool cells : { true, false })
  {
    auto image = makeImage(9, 7, 6, cells, bumpy);
    vtkNew<vtkTransportSampler> sampler;
    sampler->SetNumberOfParticles(60);
    sampler->SetInputData(image);
    const std::vector<double> expected = sampleCoordinates(sampler);
    sampler->SetInputDataObject(makeTiles(image, 4));
    CHECK(checks, expected.size() == 180 && sampleCoordinates(sampler) == expected);
  }
}

// A required input that is missing is the executive's error, an optional one is none.
void checkPorts(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  CHECK(checks, sampler->GetNumberOfInputPorts() == 2);
  CHECK(checks, sampler->GetNumberOfOutputPorts() == 1);
  sampler->Update();
  CHECK(checks, !sampler->GetOutput() || sampler->GetOutput()->GetNumberOfPoints() == 0);
  sampler->SetInputData(makeImage(5, 5, 1, true, bumpy));
  sampler->Update();
  CHECK(checks, messages.Errors.empty());
  CHECK(checks, sampler->GetOutput()->GetNumberOfPoints() == 8192);
}

} // namespace

int TestSamplerPipeline(int, char*[])
{
  return runChecks({ checkPieces, checkUpstream, checkComposite, checkPorts });
}
