// SPDX-License-Identifier: BSD-3-Clause
// Filters of the register (../../Campaign/FilterKind.h) for the tests that concern every one of
// them.
#ifndef KindTest_h
#define KindTest_h

#include "../../Campaign/FilterKind.h"
#include "TestData.h"

#include "vtkCollectiveAlgorithm.h"
#include "vtkInformation.h"

// What a port of a filter takes: points, a surface or, else, a density or the geometry of an image.
enum class PortKind
{
  Points,
  Surface,
  Image,
};

inline PortKind portKind(vtkAlgorithm* filter, int port)
{
  vtkInformation* information = filter->GetInputPortInformation(port);
  const char* type = information->Get(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), 0);
  return type == std::string("vtkPointSet") ? PortKind::Points
    : type == std::string("vtkPolyData")    ? PortKind::Surface
                                            : PortKind::Image;
}

inline bool isNeeded(vtkAlgorithm* filter, int port)
{
  auto* own = vtkCollectiveAlgorithm::SafeDownCast(filter);
  return own && own->NeedsInput(port);
}

inline bool isRepeatable(vtkAlgorithm* filter, int port)
{
  return filter->GetInputPortInformation(port)->Has(vtkAlgorithm::INPUT_IS_REPEATABLE());
}

// Gives a filter what it needs, twice where that may be several.
inline void connectNeeded(vtkAlgorithm* filter, vtkDataObject* image, vtkDataObject* points,
  vtkDataObject* surface = nullptr)
{
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    const PortKind takes = portKind(filter, port);
    vtkDataObject* input = takes == PortKind::Points ? points
      : takes == PortKind::Surface                   ? surface
                                                     : image;
    if (isNeeded(filter, port) && input)
    {
      filter->SetInputDataObject(port, input);
      if (isRepeatable(filter, port))
      {
        filter->AddInputDataObject(port, input);
      }
    }
  }
}

#endif
