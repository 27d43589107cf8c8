// SPDX-License-Identifier: BSD-3-Clause
// What filters ask of their inputs, whatever piece they are asked for themselves: all of it and no
// ghosts, which would be there twice. The warp alone moves a piece of its points at a time.
#include "TestSource.h"
#include "WarpTest.h"

#include "vtkBlueNoiseRelaxation.h"
#include "vtkEqualMassCells.h"
#include "vtkMassSplatter.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTransportBarycenter.h"
#include "vtkTransportInterpolator.h"
#include "vtkTransportMap.h"
#include "vtkTransportQuality.h"

#include <array>

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

// What the last run was asked for.
struct Asked
{
  int Piece = -1;
  int Pieces = -1;
  int Ghosts = -1;
  std::array<int, 6> Extent{};

  void Read(vtkInformation* output)
  {
    this->Piece = output->Get(Pipeline::UPDATE_PIECE_NUMBER());
    this->Pieces = output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
    this->Ghosts = output->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS());
    if (output->Has(Pipeline::UPDATE_EXTENT()))
    {
      output->Get(Pipeline::UPDATE_EXTENT(), this->Extent.data());
    }
  }
};

void expectWhole(Checks& checks, const Asked& asked, const char* name)
{
  checks.That(asked.Piece == 0 && asked.Pieces == 1, "one piece", __LINE__, name);
  checks.That(asked.Ghosts == 0, "no ghosts", __LINE__, name);
}

// Both ports of a filter, of either of which there may be none.
void checkFilter(Checks& checks, vtkAlgorithm* filter, bool pointsFirst, bool imageSecond)
{
  const std::array<int, 6> whole{ 0, 8, 0, 6, 0, 0 };
  Asked ofImage;
  vtkNew<ImageSource> image;
  image->Publish = [&](vtkInformation* output) {
    output->Set(Pipeline::WHOLE_EXTENT(), whole.data(), 6);
  };
  image->Make = [&](vtkInformation* output) {
    ofImage.Read(output);
    return makeImage(9, 7, 1, true, bumpy);
  };
  Asked ofPoints;
  vtkNew<PointSource> points;
  points->Publish = [](vtkInformation* output) {
    output->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  };
  points->Make = [&](vtkInformation* output) {
    ofPoints.Read(output);
    return makePoints({ 3, 2, 0, 4, 5, 0, 6, 1, 0 });
  };
  vtkAlgorithm* first = pointsFirst ? static_cast<vtkAlgorithm*>(points) : image;
  filter->SetInputConnection(0, first->GetOutputPort());
  const bool second = filter->GetNumberOfInputPorts() > 1;
  if (second)
  {
    vtkAlgorithm* other = imageSecond ? static_cast<vtkAlgorithm*>(image) : points;
    filter->SetInputConnection(1, other->GetOutputPort());
  }
  Messages messages(filter);
  filter->UpdatePiece(0, 3, 2);
  const char* name = filter->GetClassName();
  checks.That(messages.Errors.empty(), "no error", __LINE__, name);
  if (!pointsFirst || (second && imageSecond))
  {
    expectWhole(checks, ofImage, name);
    checks.That(ofImage.Extent == whole, "the whole extent", __LINE__, name);
  }
  if (pointsFirst && filter->IsA("vtkDensityEqualizingWarp"))
  {
    checks.That(
      ofPoints.Piece == 0 && ofPoints.Pieces == 3 && ofPoints.Ghosts == 2, "a piece", __LINE__);
  }
  else if (pointsFirst || (second && !imageSecond))
  {
    expectWhole(checks, ofPoints, name);
  }
}

} // namespace

int TestUpstreamRequest(int, char*[])
{
  Checks checks;
  checkFilter(checks, vtkNew<vtkTransportSampler>(), false, false);
  checkFilter(checks, vtkNew<vtkTransportMap>(), false, false);
  checkFilter(checks, vtkNew<vtkEqualMassCells>(), true, true);
  checkFilter(checks, vtkNew<vtkTransportInterpolator>(), false, true);
  checkFilter(checks, vtkNew<vtkTransportBarycenter>(), false, false);
  checkFilter(checks, vtkNew<vtkMassSplatter>(), true, true);
  checkFilter(checks, vtkNew<vtkDensityEqualizingWarp>(), true, true);
  checkFilter(checks, vtkNew<vtkTransportQuality>(), true, true);
  checkFilter(checks, vtkNew<vtkBlueNoiseRelaxation>(), true, true);
  return checks.Result();
}
