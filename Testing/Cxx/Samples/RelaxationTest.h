// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkBlueNoiseRelaxation share.
#ifndef RelaxationTest_h
#define RelaxationTest_h

#include "WarpTest.h"

#include "vtkBlueNoiseRelaxation.h"

#include <algorithm>
#include <functional>
#include <initializer_list>

// Of few iterations.
inline vtkSmartPointer<vtkBlueNoiseRelaxation> makeRelaxation(
  int method, vtkDataObject* points, vtkImageData* density)
{
  auto relaxation = vtkSmartPointer<vtkBlueNoiseRelaxation>::New();
  relaxation->SetMethod(method);
  relaxation->SetMaximumIterations(3);
  relaxation->SetInputData(points);
  relaxation->SetDensityData(density);
  return relaxation;
}

inline Values relaxedCoordinates(vtkBlueNoiseRelaxation* relaxation)
{
  relaxation->Update();
  return coordinates(relaxation->GetOutput());
}

inline Values energies(vtkBlueNoiseRelaxation* relaxation)
{
  return arrayValues(relaxation->GetOutput()->GetFieldData()->GetArray("Energy"));
}

// As many values as there may be, finite and never rising.
inline void expectEnergy(Checks& checks, vtkBlueNoiseRelaxation* relaxation, int line)
{
  const Values all = energies(relaxation);
  std::ostringstream detail;
  for (const double value : all)
  {
    detail << value << " ";
  }
  const auto most = static_cast<std::size_t>(relaxation->GetMaximumIterations()) + 1;
  checks.That(!all.empty() && all.size() <= most, "number of energies", line, detail.str());
  checks.That(
    std::all_of(all.begin(), all.end(), [](double value) { return std::isfinite(value); }),
    "finite energies", line, detail.str());
  checks.That(std::is_sorted(all.begin(), all.end(), std::greater<>()), "falling energies", line,
    detail.str());
}

#endif
