// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/Fingerprint.h"

#include "Core/Parallel/BytesHash.h"

#include "vtkDataArray.h"
#include "vtkType.h"

namespace RectifiedTransport::Bridge
{

namespace
{

// The number of bytes of the values; -1 if they are not contiguous in memory. The unused bits of a
// bit array count: at worst equal arrays differ.
std::int64_t bytesOf(vtkDataArray* array)
{
  constexpr std::int64_t bitsAByte = 8;
  const std::int64_t values = array->GetNumberOfValues();
  if (array->GetDataType() == VTK_BIT) // whose GetDataTypeSize() is 0
  {
    return (values + bitsAByte - 1) / bitsAByte;
  }
  const int size = array->GetDataTypeSize();
  return array->HasStandardMemoryLayout() && size > 0 ? values * size : -1;
}

} // namespace

std::uint64_t fingerprint(const std::vector<vtkDataArray*>& arrays, Progress& progress)
{
  std::vector<ByteRange> ranges;
  for (vtkDataArray* array : arrays)
  {
    if (!array)
    {
      continue;
    }
    const std::int64_t count = bytesOf(array);
    if (count < 0)
    {
      return 0;
    }
    ranges.push_back({ static_cast<const unsigned char*>(array->GetVoidPointer(0)), count });
  }
  return hashBytes(ranges, progress);
}

} // namespace RectifiedTransport::Bridge
