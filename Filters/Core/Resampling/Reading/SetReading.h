// SPDX-License-Identifier: BSD-3-Clause
// Reads the densities of the cells of a data set from an array.
#ifndef RectifiedTransport_SetReading_h
#define RectifiedTransport_SetReading_h

#include "Core/Parallel/LargeBuffer.h"
#include "Core/Resampling/CellValues.h"
#include "Core/Tables/Reading/DensityReader.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace RectifiedTransport
{

struct SetFindings
{
  std::string Array;                                      // its name in messages
  SuspectValues Known;                                    // with the white of this set
  double Least = std::numeric_limits<double>::infinity(); // value of counted cells
};

// The steps of reading a set: those of several sets have one white.
class SetReading
{
public:
  // `name` is that of the array in messages; `areBytes` says whether its values are displayed.
  // Finds which cells count. Throws Cancelled.
  SetReading(std::unique_ptr<DensityReader> reader, const std::string& name, bool areBytes,
    const std::shared_ptr<const CellSet>& set, bool onPoints, const MassCells& mass,
    Progress& progress);

  // The largest value, for white. Throws Cancelled.
  double FindLargest(Progress& progress);
  void SetWhite(double white) { this->Reader->SetWhite(white); }

  std::int64_t NumberOfValues() const { return static_cast<std::int64_t>(this->Unused.size()); }
  // Reads the densities into the memory for them. Throws Failure for values of counted cells that
  // are no density, and Cancelled.
  void Read(LargeBuffer<double> densities, Progress& progress);

  // What was read.
  CellValues Cells;
  SetFindings Found;

private:
  std::unique_ptr<DensityReader> Reader;
  std::vector<unsigned char> Unused; // by values: 1 if no counted cell needs it
  bool AreBytes;
};

} // namespace RectifiedTransport

#endif
