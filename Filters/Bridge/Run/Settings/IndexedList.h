// SPDX-License-Identifier: BSD-3-Clause
// A property of a filter that is a list: its values are set one by one, by their indices.
#ifndef RectifiedTransport_IndexedList_h
#define RectifiedTransport_IndexedList_h

#include "vtkObject.h"

#include <algorithm>
#include <cstddef>
#include <ostream>
#include <vector>

namespace RectifiedTransport::Bridge
{

template <class T>
class IndexedList
{
public:
  // Bounds the memory that Set allocates.
  static constexpr int MaximumNumber = 1000000;

  // In messages the values are called `values`, and an index `index`. `none` is the value of what
  // is not set.
  IndexedList(const char* values, const char* index, T none)
    : Values(values)
    , Index(index)
    , None(none)
  {
  }

  // Reports a number out of range as an error of the filter, which is modified by a change.
  void Resize(vtkObject* filter, int count)
  {
    if (count < 0 || count > MaximumNumber)
    {
      vtkErrorWithObjectMacro(filter, << "The number of " << this->Values << " is " << count
                                      << "; it must be from 0 to " << MaximumNumber);
    }
    else if (count != this->Number())
    {
      this->All.resize(static_cast<std::size_t>(count), this->None);
      filter->Modified();
    }
  }

  // The same; the list grows as needed.
  void Set(vtkObject* filter, int index, const T& value)
  {
    if (index < 0 || index >= MaximumNumber)
    {
      vtkErrorWithObjectMacro(filter, << "The " << this->Index << " is " << index
                                      << "; it must be from 0 to " << MaximumNumber - 1);
      return;
    }
    this->Resize(filter, std::max(index + 1, this->Number()));
    T& known = this->All[static_cast<std::size_t>(index)];
    if (known != value)
    {
      known = value;
      filter->Modified();
    }
  }

  int Number() const { return static_cast<int>(this->All.size()); }
  const T& At(int index) const
  {
    return index >= 0 && index < this->Number() ? this->All[static_cast<std::size_t>(index)]
                                                : this->None;
  }

  // Ends the line of a property's name; `empty` is the text of a list without values.
  void Print(std::ostream& os, const char* empty) const
  {
    for (const T& value : this->All)
    {
      os << " " << value;
    }
    os << (this->All.empty() ? empty : "") << "\n";
  }

  std::vector<T> All;

private:
  const char* Values;
  const char* Index;
  T None;
};

} // namespace RectifiedTransport::Bridge

#endif
