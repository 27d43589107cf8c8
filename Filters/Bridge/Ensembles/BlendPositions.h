// SPDX-License-Identifier: BSD-3-Clause
// Where the particles of a blend are in its inputs.
#ifndef RectifiedTransport_BlendPositions_h
#define RectifiedTransport_BlendPositions_h

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace RectifiedTransport
{
class ImageGrid;
class Progress;
class Ranks;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct BlendInput;
struct BlendSettings;

struct BlendPositions
{
  // By the inputs. Those of the flow, if that is the Method, and of inputs without weight.
  std::vector<vtkSmartPointer<vtkDoubleArray>> Positions;
  // With Method Optimal or Certify, see OptimalPositions.
  vtkSmartPointer<vtkDoubleArray> Slack;
  double Bound = 0.0;
  double Cost = 0.0; // between two inputs that of the particles
  std::vector<double> Functional;
  // Between two inputs y - x of the particles' positions x and y in them.
  vtkSmartPointer<vtkDoubleArray> Displacements;
};

// Throws Failure if there is no memory for one of the optimal maps and so many particles, on all
// ranks.
void requireMemoryForMaps(const std::vector<BlendInput>& inputs, const BlendSettings& settings,
  const ImageGrid& geometry, double particles, const Ranks& ranks);

// `given`: where the flow moves this rank's particles. All ranks together have `particles`. Adds
// warnings. Collective. Throws Failure and Cancelled.
std::shared_ptr<const BlendPositions> makePositions(const std::vector<BlendInput>& inputs,
  const std::vector<vtkSmartPointer<vtkDoubleArray>>& given, const BlendSettings& settings,
  const ImageGrid& geometry, std::int64_t particles, Progress& progress,
  std::vector<std::string>& warnings);

} // namespace RectifiedTransport::Bridge

#endif
