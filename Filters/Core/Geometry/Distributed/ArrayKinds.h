// SPDX-License-Identifier: BSD-3-Clause
// The kinds of arrays that the data sets of ranks have.
#ifndef RectifiedTransport_ArrayKinds_h
#define RectifiedTransport_ArrayKinds_h

#include <string>
#include <vector>

namespace RectifiedTransport
{

// An array of points or cells.
struct ArrayKind
{
  int Owner = 0; // a TupleOwner
  int Type = 0;  // VTK's number of it
  int Components = 1;
  int Attribute = -1; // for which it is the active one
  std::string Name;
  std::vector<std::string> ComponentNames = {}; // or none

  bool IsLike(const ArrayKind& other) const
  {
    return this->Owner == other.Owner && this->Type == other.Type &&
      this->Components == other.Components && this->Name == other.Name;
  }
};

using ArrayKinds = std::vector<ArrayKind>;

// A line each, and the kinds of such lines.
std::string textOfKinds(const ArrayKinds& kinds);
ArrayKinds kindsOfText(const std::string& text);

// The kinds that are in all lists, in the order of the first list, and those of this name in any.
ArrayKinds commonKinds(const std::vector<ArrayKinds>& all, const std::string& name);

} // namespace RectifiedTransport

#endif
