// SPDX-License-Identifier: BSD-3-Clause
// Arrays with fewer tuples than their data set has points or cells, on several ranks.
#ifndef RectifiedTransport_TruncatedArrays_h
#define RectifiedTransport_TruncatedArrays_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Geometry/Distributed/ArrayKinds.h"

#include "vtkSmartPointer.h"

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport
{
class Ranks;
} // namespace RectifiedTransport

namespace RectifiedTransport::Bridge
{

// What copies, sends and joins tuples would read past the end of such arrays. They are taken out
// before, and an array of their name without any tuple takes their place after: what reads it
// refuses it, as on one rank, and what does not passes it on.
class TruncatedArrays
{
public:
  TruncatedArrays() = default;
  // Finds the short arrays of a data set, which may be nullptr.
  explicit TruncatedArrays(vtkDataSet* data);
  // Reads what Text wrote.
  explicit TruncatedArrays(const std::string& text)
    : Arrays(kindsOfText(text))
  {
  }

  void Add(const TruncatedArrays& others);
  // Adds those of all other ranks. Collective.
  void AddFromRanks(const Ranks& ranks);
  std::string Text() const { return textOfKinds(this->Arrays); }

  // A shallow copy without arrays of these names; the data set itself if there are none.
  template <class DataT>
  vtkSmartPointer<DataT> RemovedFrom(DataT* data) const
  {
    if (!data || this->Arrays.empty())
    {
      return data;
    }
    const auto copy = vtkSmartPointer<DataT>::Take(data->NewInstance());
    copy->ShallowCopy(data);
    this->RemoveFrom(copy);
    return copy;
  }

  // Adds the arrays without tuples, in place of arrays of the same names.
  void AddEmptyTo(vtkDataSet* data) const;

private:
  void RemoveFrom(vtkDataSet* data) const;

  ArrayKinds Arrays; // with an empty name: has none, and is left out
};

} // namespace RectifiedTransport::Bridge

#endif
