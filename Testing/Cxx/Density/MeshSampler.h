// SPDX-License-Identifier: BSD-3-Clause
// The mass of a density that is no image, as Sample Density finds it.
#ifndef MeshSampler_h
#define MeshSampler_h

#include "TestData.h"

#include "vtkSmartPointer.h"
#include "vtkTransportSampler.h"

inline vtkSmartPointer<vtkTransportSampler> makeSampler(vtkDataObject* data)
{
  auto sampler = vtkSmartPointer<vtkTransportSampler>::New();
  sampler->SetInputDataObject(data);
  sampler->SetNumberOfParticles(100);
  sampler->SetDensityResolution(20);
  return sampler;
}

inline double massOf(vtkTransportSampler* sampler)
{
  sampler->Update();
  return fieldValue(sampler->GetOutput(), "TotalMass");
}

#endif
