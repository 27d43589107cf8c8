// SPDX-License-Identifier: BSD-3-Clause
// Memory that runs out while an algorithm answers any request: one error, and no exception in the
// executive.
#include "TestData.h"

#include "vtkCollectiveAlgorithm.h"
#include "vtkImageShiftScale.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <new>

namespace
{

class Exhausted : public vtkCollectiveAlgorithm
{
public:
  static Exhausted* New();
  vtkTypeMacro(Exhausted, vtkCollectiveAlgorithm);
  int Throws = 0; // in which request

protected:
  Exhausted() { this->SetNumberOfOutputPorts(1); }
  int FillOutputPortInformation(int, vtkInformation* info) override
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkImageData");
    return 1;
  }
  int Answer(int request)
  {
    if (request == this->Throws)
    {
      throw std::bad_alloc();
    }
    return 1;
  }
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override
  {
    return this->Answer(1);
  }
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    const int extent[6] = { 0, 3, 0, 3, 0, 0 };
    outputs->GetInformationObject(0)->Set(
      vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    return this->Answer(2);
  }
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override
  {
    return this->Answer(3);
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkImageData* image = vtkImageData::GetData(outputs);
    image->SetExtent(0, 3, 0, 3, 0, 0);
    image->AllocateScalars(VTK_DOUBLE, 1);
    return this->Answer(4);
  }
};
vtkStandardNewMacro(Exhausted);

} // namespace

int TestCollectiveRequests(int, char*[])
{
  Checks checks;
  for (const int request : { 1, 2, 3, 4 })
  {
    vtkNew<Exhausted> source;
    Messages messages(source);
    source->Throws = request;
    vtkNew<vtkImageShiftScale> downstream;
    downstream->SetInputConnection(source->GetOutputPort());
    downstream->Update();
    CHECK(checks, !messages.Errors.empty() && contains(messages.Errors[0], "Not enough memory"));
    // Where the first request failed there is no output.
    vtkImageData* read = downstream->GetOutput();
    CHECK(checks, !read || read->GetNumberOfPoints() == 0);
    source->Throws = 0;
    source->Modified();
    downstream->Update();
    CHECK(checks, downstream->GetOutput()->GetNumberOfPoints() == 16);
  }
  return checks.Result();
}
