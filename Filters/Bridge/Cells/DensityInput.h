// SPDX-License-Identifier: BSD-3-Clause
// Reads the density of a filter's input: an image, a distributed image, or any other data.
#ifndef RectifiedTransport_DensityInput_h
#define RectifiedTransport_DensityInput_h

#include "Bridge/Blocks/GatheredInputs.h"
#include "Bridge/Cells/ResampledDensity.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/VTKCompatibility.h"

#include <functional>
#include <memory>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkDataObject;
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// How a filter reads a density: its properties and the choice of the array.
struct DensityChoice
{
  DensityRules Rules;
  int Resolution;        // cells along the longest axis, for data that are not images
  int Association;       // as the filter's choice of the array has it
  std::string ArrayName; // empty for the default array
  // The array of a data set; sets its association. nullptr for none.
  std::function<vtkAbstractArray*(vtkDataSet*, int& association)> FindArray;
  // Receives warnings about the data and about values that are probably not meant.
  std::function<void(const std::string&)> Warn;
};

// Whether a data object, which may be nullptr, is polygons that lie in no plane.
bool isAroundSolid(vtkDataObject* input);

// Keeps what the last run made of the data. It is made again only if the data or the choice change.
class DensityInput
{
public:
  // nullptr if the data have no points. Collective. The density is valid until the next Read.
  // Throws Failure and Cancelled.
  std::unique_ptr<InputDensity> Read(
    const DensityChoice& choice, vtkDataObject* input, Progress& progress);

private:
  std::unique_ptr<InputDensity> ReadBlocks(
    const DensityChoice& choice, vtkDataObject* input, Progress& progress);

  ResampledDensity Resampled;
  GatheredBlocks Gathered;
  DataIdentity Warned; // the data whose suspect values were reported
};

} // namespace RectifiedTransport::Bridge

#endif
