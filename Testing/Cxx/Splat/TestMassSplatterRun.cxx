// SPDX-License-Identifier: BSD-3-Clause
// Splat Mass in a pipeline: what is published, threads, progress, abort, and the way back from
// particles to the density that they came from.
#include "SplatTest.h"

#include "BlocksTest.h"
#include "ProgressTest.h"
#include "ThreadsTest.h"

#include "vtkElevationFilter.h"
#include "vtkImageDataToPointSet.h"
#include "vtkImageShiftScale.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataGroupFilter.h"
#include "vtkSphereSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTransportSampler.h"
#include "vtkTrivialProducer.h"

#include <initializer_list>

namespace
{

const double cube[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };

std::array<int, 6> published(vtkMassSplatter* splatter)
{
  splatter->UpdateInformation();
  std::array<int, 6> extent{ 0, -1, 0, -1, 0, -1 };
  splatter->GetOutputInformation(0)->Get(
    vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent.data());
  return extent;
}

void checkInformation(Checks& checks)
{
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(makePoints(randomCoordinates(cube, 10)));
  splatter->SetDimensions(5, 6, 7);
  splatter->Update();
  CHECK(checks, (published(splatter) == std::array<int, 6>{ 0, 4, 0, 5, 0, 6 }));
  splatter->SetAssociationToCells();
  CHECK(checks, (published(splatter) == std::array<int, 6>{ 0, 5, 0, 6, 0, 7 }));
  vtkNew<vtkTrivialProducer> producer;
  vtkNew<vtkImageData> reference;
  reference->SetExtent(2, 4, 0, 0, 7, 9);
  producer->SetOutput(reference);
  splatter->SetReferenceConnection(producer->GetOutputPort());
  CHECK(checks, (published(splatter) == std::array<int, 6>{ 2, 4, 0, 0, 7, 9 }));
  expectOnePiece(checks, splatter, __LINE__);
  CHECK(checks, splatter->GetOutput()->GetNumberOfCells() == 4);
}

// Image filters downstream see its own array, not those of the image that its points come from.
void checkAnnouncedArray(Checks& checks)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(4, 4, 4);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 2);
  std::fill_n(static_cast<unsigned char*>(image->GetScalarPointer()), 128, 1);
  vtkNew<vtkImageDataToPointSet> points;
  points->SetInputData(image);
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputConnection(points->GetOutputPort());
  splatter->SetDimensions(3, 3, 3);
  vtkNew<vtkImageShiftScale> twice;
  twice->SetInputConnection(splatter->GetOutputPort());
  twice->SetScale(2.0);
  twice->Update();
  vtkDataArray* doubled = twice->GetOutput()->GetPointData()->GetScalars();
  const std::vector<double> values = splatValues(splatter);
  CHECK(checks, doubled && doubled->GetDataType() == VTK_DOUBLE);
  CHECK(checks, doubled && doubled->GetNumberOfComponents() == 1 && values.size() == 27);
  CHECK(checks, doubled && doubled->GetTuple1(13) == 2.0 * values.at(13));
}

// A block at a time, also where what makes the blocks runs again.
void checkProducedBlocks(Checks& checks)
{
  vtkNew<vtkSphereSource> spheres[2];
  vtkNew<vtkMultiBlockDataGroupFilter> group;
  for (int i = 0; i < 2; ++i)
  {
    spheres[i]->SetCenter(10.0 * i, 0.0, 0.0);
    group->AddInputConnection(spheres[i]->GetOutputPort());
  }
  vtkNew<vtkElevationFilter> elevation; // a block at a time, too
  elevation->SetInputConnection(group->GetOutputPort());
  for (vtkAlgorithm* producer : std::initializer_list<vtkAlgorithm*>{ group, elevation })
  {
    vtkNew<vtkMassSplatter> splatter;
    Messages messages(splatter);
    splatter->SetInputConnection(producer->GetOutputPort());
    splatter->SetDimensions(4, 4, 4);
    for (const double radius : { 1.0, 2.0 })
    {
      spheres[1]->SetRadius(radius);
      splatter->Update();
      auto* blocks = vtkMultiBlockDataSet::SafeDownCast(splatter->GetOutputDataObject(0));
      CHECK(checks, blocks && blocks->GetNumberOfBlocks() == 2);
      auto* image = outputBlock<vtkImageData>(splatter, 1);
      CHECK(checks, image && image->GetNumberOfPoints() == 64);
      CHECK_NEAR(checks, image ? image->GetCenter()[0] : 0.0, 10.0, 0.1);
      CHECK_NEAR(checks, image ? image->GetSpacing()[2] : 0.0, 0.5 * radius, 1e-6);
    }
    CHECK(checks, messages.Errors.empty());
  }
}

void checkThreads(Checks& checks)
{
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(makePoints(randomCoordinates(cube, 60000), true));
  splatter->SetDimensions(50, 40, 30);
  for (int kernel = 0; kernel < 4; ++kernel)
  {
    splatter->SetKernel(kernel);
    const auto run = [&](int threading) {
      splatter->SetThreading(threading);
      splatter->Modified();
      return splatValues(splatter);
    };
    CHECK(checks, expectSameBits(checks, run, __LINE__).size() == 60000);
  }
}

// A lattice of the cells' own centres, splatted, is the density.
void checkLattice(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  vtkSmartPointer<vtkImageData> image = makeImage(9, 7, 6, true, [](vtkIdType) { return 3.0; });
  sampler->SetInputData(image);
  sampler->SetSeedPatternToLattice();
  sampler->SetSamplesPerCell(1);
  sampler->SetFlowTime(0.0);
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputConnection(sampler->GetOutputPort());
  splatter->SetReferenceData(image);
  splatter->SetAssociationToCells();
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "Mass");
  for (const double value : splatValues(splatter))
  {
    CHECK_NEAR(checks, value, 3.0, 1e-9);
  }
  const double sampled = sampler->GetOutput()->GetFieldData()->GetArray("TotalMass")->GetTuple1(0);
  CHECK_NEAR(checks, totalMass(splatter), sampled, 1e-12 * sampled);
}

void checkProgressAndAbort(Checks& checks)
{
  vtkNew<vtkMassSplatter> splatter;
  splatter->SetInputData(makePoints(randomCoordinates(cube, 300000)));
  splatter->SetDimensions(64, 64, 64);
  splatter->SetKernelToGaussian();
  splatter->SetRadius(2.0);
  {
    ProgressTest test(splatter);
    splatter->Update();
    test.ExpectRising(checks, 6, __LINE__);
  }
  for (const double from : { 0.0, 0.15, 0.21, 0.3, 0.8 })
  {
    checkAbort(
      checks, splatter, from, [&]() { splatter->Modified(); }, __LINE__);
  }
  splatter->SetKernelToNearestCell();
  splatter->Modified();
  CHECK_NEAR(checks, sumOf(splatValues(splatter)) / (64.0 * 64.0 * 64.0), 300000.0, 600.0);
}

} // namespace

int TestMassSplatterRun(int, char*[])
{
  return runChecks({ checkInformation, checkAnnouncedArray, checkProducedBlocks, checkThreads,
    checkLattice, checkProgressAndAbort });
}
