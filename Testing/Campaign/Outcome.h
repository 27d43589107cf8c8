// SPDX-License-Identifier: BSD-3-Clause
// What comes of an update, and what is wrong with it.
#ifndef Campaign_Outcome_h
#define Campaign_Outcome_h

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"

#include <cstdint>
#include <string>
#include <vector>

namespace Campaign
{

class Findings
{
public:
  void That(bool holds, const std::string& what)
  {
    if (!holds)
    {
      this->All.push_back(what);
    }
  }
  // To a relative tolerance.
  void Near(double a, double b, double tolerance, const std::string& what);

  std::vector<std::string> All;
};

// What one update may be disturbed by.
struct Disturbance
{
  int AbortAt = -1;         // the number of the progress event that aborts
  std::int64_t Memory = -1; // bytes by which the process may grow
};

struct Outcome
{
  std::vector<std::string> Errors;   // of the filter itself
  std::vector<std::string> Warnings; // of the filter itself
  std::vector<std::string> Others;   // errors of anything else, but for the executive's own line
  bool Aborted = false;
  bool IsEmpty = true; // all outputs
  std::uint64_t Digest = 0;
};

// Updates all outputs of a filter, and records its messages.
Outcome update(vtkAlgorithm* filter, const Disturbance& disturbance, Findings& findings);

// Of geometry, cells, arrays and their values to the last bit.
std::uint64_t digest(vtkDataObject* data, std::uint64_t seed);

// Of the arrays, those of points, cells and axes among them, whatever these say.
std::uint64_t digestOfArrays(vtkDataObject* data, std::uint64_t seed);

bool isEmpty(vtkDataObject* data);

} // namespace Campaign

#endif
