// SPDX-License-Identifier: BSD-3-Clause
// The list of weights of vtkTransportBarycenter: it grows with what is set, and outside of it there
// is nothing to read, and nothing to write below it.
#include "BlendTest.h"

namespace
{

void checkList(Checks& checks)
{
  vtkNew<vtkTransportBarycenter> barycenter;
  setSimplest(barycenter);
  CHECK(checks, barycenter->GetNumberOfWeights() == 0 && barycenter->GetWeight(0) == 0.0);
  barycenter->SetWeight(2, 5.0);
  barycenter->SetWeight(0, 3.0);
  CHECK(checks, barycenter->GetNumberOfWeights() == 3);
  const double expected[] = { 3.0, 0.0, 5.0 };
  for (int i = 0; i < 3; ++i)
  {
    CHECK(checks, barycenter->GetWeight(i) == expected[i]);
  }
  CHECK(checks, barycenter->GetWeight(3) == 0.0 && barycenter->GetWeight(-1) == 0.0);

  // What is set again is no change.
  const vtkMTimeType before = barycenter->GetMTime();
  barycenter->SetWeight(2, 5.0);
  barycenter->SetNumberOfWeights(3);
  CHECK(checks, barycenter->GetMTime() == before);
  barycenter->SetWeight(2, 4.0);
  CHECK(checks, barycenter->GetMTime() > before);

  // Shorter, and longer again.
  barycenter->SetNumberOfWeights(1);
  CHECK(checks, barycenter->GetNumberOfWeights() == 1 && barycenter->GetWeight(0) == 3.0);
  barycenter->SetNumberOfWeights(3);
  CHECK(checks, barycenter->GetWeight(2) == 0.0);
}

void checkBelow(Checks& checks)
{
  vtkNew<vtkTransportBarycenter> barycenter;
  setSimplest(barycenter);
  barycenter->SetWeight(0, 3.0);
  Messages messages(barycenter);
  barycenter->SetWeight(-1, 2.0);
  CHECK(checks, messages.IsOneError("-1"));
  barycenter->SetNumberOfWeights(-1);
  CHECK(checks, messages.Errors.size() == 2);
  CHECK(checks, barycenter->GetNumberOfWeights() == 1 && barycenter->GetWeight(0) == 3.0);
}

} // namespace

int TestBarycenterWeights(int, char*[])
{
  return runChecks({ checkList, checkBelow });
}
