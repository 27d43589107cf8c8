// SPDX-License-Identifier: BSD-3-Clause
// Reads an array of any value type and memory layout as a density of the core, without a copy.
#ifndef RectifiedTransport_DensityReader_h
#define RectifiedTransport_DensityReader_h

#include "Bridge/Run/Settings/ComponentChoice.h"
#include "Bridge/Run/Settings/MissingData.h"
#include "Bridge/VTKCompatibility.h"
#include "Core/Tables/Density.h"

#include <cstdint>
#include <limits>
#include <memory>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
VTK_ABI_NAMESPACE_END

namespace RectifiedTransport::Bridge
{

// How the values of an array become a density; see vtkDensityAlgorithm.
struct DensityRules
{
  int Component = AutoComponent; // an index or a ComponentChoice
  bool Invert = false;           // white - value
  bool ClampNegative = false;
  MissingValues Missing;
  EmptyRule Empty; // what cells without a value, blanked ones among them, count as
};

// The largest finite value, the number of tuples that have it, and the next value below it.
struct LargestValue
{
  double Value = -std::numeric_limits<double>::infinity(); // of none
  std::int64_t Count = 0;
  std::int64_t First = -1;
  double Next = -std::numeric_limits<double>::infinity();
};

class DensityReader : public DensityValues
{
public:
  explicit DensityReader(const DensityRules& rules)
    : Rules(rules)
  {
  }

  // The largest displayed value, for Invert and alpha.
  void SetWhite(double white) { this->White = white; }
  // Cells whose flags have one of the bits of `mask` are empty.
  void SetBlanks(const unsigned char* flags, unsigned char mask)
  {
    this->Flags = flags;
    this->Mask = mask;
  }

  // The density of empty cells, 0 at first.
  void SetEmpty(double density) { this->Empty = density; }

  // Sets empty[i] where cell first + i is empty: blank or without a valid value. All components
  // that make the density must be valid; alpha must not be NaN.
  virtual void FindEmpty(std::int64_t first, std::int64_t count, unsigned char* empty) const = 0;

  // The largest value of the component, of all components (luminance) or of the magnitude, in cells
  // that are not empty.
  virtual LargestValue Largest(std::int64_t first, std::int64_t count) const = 0;

  // Reads the same, but leaves negative values as they are.
  std::unique_ptr<DensityReader> MakeUnclamped(vtkDataArray* array) const;

protected:
  bool IsBlank(std::int64_t cell) const { return this->Flags && (this->Flags[cell] & this->Mask); }
  // Applies ClampNegative and the blanking to values that were read.
  void Finish(std::int64_t first, std::int64_t count, double* values) const;

  const DensityRules Rules;
  double White = 0.0;
  double Empty = 0.0;
  const unsigned char* Flags = nullptr;
  unsigned char Mask = 0;
};

// `rules` have the component that is taken, not Auto.
std::unique_ptr<DensityReader> makeDensityReader(vtkDataArray* array, const DensityRules& rules);

} // namespace RectifiedTransport::Bridge

#endif
