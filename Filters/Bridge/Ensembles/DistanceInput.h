// SPDX-License-Identifier: BSD-3-Clause
// A density as the distances to others need it: its values, read once, and what identifies them.
#ifndef RectifiedTransport_DistanceInput_h
#define RectifiedTransport_DistanceInput_h

#include "Bridge/Density/InputDensity.h"
#include "Bridge/Store/DataIdentity.h"
#include "Core/Geometry/ImageGrid.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <limits>
#include <string>

namespace RectifiedTransport
{
class Progress;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

struct DistanceInput
{
  std::string Title; // in messages
  std::string Name;  // of its column
  double Time = std::numeric_limits<double>::quiet_NaN();
  DensityReading Reading;
  ImageGrid Grid;
  double Mass = 0.0;     // density times cell measure
  DataIdentity Identity; // identifies the values; hashed
  // One value per cell, axis 0 of index space fastest; released when added to the distances.
  vtkSmartPointer<vtkDoubleArray> Values;
};

// Reads a density, on ranks the whole one on each. Collective. Throws Failure, without the title,
// and Cancelled.
DistanceInput readDistanceInput(InputDensity& density, Progress& progress);

} // namespace RectifiedTransport::Bridge

#endif
