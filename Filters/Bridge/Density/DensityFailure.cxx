// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Density/DensityFailure.h"

#include "Bridge/Density/DensityReader.h"
#include "Bridge/Run/Failure.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

#include <cmath>

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
    fail("The ", describeArray(array), " has ", array->GetNumberOfTuples(), " tuples, but the ",
      what, " has ", expected, onPoints ? " points" : " cells", "; there must be one for each");
  }
}

void requireComponent(const std::string& name, int component, int count)
{
  constexpr int mostColours = 4;
  if (component >= -1 && component < count && (component >= 0 || count <= mostColours))
  {
    return;
  }
  const std::string indices = count == 1 ? "0" : "an index from 0 to " + std::to_string(count - 1);
  fail("Component is ", component, ", but the ", name, " has ", count,
    count == 1 ? " component" : " components", "; it must be ",
    count <= mostColours ? "-1 (luminance) or " : "", indices);
}

bool isColour(const DensityRules& rules, int components)
{
  return rules.Component < 0 && components > 1;
}

bool needsWhite(const DensityRules& rules, int components)
{
  const bool alpha = rules.Component < 0 && (components == 2 || components == 4);
  return rules.Invert || alpha;
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

} // namespace RectifiedTransport
