// SPDX-License-Identifier: BSD-3-Clause
// The arrays that data sets on several ranks have in common, and their tuples as bytes.
#ifndef RectifiedTransport_CommonArrays_h
#define RectifiedTransport_CommonArrays_h

#include "Bridge/VTKCompatibility.h"
#include "Core/Parallel/Ranks.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkDataSet;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// A numeric array of points or cells.
struct ArrayKind
{
  int Owner = 0; // vtkDataObject::POINT or CELL
  int Type = 0;
  int Components = 1;
  int Attribute = -1; // for which it is the active one
  std::string Name;
  std::vector<std::string> ComponentNames; // or none

  bool IsLike(const ArrayKind& other) const
  {
    return this->Owner == other.Owner && this->Type == other.Type &&
      this->Components == other.Components && this->Name == other.Name;
  }
  bool IsGhosts() const;
  // The array of this kind in a data set; nullptr if there is none. Contiguous: a copy if the array
  // is not.
  vtkSmartPointer<vtkDataArray> Find(vtkDataSet* data) const;
  // Adds an array of this number of tuples to a data set.
  vtkSmartPointer<vtkDataArray> Make(vtkDataSet* data, vtkIdType tuples) const;
};

// The arrays that all ranks with points have, in the order of the first of these ranks, and the
// ghost arrays of any rank. `data` may be nullptr. Collective. Throws Failure for an array with too
// few tuples.
std::vector<ArrayKind> commonArrays(vtkDataSet* data, const Ranks& ranks);

// Consecutive tuples.
struct TupleRun
{
  vtkIdType First;
  vtkIdType Count;
};

// Appends the tuples of a contiguous array; zeros of one byte for nullptr.
void appendTuples(vtkDataArray* from, const std::vector<TupleRun>& runs, Bytes& to);
// Copies tuples to as many tuples of another array of the kind; zeros for nullptr.
void copyTuples(vtkDataArray* from, const std::vector<TupleRun>& runs,
  const std::vector<TupleRun>& runsThere, vtkDataArray* to);
// Reads tuples from bytes; returns where the next ones begin.
const char* takeTuples(const char* from, const std::vector<TupleRun>& runs, vtkDataArray* to);

} // namespace RectifiedTransport::Bridge

#endif
