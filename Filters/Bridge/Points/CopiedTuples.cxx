// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Points/CopiedTuples.h"

#include "Bridge/Run/Failure.h"
#include "Bridge/Run/Memory.h"
#include "Core/Parallel/Progress.h"

#include "vtkAbstractArray.h"
#include "vtkDataSetAttributes.h"

#include <algorithm>
#include <string>

namespace RectifiedTransport
{

void copyTuples(const TupleSource& source, std::int64_t count,
  const std::function<vtkIdType(vtkIdType)>& idOf, vtkDataSetAttributes* to, Progress& progress)
{
  for (int i = 0; i < source.From->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = source.From->GetAbstractArray(i);
    const std::string name =
      std::string("array ") + (array->GetName() ? array->GetName() : "without name");
    if (array->GetNumberOfTuples() < source.Count)
    {
      throw Failure(std::string("The ") + source.Owner + " " + name + " of the " + source.Name +
        " has " + std::to_string(array->GetNumberOfTuples()) +
        " tuples; it must have one for each of the " + std::to_string(source.Count) + " " +
        source.Owner + "s");
    }
    requireMemory("the " + name,
      static_cast<double>(count) * array->GetNumberOfComponents() *
        std::max(1, array->GetDataTypeSize()));
  }
  to->CopyAllocate(source.From, static_cast<vtkIdType>(count));
  constexpr std::int64_t grain = std::int64_t{ 1 } << 13;
  constexpr std::int64_t units = std::int64_t{ 1 } << 16; // with random memory access
  progress.ForInOrder(
    count, grain,
    [&](std::int64_t first, std::int64_t last) {
      for (auto i = static_cast<vtkIdType>(first); i < last; ++i)
      {
        to->CopyData(source.From, idOf(i), i);
      }
    },
    units);
}

} // namespace RectifiedTransport
