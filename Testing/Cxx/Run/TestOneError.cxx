// SPDX-License-Identifier: BSD-3-Clause
// What is wrong is reported once, whichever request finds it first.
#include "KindTest.h"

namespace
{

// An array of something that an image has not.
void checkAssociations(Checks& checks, vtkAlgorithm* filter, int index, int port, int line)
{
  for (const int association : { -5, -1, 2, 4, 5, 6, 7, 8, 1000 })
  {
    filter->SetInputArrayToProcess(index, port, 0, association, "Density");
    Messages messages(filter);
    filter->UpdateInformation();
    filter->Update();
    std::string all;
    for (const std::string& error : messages.Errors)
    {
      all += error + " | ";
    }
    checks.That(messages.Errors.size() == 1 && contains(all, "association of the ") &&
        contains(all, " array is " + std::to_string(association) + "; it must be"),
      "one error", line, std::to_string(association) + ": " + all);
  }
  filter->SetInputArrayToProcess(index, port, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Density");
}

} // namespace

int TestOneError(int, char*[])
{
  Checks checks;
  auto image = makeImage(6, 5, 1, true, bumpy);
  auto points = makePoints({ 1, 1, 0, 2, 3, 0 });
  int checked = 0;
  for (const Campaign::FilterKind& kind : Campaign::filterKinds())
  {
    const auto filter = kind.New();
    int arrays = 0;
    connectNeeded(filter, image, points);
    for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
    {
      // A density or, of the filters that read none, masses.
      const bool isRead = portKind(filter, port) == PortKind::Image ||
        (portKind(filter, port) == PortKind::Points && !vtkDensityAlgorithm::SafeDownCast(filter));
      if (isRead && isNeeded(filter, port))
      {
        checkAssociations(checks, filter, arrays++, port, __LINE__);
        ++checked;
      }
    }
  }
  CHECK(checks, checked >= 9);
  return checks.Result();
}
