// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityFailure.h"

#include "Bridge/Density/DensityReader.h"
#include "Bridge/Run/Failure.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

#include <cmath>
#include <sstream>

namespace RectifiedTransport
{

std::string describeArray(vtkDataArray* array)
{
  return array->GetName() ? std::string("density array '") + array->GetName() + "'"
                          : std::string("density array (which has no name)");
}

void requireTuples(vtkDataArray* array, vtkDataSet* data, bool onPoints, const std::string& what)
{
  const vtkIdType expected = onPoints ? data->GetNumberOfPoints() : data->GetNumberOfCells();
  if (array->GetNumberOfTuples() != expected)
  {
    std::ostringstream message;
    message << "The " << describeArray(array) << " has " << array->GetNumberOfTuples()
            << " tuples, but the " << what << " has " << expected
            << (onPoints ? " points" : " cells") << "; there must be one for each";
    throw Failure(message.str());
  }
}

void requireComponent(const std::string& name, int component, int count)
{
  constexpr int mostColours = 4;
  if (component >= -1 && component < count && (component >= 0 || count <= mostColours))
  {
    return;
  }
  std::ostringstream message;
  message << "Component is " << component << ", but the " << name << " has " << count
          << (count == 1 ? " component" : " components") << "; it must be ";
  if (count <= mostColours)
  {
    message << "-1 (luminance)" << (count == 1 ? " or 0" : " or an index from 0 to ");
  }
  else
  {
    message << "an index from 0 to ";
  }
  if (count > 1)
  {
    message << count - 1;
  }
  throw Failure(message.str());
}

bool needsWhite(const DensityRules& rules, int components)
{
  const bool alpha = rules.Component < 0 && (components == 2 || components == 4);
  return rules.Invert || alpha;
}

void throwInvalidDensity(const std::string& name, const DensitySummary& summary, bool hasBlanks)
{
  std::ostringstream message;
  message << "The " << name << " has ";
  if (summary.NotFinite > 0)
  {
    message << summary.NotFinite << (summary.NotFinite == 1 ? " value that is" : " values that are")
            << " NaN or infinite, the first at index " << summary.FirstNotFinite
            << "; every value must be finite";
  }
  else if (summary.Negative > 0)
  {
    // The remedy first: ParaView's list of messages shows about 90 characters of a line.
    message << summary.Negative << (summary.Negative == 1 ? " negative value" : " negative values")
            << "; NegativeValues = Clamp takes them as 0, for a density must not be negative (the "
               "first at index "
            << summary.FirstNegative << ")";
  }
  else if (std::isinf(summary.Total))
  {
    message << "a total mass past the largest double; its values must be smaller";
  }
  else
  {
    message << "a total mass of zero"
            << (hasBlanks ? " (duplicate and blanked ghosts carry none)" : "")
            << "; at least one value must be positive";
  }
  throw Failure(message.str());
}

} // namespace RectifiedTransport
