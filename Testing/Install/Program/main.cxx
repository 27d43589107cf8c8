// SPDX-License-Identifier: BSD-3-Clause
// A program that links the module as the README shows it, and nothing else.
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUniformSeedSource.h>

int main()
{
  vtkNew<vtkUniformSeedSource> seeds;
  seeds->SetNumberOfPoints(100);
  seeds->Update();
  return seeds->GetOutput()->GetNumberOfPoints() == 100 ? 0 : 1;
}
