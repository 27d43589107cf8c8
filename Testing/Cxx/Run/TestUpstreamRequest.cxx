// SPDX-License-Identifier: BSD-3-Clause
// What filters ask of their inputs, whatever piece they are asked for themselves: all of it and no
// ghosts, which would be there twice. The warp alone moves a piece of its points at a time. Of the
// register, all filters of images and points.
#include "KindTest.h"
#include "TestSource.h"

#include "vtkStreamingDemandDrivenPipeline.h"

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

// All ports of a filter.
void checkFilter(Checks& checks, const Campaign::FilterKind& kind)
{
  const auto filter = kind.New();
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
  bool hasImage = false;
  bool hasPoints = false;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    const bool takesPoints = portKind(filter, port) == PortKind::Points;
    filter->SetInputConnection(
      port, (takesPoints ? static_cast<vtkAlgorithm*>(points) : image)->GetOutputPort());
    if (filter->GetInputPortInformation(port)->Has(vtkAlgorithm::INPUT_IS_REPEATABLE()))
    {
      filter->AddInputConnection(port, image->GetOutputPort()); // distances need two
    }
    hasPoints = hasPoints || takesPoints;
    hasImage = hasImage || !takesPoints;
  }
  Messages messages(filter);
  filter->UpdatePiece(0, 3, 2);
  const char* name = filter->GetClassName();
  checks.That(messages.Errors.empty(), "no error", __LINE__, name);
  if (hasImage)
  {
    expectWhole(checks, ofImage, name);
    checks.That(ofImage.Extent == whole, "the whole extent", __LINE__, name);
  }
  if (hasPoints && filter->IsA("vtkDensityEqualizingWarp"))
  {
    checks.That(
      ofPoints.Piece == 0 && ofPoints.Pieces == 3 && ofPoints.Ghosts == 2, "a piece", __LINE__);
  }
  else if (hasPoints)
  {
    expectWhole(checks, ofPoints, name);
  }
}

} // namespace

int TestUpstreamRequest(int, char*[])
{
  Checks checks;
  int filters = 0;
  for (const Campaign::FilterKind& kind : Campaign::filterKinds())
  {
    const auto filter = kind.New();
    const int ports = filter->GetNumberOfInputPorts();
    if (ports > 0 && portKind(filter, 0) != PortKind::Surface)
    {
      checkFilter(checks, kind);
      ++filters;
    }
  }
  CHECK(checks, filters >= 9);
  return checks.Result();
}
