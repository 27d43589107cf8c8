// SPDX-License-Identifier: BSD-3-Clause
// What filters ask of their inputs, whatever piece they are asked for themselves: all of it and no
// ghosts, which would be there twice. The warp alone moves a piece of its points at a time.
#include "WarpTest.h"

#include "vtkEqualMassCells.h"
#include "vtkImageAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMassSplatter.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"
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

class AskedImage : public vtkImageAlgorithm
{
public:
  static AskedImage* New();
  vtkTypeMacro(AskedImage, vtkImageAlgorithm);
  Asked Last;

protected:
  AskedImage() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    const int extent[6] = { 0, 8, 0, 6, 0, 0 };
    outputs->GetInformationObject(0)->Set(Pipeline::WHOLE_EXTENT(), extent, 6);
    return 1;
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    this->Last.Read(outputs->GetInformationObject(0));
    vtkImageData::GetData(outputs)->ShallowCopy(makeImage(9, 7, 1, true, bumpy));
    return 1;
  }
};
vtkStandardNewMacro(AskedImage);

class AskedPoints : public vtkPolyDataAlgorithm
{
public:
  static AskedPoints* New();
  vtkTypeMacro(AskedPoints, vtkPolyDataAlgorithm);
  Asked Last;

protected:
  AskedPoints() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    outputs->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    return 1;
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    this->Last.Read(outputs->GetInformationObject(0));
    vtkPolyData::GetData(outputs)->ShallowCopy(makePoints({ 3, 2, 0, 4, 5, 0, 6, 1, 0 }));
    return 1;
  }
};
vtkStandardNewMacro(AskedPoints);

void expectWhole(Checks& checks, const Asked& asked, const char* name)
{
  checks.That(asked.Piece == 0 && asked.Pieces == 1, "one piece", __LINE__, name);
  checks.That(asked.Ghosts == 0, "no ghosts", __LINE__, name);
}

// Both ports of a filter, of either of which there may be none.
void checkFilter(Checks& checks, vtkAlgorithm* filter, bool pointsFirst, bool imageSecond)
{
  vtkNew<AskedImage> image;
  vtkNew<AskedPoints> points;
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
    expectWhole(checks, image->Last, name);
    const std::array<int, 6> whole{ 0, 8, 0, 6, 0, 0 };
    checks.That(image->Last.Extent == whole, "the whole extent", __LINE__, name);
  }
  if (pointsFirst && filter->IsA("vtkDensityEqualizingWarp"))
  {
    const Asked& asked = points->Last;
    checks.That(asked.Piece == 0 && asked.Pieces == 3 && asked.Ghosts == 2, "a piece", __LINE__);
  }
  else if (pointsFirst || (second && !imageSecond))
  {
    expectWhole(checks, points->Last, name);
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
  return checks.Result();
}
