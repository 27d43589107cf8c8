// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Tables/Reading/DensityFailure.h"

#include "Core/Messages/Failure.h"

#include <cmath>

namespace RectifiedTransport
{

int resolveComponent(const std::string& name, int component, int automatic, int count)
{
  const int wanted = component == AutoComponent ? automatic : component;
  const bool mayBeColour = count <= MostColorComponents;
  if ((wanted >= 0 && wanted < count) || wanted == Magnitude ||
    (wanted == Luminance && mayBeColour))
  {
    // A single component is its own luminance.
    return count == 1 && wanted == Luminance ? 0 : wanted;
  }
  const std::string indices = count == 1 ? "0" : "an index from 0 to " + std::to_string(count - 1);
  fail("Component is ", component, ", but the ", name, " has ", count,
    count == 1 ? " component" : " components", "; it must be ",
    automatic == AutoComponent ? "" : "-1 (Auto), ", mayBeColour ? "-2 (luminance), " : "",
    "-3 (magnitude) or ", indices);
}

void throwInvalidDensity(const std::string& name, const DensitySummary& summary,
  const MissingValues& missing, bool hasEmpty)
{
  const std::string has = "The " + name + " has ";
  // The remedy comes before the index: ParaView's list of messages shows about 90 characters of a
  // line.
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
