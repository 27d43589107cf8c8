// SPDX-License-Identifier: BSD-3-Clause
// Sources of what a test gives them.
#ifndef TestSource_h
#define TestSource_h

#include "vtkDataObject.h"
#include "vtkImageAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"

#include <functional>

template <class Algorithm>
class TestSource : public Algorithm
{
public:
  static TestSource* New() { VTK_STANDARD_NEW_BODY(TestSource); }

  // What is published before the data, and the data, by the output's information.
  std::function<void(vtkInformation*)> Publish;
  std::function<vtkSmartPointer<vtkDataObject>(vtkInformation*)> Make;

protected:
  TestSource() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    this->Publish(outputs->GetInformationObject(0));
    return 1;
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* output = outputs->GetInformationObject(0);
    vtkDataObject::GetData(output)->ShallowCopy(this->Make(output));
    return 1;
  }
};

using ImageSource = TestSource<vtkImageAlgorithm>;
using PointSource = TestSource<vtkPolyDataAlgorithm>;

#endif
