// SPDX-License-Identifier: BSD-3-Clause
// The property Corners, set, checked and printed: which points of a disk become the corners of the
// square.
#ifndef RectifiedTransport_CornerSettings_h
#define RectifiedTransport_CornerSettings_h

#include "Core/Mesh/RepairedDisk.h"
#include "Core/Parameterization/SquareCorners.h"

#include "vtkIndent.h"

#include <cstdint>
#include <iosfwd>
#include <vector>

namespace RectifiedTransport
{

// The values are those of vtkCornersPropertiesMacro.
struct CornerSettings
{
  // Far above 4; bounds the memory that SetCorner allocates.
  static constexpr int MaximumNumber = 1000000;

  std::vector<std::int64_t> Points; // empty: automatic

  int Number() const { return static_cast<int>(this->Points.size()); }
  // -1 where there is none.
  std::int64_t At(int index) const;
  // These return whether anything changed; the arguments must be in range.
  bool Resize(int count);
  bool Set(int index, std::int64_t point);

  // Throws Failure unless there are none or four.
  void Check() const;
  // The corners of a disk, chosen where there are none; the values are given points of it. Throws
  // Failure unless they are four different points of its boundary.
  SquareCorners Of(const RepairedDisk& disk) const;
  void Print(std::ostream& os, vtkIndent indent) const;
};

} // namespace RectifiedTransport

// For the source file of a class that has vtkCornersPropertiesMacro, whose constructor makes its
// Corners.
#define vtkImplementCornersPropertiesMacro(Class)                                                  \
  void Class::SetNumberOfCorners(int count)                                                        \
  {                                                                                                \
    constexpr int maximum = RectifiedTransport::CornerSettings::MaximumNumber;                     \
    if (count < 0 || count > maximum)                                                              \
    {                                                                                              \
      vtkErrorMacro(<< "The number of corners is " << count << "; it must be from 0 to "           \
                    << maximum);                                                                   \
      return;                                                                                      \
    }                                                                                              \
    if (this->Corners->Resize(count))                                                              \
    {                                                                                              \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  int Class::GetNumberOfCorners()                                                                  \
  {                                                                                                \
    return this->Corners->Number();                                                                \
  }                                                                                                \
  void Class::SetCorner(int index, vtkIdType point)                                                \
  {                                                                                                \
    constexpr int maximum = RectifiedTransport::CornerSettings::MaximumNumber;                     \
    if (index < 0 || index >= maximum)                                                             \
    {                                                                                              \
      vtkErrorMacro(<< "The index of a corner is " << index << "; it must be from 0 to "           \
                    << maximum - 1);                                                               \
      return;                                                                                      \
    }                                                                                              \
    if (this->Corners->Set(index, point))                                                          \
    {                                                                                              \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  vtkIdType Class::GetCorner(int index)                                                            \
  {                                                                                                \
    return static_cast<vtkIdType>(this->Corners->At(index));                                       \
  }

#endif
