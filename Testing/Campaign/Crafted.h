// SPDX-License-Identifier: BSD-3-Clause
// Inputs that are broken on purpose: files that no writer makes, read by VTK's readers, and data
// objects with the same defects, for what readers turn down.
#ifndef Campaign_Crafted_h
#define Campaign_Crafted_h

#include "Case.h"
#include "RandomSource.h"

#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace Campaign
{

// A small data object of any type without a defect, with a cell array "v" and a point array "p".
vtkSmartPointer<vtkDataObject> drawSoundObject(RandomSource& random, std::string& text);

// Arrays of any numeric type on the cells and on the points.
void addValues(RandomSource& random, vtkDataSet* data);

// Breaks something of it in place, and says what.
void damage(RandomSource& random, vtkDataObject* object, std::string& text);

// Writes a data object to a file of a type that takes it, below the path. What that is, or nothing
// where there is none.
std::string writeFile(RandomSource& random, vtkDataObject* object, const std::string& path);

// Breaks a file, and says how.
void damageFile(RandomSource& random, const std::string& path, std::string& text);

// What VTK's reader makes of a file; nullptr if it refuses it.
vtkSmartPointer<vtkDataObject> readFile(const std::string& path);

// A number that is wrong nearly anywhere, as text.
std::string drawBadNumber(RandomSource& random);

struct Mass
{
  double Value = 0.0;
  bool IsKnown = false;
};

// The integral of the cell array "v" by another method; unknown where the object is not sound.
Mass integralOf(vtkDataObject* object);

// A crafted input through all filters. Folder is where its files go.
CaseResult runCraftedCase(std::uint64_t seed, std::uint64_t number, const std::string& folder);

} // namespace Campaign

#endif
