// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityFailure.h"

#include "Bridge/Density/DensityReader.h"
#include "Bridge/Run/Failure.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

#include <cmath>

namespace RectifiedTransport::Bridge
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
    fail("The ", describeArray(array), " has ", array->GetNumberOfTuples(), " tuples, but the ",
      what, " has ", expected, onPoints ? " points" : " cells", "; there must be one for each");
  }
}

int takenComponent(const std::string& name, int component, int type, int count)
{
  const int automatic = automaticComponent(type, count);
  const int wanted = component == AutoComponent ? automatic : component;
  const bool mayBeColour = count <= MostColorComponents;
  if ((wanted >= 0 && wanted < count) || wanted == Magnitude ||
    (wanted == Luminance && mayBeColour))
  {
    return count == 1 && wanted == Luminance ? 0 : wanted;
  }
  const std::string indices = count == 1 ? "0" : "an index from 0 to " + std::to_string(count - 1);
  fail("Component is ", component, ", but the ", name, " has ", count,
    count == 1 ? " component" : " components", "; it must be ",
    automatic == AutoComponent ? "" : "-1 (Auto), ", mayBeColour ? "-2 (luminance), " : "",
    "-3 (magnitude) or ", indices);
}

bool isOfSeveral(const DensityRules& rules)
{
  return rules.Component < 0;
}

bool needsWhite(const DensityRules& rules, int components)
{
  const bool alpha = rules.Component == Luminance && (components == 2 || components == 4);
  return rules.Invert || alpha;
}

bool hasDisplayedWhite(const DensityRules& rules, int type)
{
  return type == VTK_UNSIGNED_CHAR && rules.Component != Magnitude;
}

void throwInvalidDensity(const std::string& name, const DensitySummary& summary,
  const MissingValues& missing, bool hasEmpty)
{
  const std::string has = "The " + name + " has ";
  // The remedy first: ParaView's list of messages shows about 90 characters of a line.
  if (summary.NotFinite > 0)
  {
    fail(has, summary.NotFinite, summary.NotFinite == 1 ? " value that is" : " values that are",
      missing.AreNaN ? " infinite; finite ends of ValidRange take them as empty"
                     : " NaN or infinite; NaNValues = Empty takes NaN as empty",
      " cells (the first at index ", summary.FirstNotFinite, ")");
  }
  if (summary.Negative > 0)
  {
    fail(has, summary.Negative, summary.Negative == 1 ? " negative value" : " negative values",
      "; NegativeValues = Clamp takes them as 0, ValidRange as missing (the first at index ",
      summary.FirstNegative, ")");
  }
  if (std::isinf(summary.Total))
  {
    fail(has, "a total mass past the largest double; its values must be smaller");
  }
  fail(has, "a total mass of zero", hasEmpty ? " (empty cells carry none)" : "",
    "; at least one value must be positive");
}

} // namespace RectifiedTransport::Bridge
