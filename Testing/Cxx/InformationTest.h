// SPDX-License-Identifier: BSD-3-Clause
// Whether what an algorithm publishes of an image before the data is what the data then is.
#ifndef InformationTest_h
#define InformationTest_h

#include "TestData.h"

#include "vtkInformation.h"
#include "vtkMatrix3x3.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>

inline void checkInformation(Checks& checks, vtkAlgorithm* algorithm, int line)
{
  algorithm->UpdateInformation();
  vtkInformation* information = algorithm->GetOutputInformation(0);
  std::array<int, 6> extent{};
  std::array<double, 3> origin{};
  std::array<double, 3> spacing{};
  std::array<double, 9> direction{};
  information->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent.data());
  information->Get(vtkDataObject::ORIGIN(), origin.data());
  information->Get(vtkDataObject::SPACING(), spacing.data());
  information->Get(vtkDataObject::DIRECTION(), direction.data());
  algorithm->Update();
  auto* output = vtkImageData::SafeDownCast(algorithm->GetOutputDataObject(0));
  const auto same = [&](const auto& published, const auto* values, const char* what) {
    checks.That(std::equal(published.begin(), published.end(), values), what, line);
  };
  checks.That(output->GetNumberOfPoints() > 0, "not empty", line);
  same(extent, output->GetExtent(), "extent");
  same(origin, output->GetOrigin(), "origin");
  same(spacing, output->GetSpacing(), "spacing");
  same(direction, output->GetDirectionMatrix()->GetData(), "direction");
}

#endif
