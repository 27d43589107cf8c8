// SPDX-License-Identifier: BSD-3-Clause
// Reads the density of an input of a filter: an image, an image that lies on several ranks, or any
// other data.
#ifndef RectifiedTransport_DensityInput_h
#define RectifiedTransport_DensityInput_h

#include "Bridge/Blocks/DensityBlocks.h"
#include "Bridge/Blocks/GatheredInputs.h"
#include "Bridge/Density/InputDensity.h"
#include "Bridge/Resampling/ResampledDensity.h"
#include "Bridge/VTKCompatibility.h"

#include <functional>
#include <memory>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkAbstractArray;
class vtkDataObject;
class vtkDataSet;
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{

// How a filter reads a density: its properties, and which array is the density.
struct DensityChoice
{
  DensityRules Rules;
  int Resolution;        // of data that are no images
  int Association;       // as the filter's choice of the array has it
  std::string ArrayName; // empty for the default array
  // The array of a data set; sets its association. nullptr for none.
  std::function<vtkAbstractArray*(vtkDataSet*, int& association)> FindArray;
  // What is told of the data, and of values that are probably not meant.
  std::function<void(const std::string&)> Warn;
  std::function<void(const std::string&)> WarnOfValues;
};

// Whether a density may be of such a field association.
bool isDensityAssociation(int association);

// Keeps what the last run made of the data: it is made again only if they or the choice change.
class DensityInput
{
public:
  // nullptr if the data have no points. Collective. The density is to be used before the next Read,
  // while the choice lives. Throws Failure and Cancelled.
  std::unique_ptr<InputDensity> Read(
    const DensityChoice& choice, vtkDataObject* input, Progress& progress);

private:
  std::unique_ptr<InputDensity> ReadAny(
    const DensityChoice& choice, vtkDataObject* input, Progress& progress);
  std::unique_ptr<InputDensity> ReadBlocks(
    const DensityChoice& choice, vtkDataObject* input, Progress& progress);
  void Tell(const DensityChoice& choice, const std::vector<std::string>& lines,
    const InputDensity::Content& content);

  ResampledDensity Resampled;
  GatheredBlocks Gathered;
  InputDensity::Content Told{}; // of whose unusual values a warning told
};

} // namespace RectifiedTransport

#endif
