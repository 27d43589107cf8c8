// SPDX-License-Identifier: BSD-3-Clause
// The positions of a blend's particles in its inputs by maps of least cost: from the first of two
// inputs to the second, or from the barycenter of several inputs to each of them.
#ifndef RectifiedTransport_OptimalBlend_h
#define RectifiedTransport_OptimalBlend_h

#include "Bridge/Settings/OptimalSettings.h"
#include "Core/Geometry/ImageGrid.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace RectifiedTransport
{
class Progress;
class Ranks;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

class InputDensity;

struct OptimalBlendInput
{
  InputDensity* Density;
  std::string Name; // in messages
  double Weight;
  vtkDoubleArray* Positions; // physical, of this rank's particles, by the linearised map
};

struct OptimalBlendResult
{
  // By the inputs. Those of the flow, if that is the Method, and of inputs without weight.
  std::vector<vtkSmartPointer<vtkDoubleArray>> Positions;
  // For each particle what its ways cost more than the bound allows for, halved: the weighted mean
  // over the inputs. In squared physical lengths.
  vtkSmartPointer<vtkDoubleArray> Slack;
  double Bound = 0.0; // of the cost between two inputs, or the weighted mean from the barycenter
  double Cost = 0.0;  // of a barycenter: what it is a bound of
  // With Method Optimal, from the barycenter: the weighted mean of the bounds, for each iteration.
  std::vector<double> Functional;
  std::vector<std::string> Warnings;
};

struct OptimalBlendSettings
{
  OptimalSetting Optimal;
  ImageGrid Geometry; // on which barycenters are found
  bool IsPair;        // else a barycenter
};

// Throws Failure if there is no memory for one of the maps and so many particles, on all ranks.
// These need not have positions.
void requireMemoryForMaps(const std::vector<OptimalBlendInput>& inputs,
  const OptimalBlendSettings& settings, double particles, const Ranks& ranks);

// Collective on the ranks of the progress. Throws Failure and Cancelled.
OptimalBlendResult blendOptimally(const std::vector<OptimalBlendInput>& inputs,
  const OptimalBlendSettings& settings, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
